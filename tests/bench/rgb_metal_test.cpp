// Metals in three channels: what stands for them is what it claims to be.
#include "bench/charts/rgb_metal.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/charts/chart_scenes.h"
#include "bench/charts/illuminants.h"
#include "bench/charts/rgb_error_table.h"
#include "bench/charts/traced_picture.h"

namespace drude {
namespace {

TEST(RgbMetal, GreyMatterIsGrey) {
    const RGB grey = colour_in_d65(constant_spectrum(0.4));
    for (const double c : grey) EXPECT_NEAR(c, 0.4, 1e-9);
    // A metal without colour is the same n and k, however it is turned into channels.
    const DenseIndex metal{constant_spectrum(0.9), constant_spectrum(6)};
    for (const RgbMetal way : {RgbMetal::at_primaries, RgbMetal::as_colours}) {
        for (const Index& index : rgb_constants(metal, way)) {
            EXPECT_NEAR(index.n, 0.9, 1e-9);
            EXPECT_NEAR(index.k, 6, 1e-9);
        }
    }
    for (const ChartIlluminant& light : chart_illuminants()) {
        EXPECT_LT(rgb_colour_error(metal, RgbMetal::fitted, light, 1), 0.02) << light.name;
        EXPECT_LT(rgb_colour_error(metal, RgbMetal::at_primaries, light, 3), 1e-6) << light.name;
    }
}

TEST(RgbMetal, FittedHasTheColourAtNormalIncidence) {
    for (const char* name : {"Ag", "Al", "Zn", "Cu", "Au"}) {
        const DenseIndex metal = dense(published_set(name));
        const RGB exact = colour_in_d65(reflectance_spectrum(metal, 1));
        for (const RgbMetal way : {RgbMetal::fitted, RgbMetal::schlick}) {
            const RGB channels = rgb_reflectances(metal, way, {1.0})[0];
            for (size_t c = 0; c < 3; ++c) {
                EXPECT_NEAR(channels[c], std::min(exact[c], 1.0), 2e-4) << name << c;
            }
        }
    }
}

// Where lights and metals are broad three channels do; in narrow light they cannot.
TEST(RgbMetal, FailsInLightThatItDoesNotKnow) {
    const DenseIndex gold = dense(published_set("Au")), silver = dense(published_set("Ag"));
    const ChartIlluminant& day = chart_illuminants()[0];
    const ChartIlluminant& sodium = chart_illuminants()[3];
    EXPECT_LT(rgb_colour_error(silver, RgbMetal::fitted, day, 1), 0.1);
    EXPECT_GT(rgb_colour_error(gold, RgbMetal::fitted, sodium, 1), 5);
    EXPECT_GT(rgb_colour_error(gold, RgbMetal::fitted, sodium, 3),
              rgb_colour_error(gold, RgbMetal::fitted, sodium, 1));
}

// A mirror under a white sky is its reflectance, in three lanes that no phase changes.
TEST(RgbMetal, SceneInChannelsShowsTheirReflectance) {
    Scene scene = parse_scene(
        "LookAt 0 0 4  0 0 0  0 1 0\nCamera \"orthographic\" \"float screenwindow\" "
        "[-0.01 0.01 -0.01 0.01]\nFilm \"rgb\" \"integer xresolution\" 1 \"integer yresolution\" "
        "1\nPixelFilter \"box\"\nWorldBegin\nLightSource \"infinite\" \"rgb L\" [1 1 1]\n"
        "Material \"conductor\" \"string material\" \"Au\"\nShape \"disk\"\n",
        "mirror.pbrt");
    for (const RgbMetal way : {RgbMetal::at_primaries, RgbMetal::as_colours, RgbMetal::fitted}) {
        const TracedScene traced(rgb_scene(scene, way));
        const ColourMatching observer = rgb_observer();
        const auto tracer = make_batch_tracer(Transport::scalar, 4, traced.setup(3, observer));
        const RGB expected = rgb_reflectances(dense(published_set("Au")), way, {1.0})[0];
        for (const int samples : {1, 64}) {
            const TracedPicture picture = trace_picture(*tracer, scene.film, 1, samples, 1);
            for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(picture.at(0)[c], expected[c], 2e-6) << c;
        }
    }
    EXPECT_THROW(
        rgb_scene(half_sphere_in_courtyard(2, 2, "Material \"diffuse\""), RgbMetal::fitted),
        std::logic_error);
}

TEST(ChartIlluminants, ThreeBandsHaveTheColourOfDaylight) {
    const auto& lights = chart_illuminants();
    const XYZ day = lights[0].white(), bands = lights[2].white();
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(bands[c], day[c], 1e-6);
    for (const ChartIlluminant& light : lights) {
        for (const double value : light.spectrum) EXPECT_GE(value, 0) << light.name;
    }
}

}  // namespace
}  // namespace drude
