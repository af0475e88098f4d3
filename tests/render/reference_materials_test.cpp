// The renderer against the reference integrator on what light goes into or through.
#include <gtest/gtest.h>

#include "reference_comparison.h"
#include "test_scenes.h"

namespace drude {
namespace {

using Directions = ReferenceOptions::Directions;

// A sphere of the given material on a grey floor beside a slanted metal, under a dim sky and a
// panel of light: shadows, caustics, and light that was polarised before it meets the sphere.
Scene scene_of(const std::string& material, const std::string& more = "", int depth = 6) {
    return parse_scene(
        "LookAt 0 -4 1.5  0 0 0.2  0 0 1\nCamera \"perspective\" \"float fov\" 40\n"
        "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\n"
        "PixelFilter \"box\"\nIntegrator \"path\" \"integer maxdepth\" " +
            std::to_string(depth) +
            "\nWorldBegin\nLightSource \"infinite\" \"rgb L\" [0.3 0.4 0.5]\n"
            "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [3 3 3] \"bool twosided\" true\n"
            "Material \"diffuse\" \"rgb reflectance\" [0 0 0]\n"
            "Shape \"trianglemesh\" \"integer indices\" [0 2 1 0 3 2]\n"
            "  \"point3 P\" [-1.5 -1 3  1.5 -1 3  1.5 1.5 3  -1.5 1.5 3]\nAttributeEnd\n"
            "Material \"diffuse\" \"rgb reflectance\" [0.5 0.4 0.3]\n"
            "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
            "  \"point3 P\" [-4 -4 -1  4 -4 -1  4 4 -1  -4 4 -1]\n"
            "Material \"conductor\" \"float roughness\" 0.02\n"
            "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
            "  \"point3 P\" [0.9 -1 -1  0.9 1.5 -1  2 1.5 2  2 -1 2]\n" +
            material + "\nShape \"sphere\" \"float radius\" 0.9\n" + more,
        "glass.pbrt");
}

// The three bins share their paths and the whole picture its blocks, so that the mean square of so
// few deviations says little: what counts is the largest, corrected for their number.
void expect_same(const BlockMeans& rendered, const BlockMeans& reference, size_t rows) {
    const Agreement result = agreement(rendered, reference, rows);
    EXPECT_GT(result.p, 1e-3) << result.tests << " tests; " << result.worst;
}

void compare(const Scene& scene, int reference_samples = 4096,
             Directions directions = Directions::lobe) {
    const BlockMeans reference = reference_blocks(scene, reference_samples, 4, directions, 9);
    expect_same(rendered_blocks(scene, Transport::stokes, 64, 4, 12), reference, 4);
    expect_same(rendered_blocks(scene, Transport::intensity, 64, 4, 12), reference, 1);
}

// Under an even sky clear glass cannot be seen, whatever path light took: every weight is one.
TEST(ReferenceMaterials, ClearGlassIsNotSeenUnderAnEvenSky) {
    for (const char* material :
         {"Material \"dielectric\"", "Material \"dielectric\" \"float eta\" 0.7",
          "Material \"dielectric\" \"spectrum eta\" \"glass-SF11\"",
          "Material \"thindielectric\""}) {
        Scene scene = sphere_under_sky(material, 4);
        scene.max_depth = 300;
        ReferenceOptions options;
        options.bands_nm = {{450}, {650}};
        options.samples_per_pixel = 400;
        const ReferenceResult result = render_reference(scene, options);
        double radiance[2] = {0, 0};
        for (int b = 0; b < 2; ++b) {
            radiance[b] = scene.infinite_lights[0].radiance[b == 0 ? 70 : 270];
            double mean = 0;
            for (int p = 0; p < 16; ++p) mean += result.at(p % 4, p / 4, b).mean[0] / 16;
            EXPECT_NEAR(mean / radiance[b], 1, 0.05) << material;
        }
        // One wavelength a path, or a plate's even choice of its two ways, is noise; glass of one
        // index has almost none: what was polarised is a little more likely to go one way.
        if (std::string(material).find("spectrum") != std::string::npos ||
            std::string(material).find("thin") != std::string::npos) {
            continue;
        }
        for (int p = 0; p < 16; ++p) {
            const auto& value = result.at(p % 4, p / 4, 0);
            EXPECT_NEAR(value.mean[0] / radiance[0], 1, 0.01) << material;
        }
    }
}

TEST(ReferenceMaterials, AgreesOnGlass) {
    compare(scene_of("Material \"dielectric\""));
    compare(scene_of("Material \"dielectric\" \"float eta\" 1.3 \"float roughness\" 0.3"));
    compare(scene_of("Material \"thindielectric\" \"float eta\" 1.8"));
}

// What knows nothing of lobes finds the same.
TEST(ReferenceMaterials, AgreesOnRoughGlassByEvenDirections) {
    compare(scene_of("Material \"dielectric\" \"float roughness\" 0.5", "", 3), 8192,
            Directions::hemisphere);
}

TEST(ReferenceMaterials, AgreesOnGlassThatPartsTheColours) {
    compare(scene_of("Material \"dielectric\" \"spectrum eta\" [ 380 1.9 780 1.3 ]"), 8192);
}

TEST(ReferenceMaterials, AgreesOnCoats) {
    compare(scene_of("Material \"coateddiffuse\" \"rgb reflectance\" [0.7 0.5 0.2]"));
    compare(scene_of("Material \"coateddiffuse\" \"float roughness\" 0.2 \"float thickness\" 0.3"));
    compare(scene_of("Material \"coatedconductor\" \"float conductor.roughness\" 0.2"));
    compare(
        scene_of("Material \"coatedconductor\" \"float interface.roughness\" 0.2 \"float "
                 "interface.eta\" 1.8 \"float conductor.roughness\" 0.1"));
}

TEST(ReferenceMaterials, AgreesOnDiffusersAndMixtures) {
    compare(
        scene_of("Material \"diffusetransmission\" \"rgb reflectance\" [0.2 0.4 0.3] \"rgb "
                 "transmittance\" [0.5 0.1 0.6]"));
    compare(
        scene_of("MakeNamedMaterial \"a\" \"string type\" \"conductor\" \"float roughness\" 0.1\n"
                 "MakeNamedMaterial \"b\" \"string type\" \"interface\"\n"
                 "Material \"mix\" \"string materials\" [\"a\" \"b\"] \"float amount\" 0.3"));
}

// Elements over the sphere and the metal, turned and met at slanting angles, in front of lights of
// every kind.
TEST(ReferenceMaterials, AgreesOnOpticalElements) {
    const std::string panel =
        "\nShape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
        "  \"point3 P\" [-1.2 -1.2 {0}  1.2 -1.2 {0}  1.2 1.2 {0}  -1.2 1.2 {0}]\n";
    const std::string elements =
        "AttributeBegin\nRotate 20 0 1 0\nMaterial \"linearpolariser\" \"float axis\" 30 \"float "
        "transmittance\" 0.9" +
        fmt::format(fmt::runtime(panel), 1.2) +
        "Material \"retarder\" \"float axis\" -10 \"float retardance\" 70" +
        fmt::format(fmt::runtime(panel), 1.4) +
        "Material \"circularpolariser\" \"bool righthanded\" false" +
        fmt::format(fmt::runtime(panel), -0.95) + "AttributeEnd\n";
    compare(scene_of("Material \"conductor\" \"float roughness\" 0.1", elements));
    compare(scene_of("Material \"conductor\" \"float roughness\" 0.1",
                     elements +
                         "LightSource \"distant\" \"point3 from\" [0.3 -0.2 1] \"float scale\" 2\n"
                         "LightSource \"point\" \"point3 from\" [1 -1 2.5] \"float scale\" 3\n"));
}

}  // namespace
}  // namespace drude
