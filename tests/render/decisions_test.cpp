// What is chosen by itself: for each decision a scene where the richer model shows nothing and the
// cheap one is taken, and one where it shows and is taken.
#include "render/decisions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "image/compare.h"
#include "materials/film_effect.h"
#include "materials/film_stack.h"
#include "materials/film_table.h"
#include "render/batch_tracer.h"
#include "render/bounce_choice.h"
#include "render/light_choice.h"
#include "render/sampler_choice.h"
#include "render/surface_model.h"

#include "render/test_scenes.h"
#include "render/transport_choice.h"
#include "render/wavelength_choice.h"

namespace drude {
namespace {

const std::string sky = "LightSource \"infinite\" \"rgb L\" [1 1 1]\n";
const std::string lamp =
    "AttributeBegin\nAreaLightSource \"diffuse\" \"bool twosided\" true \"rgb L\" [4 4 "
    "4]\nMaterial \"diffuse\" \"rgb "
    "reflectance\" [0 0 0]\nTranslate 0 0 3\nShape \"disk\" \"float radius\" 1.5\nAttributeEnd\n";
const std::string rough_copper =
    "Material \"conductor\" \"string material\" \"Cu\" \"string lobe\" \"beckmann\" \"float "
    "beta\" 0.2\n";

Scene scene_of(const std::string& world, int size = 24, int max_depth = 12) {
    return parse_scene(fmt::format("LookAt 0 -5 1  0 0 0  0 0 1\n"
                                   "Camera \"perspective\" \"float fov\" 40\n"
                                   "Film \"rgb\" \"integer xresolution\" {} \"integer yresolution\""
                                   " {}\nPixelFilter \"box\"\nIntegrator \"path\" \"integer "
                                   "maxdepth\" {}\nWorldBegin\n{}",
                                   size, size, max_depth, world),
                       "decision.pbrt");
}

RenderResult picture(const Scene& scene, RenderOptions options, int samples = 256,
                     uint64_t seed = 1) {
    options.samples_per_pixel = samples;
    options.seed = seed;
    options.quiet = true;
    return render(scene, options);
}

Comparison compared(const RenderResult& a, const RenderResult& b) {
    CompareOptions options;
    options.any_scene = true;
    return compare_images(a.image, b.image, "a", "b", options);
}

double mean(const RenderResult& result, const std::string& channel) {
    const std::vector<float>& data = result.image.at(channel, "test").data;
    double sum = 0;
    for (const float value : data) sum += static_cast<double>(value);
    return sum / static_cast<double>(data.size());
}

const ModelDecision& decision_on(const std::vector<ModelDecision>& all, const std::string& name) {
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const ModelDecision& d) { return d.name == name; });
    if (found == all.end()) throw std::logic_error("no decision on " + name);
    return *found;
}

Scene filmed_sphere(double thickness_nm, double spread_nm = 0) {
    Scene scene = scene_of(sky + rough_copper + "Shape \"sphere\"\n");
    auto& metal = std::get<ConductorMaterial>(scene.materials[scene.shapes[0].material]);
    metal.surface.layers = {{published_set("Al2O3-Malitson-o"), thickness_nm, spread_nm}};
    return scene;
}

// ---- every decision is complete, and is what the renderer does ---------------------------------

TEST(Decisions, EachHasAReasonAFigureAndAnOption) {
    for (const std::string& world :
         {sky + rough_copper + "Shape \"sphere\"\n", lamp + rough_copper + "Shape \"sphere\"\n",
          std::string("Material \"dielectric\"\nShape \"sphere\"\n"), std::string()}) {
        const std::vector<ModelDecision> all = decisions(scene_of(world), {});
        EXPECT_EQ(all.size(), 8u);
        for (const ModelDecision& decision : all) {
            EXPECT_FALSE(decision.choice.empty()) << decision.name;
            EXPECT_FALSE(decision.reason.empty()) << decision.name;
            EXPECT_FALSE(decision.override_option.empty()) << decision.name;
            EXPECT_FALSE(decision.asked) << decision.name;
            for (const DecisionFigure& figure : {decision.cost, decision.error}) {
                EXPECT_FALSE(figure.basis.empty()) << decision.name;
                if (!figure.value) continue;
                EXPECT_FALSE(figure.unit.empty()) << decision.name;
                EXPECT_GE(*figure.value, 0) << decision.name;
                EXPECT_TRUE(std::isfinite(*figure.value)) << decision.name;
            }
        }
    }
}

