// Every way of looking for light gives the same picture in the mean; under a lamp, whose light both
// lobes and light samples find, the usual one with the least noise.
#include <gtest/gtest.h>

#include <cmath>

#include "materials/spectrum.h"
#include "render/batch_tracer.h"
#include "render/courtyard.h"
#include "render/test_scenes.h"

namespace drude {
namespace {

using Directions = SamplingStrategy::Directions;

struct Outcome {
    double mean = 0, sigma = 0;  // of the picture's mean; its standard error
    double noise = 0;            // mean variance of a batch
};

Outcome trace(const Scene& scene, const SamplingStrategy& strategy) {
    const Geometry geometry(scene);
    const OpticalElements elements(scene, "");
    const NumberTextures numbers(scene);
    const Lights lights(scene, geometry, strategy);
    const CameraRays camera(scene.camera, scene.film.width, scene.film.height);
    const PixelFilter filter(scene.filter);
    TracerSetup setup{scene,  geometry, lights, elements,       numbers,
                      camera, filter,   5,      scene.max_depth};
    setup.strategy = strategy;
    const auto tracer = make_batch_tracer(Transport::intensity, 8, setup);
    constexpr uint32_t batches = 48;
    PathStatistics statistics;
    Outcome outcome;
    double variance = 0;
    const int pixels = scene.film.width * scene.film.height;
    for (int p = 0; p < pixels; ++p) {
        double sum = 0, squares = 0;
        for (uint32_t b = 0; b < batches; ++b) {
            BatchResult result;
            tracer->trace({p % scene.film.width, p / scene.film.width, b, 16}, &result,
                          &statistics);
            const double value = result.rgb[0][0] + result.rgb[0][1] + result.rgb[0][2];
            sum += value / batches;
            squares += value * value / batches;
        }
        const double spread = (squares - sum * sum) * batches / (batches - 1);
        outcome.mean += sum / pixels;
        outcome.noise += spread / pixels;
        variance += spread / batches / (static_cast<double>(pixels) * pixels);
    }
    outcome.sigma = std::sqrt(variance);
    EXPECT_EQ(statistics.not_finite, 0u);
    EXPECT_EQ(statistics.projections, 0u);
    return outcome;
}

void expect_same_mean(const Scene& scene, bool noise_is_of_directions) {
    const Outcome usual = trace(scene, {});
    EXPECT_GT(usual.mean, 0);
    const SamplingStrategy others[] = {{Directions::lobe, true, true},
                                       {Directions::light, false, true},
                                       // Where lights are never sampled the lobe stands in.
                                       {Directions::light, true, true},
                                       {Directions::both, false, true},
                                       {Directions::both, true, false},
                                       {Directions::lobe, true, false}};
    for (const SamplingStrategy& strategy : others) {
        const Outcome other = trace(scene, strategy);
        EXPECT_NEAR(other.mean, usual.mean, 4 * std::hypot(other.sigma, usual.sigma))
            << static_cast<int>(strategy.directions) << strategy.compensated_environments
            << strategy.visible_normals;
        const bool is_same = strategy.directions == Directions::both && strategy.visible_normals;
        if (noise_is_of_directions && !is_same) {
            EXPECT_GT(other.noise, 1.02 * usual.noise)
                << static_cast<int>(strategy.directions) << strategy.visible_normals;
        }
    }
}

std::string rough_copper(const std::string& lobe) {
    return "Material \"conductor\" \"string material\" \"Cu\" \"float beta\" 0.5 " + lobe;
}

TEST(SamplingStrategy, ChangesNoMeanUnderASky) {
    for (const char* lobe : {"\"string lobe\" \"trowbridge-reitz\" \"string masking\" \"smith\"",
                             "\"string lobe\" \"beckmann\" \"string masking\" \"smith\"",
                             "\"string lobe\" \"blinn-phong\" \"string masking\" \"v-groove\""}) {
        Scene scene = sphere_under_sky(rough_copper(lobe), 8);
        InfiniteLight& sky = scene.infinite_lights[0];
        sky.image = "courtyard";
        sky.picture = std::make_shared<const Image>(make_courtyard(64));
        expect_same_mean(scene, false);
    }
}

TEST(SamplingStrategy, ChangesNoMeanUnderALampAndACoat) {
    expect_same_mean(
        parse_scene("LookAt 0 -4 1  0 0 0  0 0 1\nCamera \"perspective\" \"float fov\" 40\n"
                    "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\n"
                    "PixelFilter \"box\"\nIntegrator \"path\" \"integer maxdepth\" 6\n"
                    "WorldBegin\nAttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [5 5 5]\n"
                    "Material \"diffuse\"\nTranslate 0 -2 3\nShape \"sphere\" \"float radius\" 1\n"
                    "AttributeEnd\nMaterial \"coatedconductor\" \"float interface.roughness\" 0.1 "
                    "\"float conductor.roughness\" 0.4\nTranslate 0 0 -1.2\nShape \"sphere\"\n"
                    "Material \"conductor\" \"string material\" \"Al\" \"string lobe\" "
                    "\"gaussian\" \"float beta\" 0.3\nTranslate 1 0 1\nShape \"sphere\" \"float "
                    "radius\" 0.6\n",
                    "coat.pbrt"),
        true);
}

TEST(SamplingStrategy, RefusesLightsThatLobesNeverFind) {
    for (const char* light : {"distant", "point"}) {
        Scene scene = parse_scene(
            fmt::format("Film \"rgb\" \"integer xresolution\" 2 \"integer yresolution\" 2\n"
                        "PixelFilter \"box\"\nWorldBegin\nLightSource \"{}\"\nShape \"sphere\"\n",
                        light),
            "light.pbrt");
        try {
            trace(scene, {Directions::lobe, true, true});
            FAIL() << light;
        } catch (const Error& error) {
            EXPECT_NE(error.message().find("light.pbrt:4:1"), std::string::npos) << error.message();
        }
    }
}

}  // namespace
}  // namespace drude
