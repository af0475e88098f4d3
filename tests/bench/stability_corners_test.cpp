// The corners that the stability maps' axes do not reach, and what is said beyond them.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "device/virtual/ellipsometer_simulation.h"
#include "fitter/fit.h"
#include "materials/film_stack.h"
#include "materials/film_table.h"
#include "materials/mueller.h"
#include "materials/packet.h"
#include "render/render.h"
#include "temporary_folder.h"

namespace drude {
namespace {

using P = Packet<8>;

OpticalConstants constants(double n, double k) {
    OpticalConstants result;
    result.name = "sample";
    result.kind = "calculated";
    result.wavelength_nm = {100, 10000};
    result.n = {n, n};
    result.k = {k, k};
    return result;
}

void expect_physical(const Reflection<P>& r, const std::string& what) {
    for (const float value : {r.Rs[0], r.Rp[0], r.C[0], r.S[0]}) {
        ASSERT_TRUE(std::isfinite(value)) << what;
    }
    EXPECT_GE(std::min(r.Rs[0], r.Rp[0]), 0) << what;
    EXPECT_LE(std::max(r.Rs[0], r.Rp[0]), 1 + 1e-6) << what;
    const Reflection<double> exact{r.Rs[0], r.Rp[0], r.C[0], r.S[0]};
    if (exact.A() > 1e-12) {
        EXPECT_GE(smallest_coherency_eigenvalue(mueller(exact)), -3e-6) << what;
    }
}

TEST(StabilityCorners, FresnelIsPhysicalAtTheEndsOfItsRange) {
    for (const double n : {least_table_index, 1e-3, 1.0, 1e3, largest_table_index}) {
        for (const double k : {0.0, least_table_index, 1.0, largest_table_index}) {
            for (const double cosine : {0.0, 1e-30, 1e-6, 0.5, 1.0}) {
                expect_physical(reflect(ComplexIndex<P>{P(n), P(k)}, P(cosine)),
                                fmt::format("n {} k {} cosine {}", n, k, cosine));
            }
        }
    }
}

TEST(StabilityCorners, FilmsArePhysicalAtTheEndsOfTheirRange) {
    for (const double n : {least_table_index, 0.3, 1.0, 4.0, 1e3}) {
        for (const double k : {0.0, 1e-3, 1.0, 1e3}) {
            for (const double thickness : {0.0, 1e-30, 1.0, 1e5}) {
                for (const double substrate : {least_table_index, 0.3, 1.5, 1e3}) {
                    for (const double cosine : {1e-6, 0.3, std::sqrt(1 - 0.09), 1.0}) {
                        const ThinFilm<P> film{{P(n), P(k)}, P(thickness)};
                        expect_physical(reflect(&film, 1, ComplexIndex<P>{P(substrate), P(0.0)},
                                                P(cosine), P(550.0)),
                                        fmt::format("n {} k {} of {} nm on {} cosine {}", n, k,
                                                    thickness, substrate, cosine));
                    }
                }
            }
        }
    }
}

// Nothing overflows, however many films there are: quarter-wave pairs reflect all but
// (1.38/2.3)^80.
TEST(StabilityCorners, FortyPairsOfFilmsAreAMirror) {
    std::vector<ThinFilm<P>> films;
    for (int i = 0; i < 40; ++i) {
        films.push_back({{P(2.3), P(0.0)}, P(550 / 4.0 / 2.3)});
        films.push_back({{P(1.38), P(0.0)}, P(550 / 4.0 / 1.38)});
    }
    const Reflection<P> r =
        reflect(films.data(), 80, ComplexIndex<P>{P(1.5), P(0.0)}, P(1.0), P(550.0));
    expect_physical(r, "a mirror of films");
    EXPECT_GT(r.Rs[0], 1 - 1e-6);
}

TEST(StabilityCorners, AnIndexOfOneReflectsNothingHoweverCloseToGrazing) {
    for (const float cosine : {1e-6f, 1e-4f, 1e-2f, 0.3f, 0.8f, 1.0f}) {
        const Reflection<P> r = reflect(ComplexIndex<P>{P(1.0f), P(0.0f)}, P(cosine));
        EXPECT_LT(r.Rs[0], 1e-12f) << cosine;
        EXPECT_LT(r.Rp[0], 1e-12f) << cosine;
    }
}

TEST(StabilityCorners, IndicesThatNoMediumHasAreRefused) {
    const auto refused = [](double n, double k) {
        try {
            constants(n, k).check();
            return false;
        } catch (const Error& error) {
            EXPECT_EQ(error.cause(), Cause::user);
            EXPECT_NE(error.message().find("expected"), std::string::npos);
            return true;
        }
    };
    EXPECT_FALSE(refused(least_table_index, 0));
    EXPECT_FALSE(refused(largest_table_index, largest_table_index));
    EXPECT_FALSE(refused(1e-300, 1));
    EXPECT_TRUE(refused(0, 1));
    EXPECT_TRUE(refused(0.5 * least_table_index, 0));
    EXPECT_TRUE(refused(2 * largest_table_index, 0));
    EXPECT_TRUE(refused(1, 2 * largest_table_index));
    EXPECT_TRUE(refused(1, -1e-9));
    EXPECT_TRUE(refused(std::nan(""), 0));
}

// Of a metal under one clear film, seen in a picture.
Scene scene_with_film(const TemporaryFolder& folder, double n, double thickness_nm) {
    Material material;
    material.name = "coated";
    material.substrate = constants(0.05, 3.09);
    material.layers = {{constants(n, 0), thickness_nm}};
    write_material(folder.file("coated.json"), material);
    return parse_scene(
        "Camera \"perspective\"\nFilm \"rgb\" \"integer xresolution\" 2 \"integer yresolution\" 2\n"
        "WorldBegin\nLightSource \"infinite\"\nMaterial \"conductor\" \"string material\" "
        "\"coated.json\"\nTranslate 0 0 4\nShape \"sphere\"\n",
        folder.file("film.pbrt"));
}

TEST(StabilityCorners, AFilmThatResonatesTooSharplyIsSaidInThePicture) {
    const TemporaryFolder folder;
    RenderOptions options;
    options.samples_per_pixel = 2;
    options.quiet = true;
    const RenderResult fine = render(scene_with_film(folder, 1.5, 300), options);
    EXPECT_TRUE(fine.warnings.empty());
    const RenderResult sharp = render(scene_with_film(folder, 0.9, 10000), options);
    ASSERT_EQ(sharp.warnings.size(), 1U);
    EXPECT_NE(sharp.warnings[0].find("coated: a clear film resonates more sharply"),
              std::string::npos)
        << sharp.warnings[0];
}

TEST(StabilityCorners, AFilmBeyondItsTableIsRefusedWithTheScene) {
    const TemporaryFolder folder;
    EXPECT_NO_THROW(scene_with_film(folder, 1.5, thickest_film_nm));
    try {
        scene_with_film(folder, 1.5, 2 * thickest_film_nm);
        ADD_FAILURE() << "was drawn";
    } catch (const Error& error) {
        EXPECT_EQ(error.cause(), Cause::user);
        EXPECT_NE(error.message().find("200000 nm thick"), std::string::npos) << error.message();
        EXPECT_NE(error.message().find("100000 nm"), std::string::npos) << error.message();
    }
}

// Aluminium at angles below 60 degrees: tan^2 Psi finds n off by twice its standard deviation and
// more, with k along.
TEST(StabilityCorners, TanSquaredPsiSaysWhereItsStandardDeviationsFail) {
    Material material;
    material.name = "Al";
    material.substrate = constants(0.875, 6.233);
    SimulationSetup setup;
    setup.angles_deg = {45, 50, 55, 60};
    setup.wavelengths_nm = {550};
    FitOptions options;
    options.estimator = "rho2";
    const auto warns = [&](const FitOptions& with) {
        const FitResult fit = fit_measurement(simulate_ellipsometer(material, setup), with);
        for (const std::string& warning : fit.warnings) {
            if (warning.find("a standard deviation is above a tenth of n or k") !=
                std::string::npos) {
                return true;
            }
        }
        return false;
    };
    EXPECT_TRUE(warns(options));
    setup.angles_deg = {60, 70, 75, 80};
    EXPECT_FALSE(warns(options));
    setup.angles_deg = {45, 50, 55, 60};
    EXPECT_FALSE(warns({}));
}

}  // namespace
}  // namespace drude