TEST(Decisions, AreThoseOfTheRender) {
    for (const std::string& world :
         {sky + rough_copper + "Shape \"sphere\"\n", lamp + rough_copper + "Shape \"sphere\"\n"}) {
        const Scene scene = scene_of(world, 4);
        RenderOptions options;
        options.samples_per_pixel = 16;
        options.quiet = true;
        const std::vector<ModelDecision> all = decisions(scene, options);
        const RenderResult result = render(scene, options);
        EXPECT_EQ(decision_on(all, "transport").choice, transport_name(result.transport));
        EXPECT_EQ(decision_on(all, "wavelengths a path").choice,
                  fmt::format("{}", result.wavelengths));
        EXPECT_NE(decision_on(all, "sampler")
                      .choice.find(fmt::format("batches of {}", result.batch_size)),
                  std::string::npos);
    }
}

TEST(Decisions, SayWhatWasAskedFor) {
    RenderOptions options;
    options.transport = Transport::stokes;
    options.wavelengths = 16;
    options.sample_every_light = true;
    options.mirror_below = 0;
    options.films = FilmUse::keep;
    const auto all = decisions(scene_of(sky + rough_copper + "Shape \"sphere\"\n"), options);
    for (const std::string name : {"transport", "wavelengths a path", "light sampling",
                                   "mirror or lobe", "film or bare metal"}) {
        EXPECT_TRUE(decision_on(all, name).asked) << name;
    }
}

