// What must hold whatever the scene: its scale, its filter, an interrupt, paths without an end; and
// that the stored variance is the variance.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "base/interrupt.h"
#include "materials/scalar.h"
#include "render/pixel_filter.h"
#include "scene/resolution.h"
#include "test_scenes.h"

namespace drude {
namespace {

double mean_of(const Image& image, const char* channel) {
    double sum = 0;
    for (const float value : image.find(channel)->data) sum += static_cast<double>(value);
    return sum / static_cast<double>(image.pixels());
}

// A floor, a light and a metal pyramid `scale` units large.
RenderResult render_at_scale(double scale) {
    const Scene scene = parse_scene(
        fmt::format("LookAt 0 {} {}  0 0 0  0 0 1\nCamera \"perspective\" \"float fov\" 50\n"
                    "Film \"rgb\" \"integer xresolution\" 16 \"integer yresolution\" 16\n"
                    "PixelFilter \"box\"\nWorldBegin\nScale {} {} {}\n",
                    -4 * scale, 2 * scale, scale, scale, scale) +
            "Material \"diffuse\" \"rgb reflectance\" [0.5 0.5 0.5]\n"
            "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
            "  \"point3 P\" [-3 -3 0  3 -3 0  3 3 0  -3 3 0]\n"
            "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [5 5 5]\n"
            "Shape \"trianglemesh\" \"integer indices\" [0 2 1]\n"
            "  \"point3 P\" [-1 -1 2  1 -1 2  0 1 2]\nAttributeEnd\n"
            "Material \"conductor\" \"string material\" \"Cu\" \"string lobe\" \"beckmann\" "
            "\"float beta\" 0.3\nShape \"trianglemesh\" \"integer indices\" [0 1 2 1 3 2 3 0 2]\n"
            "  \"point3 P\" [-0.8 -0.8 0.01  0.8 -0.8 0.01  0 0 1.2  0 0.9 0.01]\n"
            "Translate -1.5 1 0.5\nShape \"sphere\" \"float radius\" 0.4\n",
        "scale.pbrt");
    return render_quietly(scene, 64);
}

TEST(Robustness, APictureDoesNotDependOnTheUnitOfLength) {
    const RenderResult one = render_at_scale(1);
    const double expected = mean_of(one.image, "G");
    ASSERT_GT(expected, 0.05);
    // Below 1e-9 Embree's own products of three lengths leave the range of float.
    for (const double scale : {1e-9, 1e-5, 1e4, 1e10}) {
        SCOPED_TRACE(scale);
        const RenderResult other = render_at_scale(scale);
        EXPECT_NEAR(mean_of(other.image, "G") / expected, 1, 0.01);
        EXPECT_EQ(other.not_finite, 0u);
        EXPECT_EQ(other.projections, 0u);
    }
}

// Whatever the seed: no value that is not a number, in no layer; no wavelength darker than black or
// more than wholly polarised, with filters that are nowhere negative.
TEST(Robustness, EverySceneIsPhysicalAtEverySeed) {
    uint64_t seed = 77;
    for (const auto& entry : std::filesystem::directory_iterator(DRUDE_SOURCE_DIR "/scenes")) {
        if (entry.path().extension() != ".pbrt") continue;
        // Its geometry is not the project's: the reader brings it.
        if (entry.path().filename() == "killeroo-gold.pbrt") continue;
        for (const FilterKind filter :
             {FilterKind::box, FilterKind::triangle, FilterKind::gaussian}) {
            Scene scene = read_scene(entry.path().string());
            set_resolution("12x12", "size", &scene);
            scene.filter.kind = filter;
            scene.filter.radius_x = scene.filter.radius_y = filter == FilterKind::box ? 0.5 : 1.5;
            scene.seed = ++seed * 0x9e3779b97f4a7c15u;
            const RenderResult result = render_quietly(scene, 16, true, true);
            SCOPED_TRACE(
                fmt::format("{} with seed {}", entry.path().filename().string(), scene.seed));
            EXPECT_EQ(result.not_finite, 0u);
            EXPECT_EQ(result.projections, 0u);
            for (const Channel& channel : result.image.channels) {
                for (const float v : channel.data) ASSERT_TRUE(std::isfinite(v)) << channel.name;
            }
            for (int bin = 0; bin < 40; ++bin) {
                std::array<const Channel*, 4> s{};
                for (int i = 0; i < 4; ++i) {
                    s[i] = &result.image.at(
                        fmt::format("S{}.{},500000nm", i, spectrum_first_nm + 10 * bin + 4),
                        "test");
                }
                for (size_t p = 0; p < s[0]->data.size(); ++p) {
                    const double s0 = s[0]->data[p];
                    ASSERT_GE(s0, 0) << s[0]->name;
                    const double polarised =
                        std::hypot(s[1]->data[p], s[2]->data[p], s[3]->data[p]);
                    ASSERT_LE(polarised, s0 * (1 + 1e-5) + 1e-12) << s[0]->name;
                }
            }
        }
    }
}

TEST(Robustness, PerfectMirrorsDoNotHoldAPathForEver) {
    const Scene scene = parse_scene(
        "Camera \"perspective\"\nFilm \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\n"
        "Integrator \"path\" \"integer maxdepth\" 2000000000\nWorldBegin\n"
        "LightSource \"infinite\"\n"
        "Material \"conductor\" \"rgb reflectance\" [1 1 1]\nShape \"sphere\"\n",
        "hall.pbrt");
    const RenderResult result = render_quietly(scene, 16);
    EXPECT_LT(result.rays, 8u * 8 * 16 * 1100);
    // And it is said.
    ASSERT_FALSE(result.warnings.empty());
    EXPECT_NE(result.warnings.back().find("end at random"), std::string::npos);
}

TEST(Robustness, ANarrowGaussianInAWideFilterIsStillOne) {
    Filter filter;
    filter.sigma = 1e-3;
    filter.radius_x = filter.radius_y = 64;
    const PixelFilter narrow(filter);
    double mean = 0, square = 0;
    constexpr int n = 1000;
    for (int i = 0; i < n; ++i) {
        float weight = 0;
        const double x = narrow.offset_x((static_cast<float>(i) + 0.5f) / n, &weight);
        EXPECT_EQ(weight, 1);
        mean += x / n;
        square += x * x / n;
    }
    EXPECT_NEAR(mean, 0, 1e-5);
    EXPECT_NEAR(std::sqrt(square), 1e-3, 2e-5);
}

// Interrupted in the middle, every pixel is the mean of the samples it has got.
TEST(RobustnessDeathTest, AnInterruptLeavesAWholePicture) {
    testing::GTEST_FLAG(death_test_style) = "threadsafe";
    const auto interrupted_in_the_middle = [] {
        const Scene scene = parse_scene(
            "Camera \"perspective\"\n"
            "Film \"rgb\" \"integer xresolution\" 64 \"integer yresolution\" 64\n"
            "WorldBegin\nLightSource \"infinite\"\n",
            "sky.pbrt");
        RenderOptions options;
        options.samples_per_pixel = 512;
        options.wavelengths = 40;
        options.threads = 1;
        options.quiet = true;
        const double whole = render(scene, options).render_seconds;
        catch_interrupts();
        std::thread signal([&] {
            std::this_thread::sleep_for(std::chrono::duration<double>(0.6 * whole));
            std::raise(SIGINT);
        });
        const RenderResult part = render(scene, options);
        signal.join();
        const double sky = mean_of(part.image, "G");
        for (const float g : part.image.find("G")->data) {
            if (!(std::abs(static_cast<double>(g) - sky) < 0.1)) std::exit(1);
        }
        if (!(std::abs(sky - 1) < 0.02)) std::exit(2);
        if (part.samples_per_pixel > 512 || part.samples_per_pixel < 16) std::exit(3);
        std::exit(0);
    };
    EXPECT_EXIT(interrupted_in_the_middle(), testing::ExitedWithCode(0), "");
}

// What an analyser crosses is lost in rounding: that is no light outside the cone of physical
// Stokes vectors.
TEST(Robustness, WhatAnAnalyserTakesAwayIsNoMistake) {
    const Scene scene = parse_scene(
        "LookAt -0.3 0 -1.855 0.25 -0.157 -0.445 0 0 1\n"
        "Camera \"perspective\" \"float fov\" 50 \"float analyser\" 90\n"
        "Film \"rgb\" \"integer xresolution\" 24 \"integer yresolution\" 24\n"
        "PixelFilter \"box\"\nIntegrator \"path\" \"integer maxdepth\" 2\nWorldBegin\n"
        "LightSource \"infinite\" \"rgb L\" [0.9 0.5 1]\n"
        "Material \"coatedconductor\" \"float interface.roughness\" 0 "
        "\"float conductor.roughness\" 0.5\nShape \"disk\"\n",
        "crossed.pbrt");
    RenderOptions options;
    options.samples_per_pixel = 256;
    options.stokes = true;
    options.quiet = true;
    EXPECT_EQ(render(scene, options).projections, 0u);
}

TEST(Robustness, ShapesWithoutMaterialAreNotThere) {
    Scene scene = sphere_under_sky("Material \"diffuse\"", 4);
    scene.shapes[0].material = -1;
    const RenderResult result = render_quietly(scene, 64);
    EXPECT_NEAR(mean_of(result.image, "G"), 1, 0.05);
}

// The picture says on which instruction set it was made: naming that set gives the same bits.
TEST(Robustness, ThePictureNamesItsInstructionSet) {
    const Scene scene = sphere_under_sky("Material \"conductor\" \"float roughness\" 0.2", 16);
    const RenderResult result = render_quietly(scene, 16);
    const std::string set = result.image.text("instructionSet");
    RenderOptions options;
    options.samples_per_pixel = 16;
    options.quiet = true;
    options.isa = set.substr(set.find('/') + 1);
    const RenderResult again = render(scene, options);
    EXPECT_EQ(again.image.text("instructionSet"), set);
    EXPECT_EQ(again.image.find("G")->data, result.image.find("G")->data);
}

TEST(Robustness, TheStoredVarianceIsThatOverSeeds) {
    Scene scene = sphere_under_sky(
        "LightSource \"distant\" \"point3 from\" [1 1 -2]\n"
        "Material \"diffuse\" \"rgb reflectance\" [0.6 0.6 0.6]\n"
        "Shape \"sphere\" \"float radius\" 0.5\nTranslate 0.9 0 0\n"
        "Material \"conductor\" \"string material\" \"Cu\" \"string lobe\" \"beckmann\" "
        "\"float beta\" 0.4\n",
        20);
    constexpr int seeds = 24;
    const size_t pixels = 400;
    std::vector<double> sum(pixels, 0), squares(pixels, 0);
    double stored = 0, truth = 0;
    for (int seed = 0; seed < seeds; ++seed) {
        RenderOptions options;
        options.samples_per_pixel = 128;
        options.seed = 50 + seed;
        options.quiet = true;
        const RenderResult result = render(scene, options);
        ASSERT_EQ(result.batches, 8);
        for (size_t p = 0; p < pixels; ++p) {
            const double g = result.image.find("G")->data[p];
            sum[p] += g;
            squares[p] += g * g;
            stored += static_cast<double>(result.image.find("variance.G")->data[p]) / seeds;
        }
    }
    for (size_t p = 0; p < pixels; ++p) {
        truth += (squares[p] - sum[p] * sum[p] / seeds) / (seeds - 1);
    }
    EXPECT_NEAR(stored / truth, 1, 0.1);
}

}  // namespace
}  // namespace drude
