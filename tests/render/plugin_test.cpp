// Plugins in a path: their matrices end up in the right frames, and wrong ones do no harm.
#include <gtest/gtest.h>

#include <cmath>

#include "plugin_path.h"
#include "reference_comparison.h"
#include "test_scenes.h"

namespace drude {
namespace {

// Two balls of `material` that see each other and a floor, under a sky that is polarised and
// brighter on one side, so that all sixteen elements matter.
Scene two_balls(const std::string& material, const std::string& before) {
    return parse_scene(before + R"(
LookAt 0 1 -6  0 0 0  0 1 0
Camera "perspective" "float fov" 45
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
PixelFilter "box"
Integrator "path" "integer maxdepth" 3
WorldBegin
LightSource "infinite" "rgb L" [.4 .5 .6] "float dop" 0.7 "float aolp" 30
LightSource "distant" "point3 from" [2 3 -4] "rgb L" [1 .8 .6]
)" + material + R"(
AttributeBegin
Translate -1 0 0
Shape "sphere"
AttributeEnd
AttributeBegin
Translate 1.05 0.2 0
Shape "sphere"
AttributeEnd
Material "diffuse" "rgb reflectance" [.5 .5 .5]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
  "point3 P" [-3 -1.1 -3  3 -1.1 -3  3 -1.1 3  -3 -1.1 3]
)",
                       "balls.pbrt");
}

const std::string built_in =
    "Material \"conductor\" \"spectrum eta\" [300 1.04 900 1.04] \"spectrum k\" [300 2.59 900 "
    "2.59] "
    "\"float roughness\" 0.4 \"bool remaproughness\" false";
const std::string plugin =
    "Material \"metal\" \"float n\" 1.04 \"float k\" 2.59 \"float alpha\" 0.4";

class Plugin : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(BothHands, Plugin, testing::Values("", "Scale -1 1 1\n"));

// The plugin's metal is written from Fresnel's amplitudes in complex numbers; the reference
// integrator draws the built-in one in double.
TEST_P(Plugin, OfAMetalIsTheBuiltInOne) {
    const PluginPath path;
    const BlockMeans reference = reference_blocks(two_balls(built_in, GetParam()), 1024, 4,
                                                  ReferenceOptions::Directions::lobe, 7);
    const Scene scene = two_balls(plugin, GetParam());
    expect_agreement(rendered_blocks(scene, Transport::stokes, 32, 4, 16), reference, 4);
    expect_agreement(rendered_blocks(scene, Transport::intensity, 32, 4, 16), reference, 1);
}

TEST_P(Plugin, IsTheSameInTheReferenceIntegrator) {
    const PluginPath path;
    const Scene scene = two_balls(plugin, GetParam());
    const BlockMeans rendered = rendered_blocks(scene, Transport::stokes, 32, 4, 16);
    for (const auto directions :
         {ReferenceOptions::Directions::lobe, ReferenceOptions::Directions::hemisphere}) {
        expect_agreement(rendered, reference_blocks(scene, 1024, 4, directions, 9), 4);
    }
}

// White and convex: it disappears in front of the sky.
TEST(PluginFurnace, WhiteIsWhite) {
    const PluginPath path;
    const RenderResult result =
        render_quietly(sphere_under_sky("Material \"lambert\"", 16), 256, false, true);
    EXPECT_EQ(result.transport, Transport::scalar) << result.transport_reason;
    const Channel& sky = result.image.at("S0.554,500000nm", "render");
    const float first = sky.data[0];
    ASSERT_GT(first, 0);
    double sum = 0;
    for (const float value : sky.data) {
        EXPECT_NEAR(value / first, 1, 0.06);
        sum += static_cast<double>(value / first);
    }
    EXPECT_NEAR(sum / static_cast<double>(sky.data.size()), 1, 0.003);
}

TEST(PluginFaults, AreCountedAndDoNoHarm) {
    const PluginPath path;
    for (const std::string name : {"not_finite", "unphysical", "long_direction"}) {
        const Scene scene = two_balls("Material \"" + name + "\"", "");
        for (const bool stokes : {false, true}) {
            const RenderResult result = render_quietly(scene, 16, stokes);
            const uint64_t counted = name == "unphysical" ? result.projections : result.not_finite;
            EXPECT_GT(counted, 0u) << name;
            const std::string& warning = result.warnings.back();
            EXPECT_NE(warning.find("the plugin " + name), std::string::npos) << warning;
            for (const Channel& channel : result.image.channels) {
                for (const float value : channel.data) {
                    ASSERT_TRUE(std::isfinite(value)) << name << " " << channel.name;
                }
            }
        }
    }
}

TEST(PluginThreads, DoNotChangeTheBits) {
    const PluginPath path;
    const Scene scene = two_balls(plugin, "");
    const RenderResult one = render_quietly(scene, 16, true, false, 1);
    const RenderResult three = render_quietly(scene, 16, true, false, 3);
    ASSERT_EQ(one.image.channels.size(), three.image.channels.size());
    for (size_t c = 0; c < one.image.channels.size(); ++c) {
        EXPECT_EQ(one.image.channels[c].data, three.image.channels[c].data);
    }
}

}  // namespace
}  // namespace drude