// The first order in which scalar transport is wrong is what the decision states at most.
TEST(Decisions, TheErrorOfScalarTransportIsBounded) {
    const Scene scene = scene_of(
        sky + lamp +
            "Material \"conductor\" \"string material\" \"Cu\"\n"
            "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" [-3 -3 -1  3 "
            "-3 -1  3 3 -1  -3 3 -1]\n"
            "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" [-3 2 -1  3 "
            "2 -1  3 2 4  -3 2 4]\n",
        24, 2);
    const ModelDecision transport = decision_on(decisions(scene, {}), "transport");
    ASSERT_EQ(transport.choice, "intensity");
    ASSERT_EQ(transport.alternatives[0].choice, "scalar");
    const double stated = transport.alternatives[0].error.value.value();
    EXPECT_GT(stated, 0.01);
    EXPECT_LT(stated, 0.2);
    RenderOptions scalar;
    scalar.transport = Transport::scalar;
    const auto exact = picture(scene, {}).image.at("G", "test").data;
    const auto wrong = picture(scene, scalar).image.at("G", "test").data;
    double worst = 0;
    for (size_t i = 0; i < exact.size(); ++i) {
        if (!(exact[i] > 1e-3f)) continue;
        worst = std::max(worst, static_cast<double>(std::abs(wrong[i] - exact[i]) / exact[i]));
    }
    EXPECT_GT(worst, 1e-3);
    EXPECT_LT(worst, stated);
}

// ---- wavelengths a path ------------------------------------------------------------------------

TEST(Decisions, FewWavelengthsDoForColours) {
    const Scene scene = scene_of(sky + rough_copper + "Shape \"sphere\"\n");
    EXPECT_LT(cheapest_exact_wavelengths(scene, {}).wavelengths, spectral_bins);
    RenderOptions all;
    all.wavelengths = spectral_bins;
    const Comparison same = compared(picture(scene, {}, 256, 1), picture(scene, all, 256, 2));
    EXPECT_TRUE(same.same) << same.reason;
}

TEST(Decisions, SpectralLayersTakeAllWavelengths) {
    const Scene scene = scene_of(sky + rough_copper + "Shape \"sphere\"\n", 4);
    RenderOptions spectral;
    spectral.spectral = true;
    EXPECT_EQ(cheapest_exact_wavelengths(scene, spectral).wavelengths, spectral_bins);
    EXPECT_EQ(picture(scene, spectral, 16).wavelengths, spectral_bins);
    // With fewer some layers of a path would be empty; there is no such picture.
    spectral.wavelengths = 8;
    EXPECT_THROW(picture(scene, spectral, 16), Error);
}

// ---- bounces -----------------------------------------------------------------------------------

TEST(Decisions, AConvexShapeReflectsOnce) {
    for (const std::string& lights :
         {sky, sky + "LightSource \"point\" \"point3 from\" [3 -4 5]\n"}) {
        const Scene scene = scene_of(lights + rough_copper + "Shape \"sphere\" \"float zmin\" 0\n");
        const BounceChoice choice = bounce_choice(scene);
        EXPECT_EQ(choice.reflections, 1);
        EXPECT_FALSE(choice.limited);
        RenderOptions every;
        every.trace_every_ray = true;
        const RenderResult cheap = picture(scene, {}, 64), rich = picture(scene, every, 64);
        EXPECT_LT(cheap.rays, rich.rays);
        for (const char* channel : {"R", "G", "B"}) {
            EXPECT_EQ(cheap.image.at(channel, "test").data, rich.image.at(channel, "test").data);
        }
    }
}

// Grooves of 45 degrees, 4 thousandths deep: far from the origin that is less than a millionth of
// their coordinates, which are exact all the same.
TEST(Decisions, ReliefIsNotFlatHoweverLargeItsCoordinates) {
    const auto grooves = [](double x, double depth) {
        std::string points, indices;
        for (const double y : {-0.015625, 0.015625}) {
            for (int i = 0; i < 5; ++i) {
                points += fmt::format("{} {} {} ", x + (i - 2) * 0.00390625, y, i % 2 * -depth);
            }
        }
        for (int i = 0; i < 4; ++i) {
            indices += fmt::format("{0} {1} {2} {0} {2} {3} ", i, i + 1, i + 6, i + 5);
        }
        return scene_of(sky + rough_copper + fmt::format("Translate {} 0 0\n", -x) +
                        "Shape \"trianglemesh\" \"point3 P\" [" + points +
                        "] \"integer indices\" [" + indices + "]\n");
    };
    for (const double x : {0.0, 1024.0, 16384.0}) {
        EXPECT_GT(bounce_choice(grooves(x, 0.00390625)).reflections, 1) << x;
        EXPECT_EQ(bounce_choice(grooves(x, 0)).reflections, 1) << x;
    }
}

// A plane whose corners single precision moved off it by their last digits is flat all the same.
TEST(Decisions, ATurnedPlaneIsFlat) {
    std::string points, indices;
    constexpr int n = 8;
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
            const double u = 1.0 * i / n - 0.5, v = 1.0 * j / n - 0.5;
            points += fmt::format("{} {} {} ", 0.36 * u - 0.8 * v, 0.48 * u + 0.6 * v, 0.8 * u);
        }
    }
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const int at = i * (n + 1) + j;
            indices += fmt::format("{0} {1} {2} {1} {3} {2} ", at, at + 1, at + n + 1, at + n + 2);
        }
    }
    const Scene scene = scene_of(sky + rough_copper + "Shape \"trianglemesh\" \"point3 P\" [" +
                                 points + "] \"integer indices\" [" + indices + "]\n");
    EXPECT_EQ(bounce_choice(scene).reflections, 1);
}

TEST(Decisions, BlackScenesReflectNothing) {
    EXPECT_EQ(bounce_choice(scene_of(lamp)).reflections, 0);
    // A lamp beside a convex metal is met by what the metal reflects, so that rays are traced.
    const BounceChoice beside = bounce_choice(scene_of(lamp + rough_copper + "Shape \"sphere\"\n"));
    EXPECT_EQ(beside.reflections, 1);
    EXPECT_GT(beside.clear_after, 1);
}

TEST(Decisions, SurfacesThatSeeEachOtherReflectOften) {
    const Scene scene = scene_of(sky + rough_copper +
                                 "AttributeBegin\nTranslate -1.05 0 0\nShape "
                                 "\"sphere\"\nAttributeEnd\nAttributeBegin\nTranslate 1.05 0 "
                                 "0\nShape \"sphere\"\nAttributeEnd\n");
    const BounceChoice choice = bounce_choice(scene);
    EXPECT_EQ(choice.reflections, scene.max_depth);
    EXPECT_TRUE(choice.limited);
    Scene once = scene;
    once.max_depth = 1;
    const Comparison cut = compared(picture(once, {}, 256, 1), picture(scene, {}, 256, 2));
    EXPECT_FALSE(cut.same) << cut.reason;
    EXPECT_LT(cut.all.mean_error, 0);
    // The stated loss is that of surroundings that are closed; here more light escapes.
    const ModelDecision bounces = decision_on(decisions(scene, {}), "bounces");
    ASSERT_EQ(bounces.alternatives[0].choice, "1");
    const double lost = -cut.all.mean_error / mean(picture(scene, {}, 256, 2), "G");
    EXPECT_LT(lost, bounces.alternatives[0].error.value.value());
}

// Inside a closed sphere that shines and reflects alike the loss is the stated one.
TEST(Decisions, WhatACutLosesIsExactInAClosedFurnace) {
    const auto furnace = [](int max_depth) {
        return parse_scene(
            fmt::format("Camera \"perspective\"\nFilm \"rgb\" \"integer xresolution\" 8 \"integer "
                        "yresolution\" 8\nPixelFilter \"box\"\nIntegrator \"path\" \"integer "
                        "maxdepth\" {}\nWorldBegin\nAreaLightSource \"diffuse\" \"bool twosided\" "
                        "true \"rgb L\" [1 1 1]\nMaterial \"diffuse\" \"rgb reflectance\" [0.5 0.5 "
                        "0.5]\nShape \"sphere\"\n",
                        max_depth),
            "furnace.pbrt");
    };
    const Scene scene = furnace(3);
    const ModelDecision bounces = decision_on(decisions(scene, {}), "bounces");
    EXPECT_NEAR(bounces.error.value.value(), std::pow(0.5, 4), 2e-3);
    const double rest = 1 - mean(picture(scene, {}), "G") / mean(picture(furnace(60), {}), "G");
    EXPECT_NEAR(rest, bounces.error.value.value(), 0.004);
}

// ---- light sampling ----------------------------------------------------------------------------

TEST(Decisions, AConstantSkyIsLeftToTheLobes) {
    for (const std::string& surface : {rough_copper, std::string("Material \"diffuse\"\n")}) {
        const Scene scene = scene_of(sky + surface + "Shape \"sphere\"\n");
        EXPECT_FALSE(light_choice(scene, {}).any);
        RenderOptions every;
        every.sample_every_light = true;
        every.trace_every_ray = true;
        const RenderResult cheap = picture(scene, {}, 256, 1), rich = picture(scene, every, 256, 2);
        const Comparison same = compared(cheap, rich);
        EXPECT_TRUE(same.same) << same.reason;
        EXPECT_LT(cheap.rays, rich.rays);
        EXPECT_LT(mean(cheap, "variance.G"), mean(rich, "variance.G"));
    }
}

TEST(Decisions, LightsThatStandOutAreSampled) {
    // A distant light of irradiance pi on a Lambertian floor, which lobes never find: radiance is
    // the reflectance times the cosine.
    const Scene scene = scene_of(
        "LightSource \"distant\" \"rgb L\" [1 1 1] \"float illuminance\" 3.14159265 \"point3 from\""
        " [0 0 5] \"point3 to\" [0 0 0]\nMaterial \"diffuse\" \"rgb reflectance\" [0.5 0.5 0.5]\n"
        "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" [-90 -90 -1  90 -90 "
        "-1  90 90 -1  -90 90 -1]\n",
        8);
    const LightChoice choice = light_choice(scene, {});
    EXPECT_TRUE(choice.any);
    EXPECT_FALSE(choice.constant_skies);
    const RenderResult result = picture(scene, {}, 64);
    EXPECT_NEAR(static_cast<double>(result.image.at("G", "test").data.back()), 0.5, 2e-3);
    EXPECT_TRUE(light_choice(scene_of(sky + lamp), {}).any);
    EXPECT_FALSE(light_choice(scene_of(sky + lamp), {}).constant_skies);
}

// ---- mirror or lobe ----------------------------------------------------------------------------

std::string narrow_copper(double beta) {
    return fmt::format(
        "Material \"conductor\" \"string material\" \"Cu\" \"string lobe\" \"beckmann\" \"float "
        "beta\" {}\n",
        beta);
}

TEST(Decisions, ANarrowLobeUnderLampsIsAMirror) {
    const Scene scene = scene_of(sky + lamp + narrow_copper(5e-6) + "Shape \"sphere\"\n");
    EXPECT_EQ(surface_model(scene, {}).lobe_width(5e-6), 0);
    RenderOptions lobes;
    lobes.mirror_below = 0;
    EXPECT_EQ(surface_model(scene, lobes).lobe_width(5e-6), mirror_below_beta);
    const Comparison same = compared(picture(scene, {}, 256, 1), picture(scene, lobes, 256, 2));
    EXPECT_TRUE(same.same) << same.reason;
    const ModelDecision decision = decision_on(decisions(scene, {}), "mirror or lobe");
    EXPECT_LT(decision.error.value.value(), 1e-3);
    EXPECT_GT(decision.error.value.value(), 0);
}

// Rays straight down on copper under a distant light straight above: the half vector is the normal
// everywhere, and the radiance E R D(0)/4 with Beckmann's D(0) = 1/(pi beta^2).
TEST(Decisions, ANarrowLobeUnderADistantLightStaysALobe) {
    const auto scene = parse_scene(
        "LookAt 0 0 5  0 0 0  0 1 0\nCamera \"orthographic\"\nFilm \"rgb\" \"integer "
        "xresolution\" 4 \"integer yresolution\" 4\nPixelFilter \"box\"\nIntegrator \"path\"\n"
        "WorldBegin\nLightSource \"distant\" \"rgb L\" [1 1 1] \"point3 from\" [0 0 1] \"point3 "
        "to\" [0 0 0]\n" +
            narrow_copper(2e-5) + "Shape \"disk\" \"float radius\" 9\n",
        "glint.pbrt");
    const auto with_beta = [&](double beta) {
        Scene copy = scene;
        std::get<ConductorMaterial>(copy.materials[copy.shapes[0].material]).surface.beta = beta;
        return copy;
    };
    const double at_2e5 = mean(picture(with_beta(2e-5), {}, 16), "G");
    EXPECT_GT(at_2e5, 1e7);
    // Drawn as wide as 1e-5, so four times as bright as twice that width; never black.
    EXPECT_NEAR(mean(picture(with_beta(5e-6), {}, 16), "G") / at_2e5, 4, 0.02);
    EXPECT_NEAR(mean(picture(with_beta(1e-5), {}, 16), "G") / at_2e5, 4, 0.02);
    RenderOptions mirrors;
    mirrors.mirror_below = mirror_below_beta;
    EXPECT_EQ(mean(picture(with_beta(5e-6), mirrors, 16), "G"), 0);
    const ModelDecision decision = decision_on(decisions(with_beta(5e-6), {}), "mirror or lobe");
    EXPECT_EQ(decision.error.value.value(), 0);
    EXPECT_EQ(decision.alternatives[0].error.value.value(), 1);
}

// A flat mirror before an edge of light: what a pixel at the edge changes by stays in the bound.
TEST(Decisions, TheErrorOfAMirrorIsBounded) {
    const double beta = 2e-3;
    const Scene scene = scene_of(
        "AttributeBegin\nAreaLightSource \"diffuse\" \"bool twosided\" true \"rgb L\" [1 1 "
        "1]\nMaterial \"diffuse\" \"rgb reflectance\" [0 0 0]\nShape \"trianglemesh\" \"integer "
        "indices\" [0 1 2 0 2 3] \"point3 P\" [0 4 -40  40 4 -40  40 4 40  0 4 "
        "40]\nAttributeEnd\n" +
            narrow_copper(beta) +
            "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" [-30 -3.5 -1  "
            "30 "
            "-3.5 -1  30 3.9 -1  -30 3.9 -1]\n",
        64);
    RenderOptions mirrors;
    mirrors.mirror_below = 0.1;
    const auto lobe = picture(scene, {}, 1024).image.at("G", "test").data;
    const auto mirror = picture(scene, mirrors, 1024).image.at("G", "test").data;
    const double bound = mirror_error(lobe_blur(Lobe::beckmann, beta), pixel_angle(scene));
    double worst = 0;
    for (size_t i = 0; i < lobe.size(); ++i) {
        worst = std::max(worst, static_cast<double>(std::abs(lobe[i] - mirror[i])));
    }
    EXPECT_GT(worst, bound / 5);
    EXPECT_LT(worst, bound);
}

// ---- film or bare metal ------------------------------------------------------------------------

TEST(Decisions, AFilmThatNobodySeesIsLeftOut) {
    const Scene scene = filmed_sphere(0.001);
    const Material& metal =
        std::get<ConductorMaterial>(scene.materials[scene.shapes[0].material]).surface;
    EXPECT_LT(film_effect(metal), negligible_film_effect);
    EXPECT_FALSE(surface_model(scene, {}).keeps_films(metal));
    RenderOptions keep;
    keep.films = FilmUse::keep;
    const auto cheap = picture(scene, {}, 64).image.at("G", "test").data;
    const auto rich = picture(scene, keep, 64).image.at("G", "test").data;
    // The same samples: what differs is the reflectance.
    for (size_t i = 0; i < cheap.size(); ++i) EXPECT_NEAR(cheap[i], rich[i], 4e-4f);
    EXPECT_EQ(decision_on(decisions(scene, {}), "film or bare metal").choice, "bare metal");
}

TEST(Decisions, AFilmThatShowsIsKept) {
    const Scene scene = filmed_sphere(60);
    RenderOptions bare;
    bare.films = FilmUse::leave_out;
    const ModelDecision decision = decision_on(decisions(scene, {}), "film or bare metal");
    EXPECT_EQ(decision.choice, "film");
    const Comparison without = compared(picture(scene, bare, 256, 1), picture(scene, {}, 256, 2));
    EXPECT_FALSE(without.same) << without.reason;
    EXPECT_LT(without.all.max_error, decision.alternatives[0].error.value.value() + 0.05);
}

// ---- table or formula --------------------------------------------------------------------------

double table_against_formula(double thickness_nm) {
    const Scene scene = filmed_sphere(thickness_nm);
    const Material& metal =
        std::get<ConductorMaterial>(scene.materials[scene.shapes[0].material]).surface;
    const FilmTable table(metal, 8);
    double worst = 0;
    for (int phase = 0; phase < 50; phase += 7) {
        const Reflection<Packet<8>> r = table.at<8>(0.6f, phase);
        for (int lane = 0; lane < 8; ++lane) {
            const double nm = spectrum_first_nm + phase + 50 * lane;
            const Index film = metal.layers[0].constants.at(nm), base = metal.substrate.at(nm);
            const ThinFilm<double> layer{{film.n, film.k}, thickness_nm};
            const Reflection<double> exact =
                reflect(&layer, 1, ComplexIndex<double>{base.n, base.k}, 0.6, nm);
            worst = std::max(worst, std::abs(static_cast<double>(r.C[lane]) - exact.C));
        }
    }
    return worst;
}

TEST(Decisions, ThinFilmsAreWhatTheirFormulaSays) {
    // Single precision and a nanometre's mean beside the table's own tolerance.
    EXPECT_LT(table_against_formula(60), 1e-3);
    EXPECT_NE(decision_on(decisions(filmed_sphere(60), {}), "table or formula")
                  .reason.find("smooth over a nanometre"),
              std::string::npos);
}

TEST(Decisions, ThickFilmsAreAveragedOverEachNanometre) {
    EXPECT_GT(table_against_formula(60000), 0.1);
    EXPECT_NE(decision_on(decisions(filmed_sphere(60000), {}), "table or formula")
                  .reason.find("turn within a nanometre"),
              std::string::npos);
}

// ---- sampler -----------------------------------------------------------------------------------

// Mean square errors against `reference` of 16 samples a pixel that share the space out, and of 16
// independent ones.
std::pair<double, double> sampling_errors(const Scene& scene) {
    const std::vector<float> reference = picture(scene, {}, 16384, 99).image.at("G", "test").data;
    const auto error = [&](const std::vector<double>& values) {
        double sum = 0;
        for (size_t i = 0; i < values.size(); ++i) {
            const double d = values[i] - static_cast<double>(reference[i]);
            sum += d * d;
        }
        return sum;
    };
    double shared = 0, independent = 0;
    for (uint64_t round = 0; round < 8; ++round) {
        const auto once = picture(scene, {}, 16, 1 + round).image.at("G", "test").data;
        shared += error({once.begin(), once.end()});
        std::vector<double> sum(once.size());
        for (uint64_t i = 0; i < 16; ++i) {
            const auto one =
                picture(scene, {}, 1, 1000 + 16 * round + i).image.at("G", "test").data;
            for (size_t p = 0; p < sum.size(); ++p) sum[p] += static_cast<double>(one[p]) / 16;
        }
        independent += error(sum);
    }
    return {shared, independent};
}

TEST(Decisions, SharedOutSamplesAreBetterWhereLightIsSmooth) {
    const auto [shared, independent] =
        sampling_errors(scene_of(sky + rough_copper + "Shape \"sphere\"\n", 12));
    EXPECT_LT(2 * shared, independent);
}

TEST(Decisions, SharedOutSamplesAreNoWorseWhereLightIsScattered) {
    // Diffuse walls that see each other: the error comes from where paths go after some bounces.
    const Scene scene = scene_of(
        "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [9 9 9]\nMaterial \"diffuse\" "
        "\"rgb reflectance\" [0 0 0]\nTranslate 0 4 0\nShape \"sphere\" \"float radius\" "
        "0.2\nAttributeEnd\nMaterial \"diffuse\" \"rgb reflectance\" [0.8 0.8 0.8]\nShape "
        "\"sphere\" \"float radius\" 8\nShape \"sphere\" \"float radius\" 1\n",
        12);
    const auto [shared, independent] = sampling_errors(scene);
    EXPECT_LT(shared, 1.1 * independent);
}

TEST(Decisions, BatchesFollowFromTheSamples) {
    const Scene scene = scene_of(sky);
    const auto batch = [&](int samples) {
        RenderOptions options;
        options.samples_per_pixel = samples;
        return sampler_choice(scene, options).batch_size;
    };
    EXPECT_EQ(batch(1), 1);
    EXPECT_EQ(batch(2), 1);
    EXPECT_EQ(batch(16), 8);
    EXPECT_EQ(batch(32), 16);
    EXPECT_EQ(batch(1000000), 16);
    EXPECT_EQ(batch(2000000), 32);
    RenderOptions timed;
    timed.seconds = 1;
    EXPECT_FALSE(sampler_choice(scene, timed).samples.has_value());
}

}  // namespace
}  // namespace drude
