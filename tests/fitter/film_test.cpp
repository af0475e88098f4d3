// Films of unknown thickness and porosity on a known substrate.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/numbers.h"
#include "film_cases.h"
#include "fitter/fit.h"
#include "fitter/fitted_material.h"
#include "fitter/import.h"
#include "fitter/named_constants.h"
#include "fitter/substrate_choice.h"
#include "shared_data.h"

namespace drude {
namespace {

double value_of(const FitResult& fit, const std::string& name) {
    if (const FittedParameter* found = fit.find(name)) return found->value;
    ADD_FAILURE() << "no parameter " << name;
    return 0;
}

double sigma_of(const FitResult& fit, const std::string& name) {
    if (const FittedParameter* found = fit.find(name)) return found->sigma;
    ADD_FAILURE() << "no parameter " << name;
    return 0;
}

// Independent implementation (numpy): 3000 nm on aluminium at 60 degrees, a tenth of it pores; and
// the substrate bare.
TEST(Film, ReflectsWhatAnIndependentImplementationFinds) {
    const double expected[][3] = {
        {380, 44.95, 110.2}, {500, 46.60, 207.8}, {580, 43.14, 153.3}, {700, 47.22, 138.3}};
    const Material sample = anodised(3000, 0.1, {380, 500, 580, 700});
    SimulationSetup setup;
    setup.angles_deg = {60};
    setup.wavelengths_nm = {380, 500, 580, 700};
    setup.sigma_psi_deg = setup.sigma_delta_deg = 0;
    const Measurement data = simulate_ellipsometer(sample, setup);
    for (size_t i = 0; i < 4; ++i) {
        // The printed digits, and what another interpolation of n and k moves them.
        EXPECT_NEAR(data.rows[i].psi_deg, expected[i][1], 0.011) << expected[i][0];
        EXPECT_NEAR(data.rows[i].delta_deg, expected[i][2], 0.3) << expected[i][0];
    }
}

TEST(Film, NoiseFreeDataGiveThicknessAndPorosityBack) {
    for (const double thickness : {20.0, 150.0, 420.0, 1000.0, 3000.0, 7500.0}) {
        const Measurement data = measured_film(thickness, 0.13, 0);
        const FitResult fit = fit_measurement(data, anodised_options());
        EXPECT_NEAR(value_of(fit, "thickness"), thickness, 1e-4 * thickness);
        EXPECT_NEAR(value_of(fit, "porosity"), 0.13, 1e-4) << thickness;
        ASSERT_EQ(fit.layers.size(), 1u);
        EXPECT_EQ(fit.layers[0].thickness_nm, value_of(fit, "thickness"));
    }
}

// Cases 1 to 40 of the 1000 that bench/film_recovery runs.
TEST(Film, RandomAnodisedFilmsAreRecovered) {
    int recovered = 0, within_3 = 0;
    for (uint64_t seed = 1; seed <= 40; ++seed) {
        const FilmCase film = random_film_case(seed);
        const FitResult fit = fit_measurement(measured_film(film.thickness_nm, film.porosity, seed),
                                              anodised_options());
        const double error = value_of(fit, "thickness") - film.thickness_nm;
        if (std::abs(error) < 0.005 * film.thickness_nm) ++recovered;
        if (std::abs(error) < 3 * sigma_of(fit, "thickness")) ++within_3;
    }
    EXPECT_GE(recovered, 39);
    EXPECT_GE(within_3, 38);
}

// 0.05 and 0.1 degrees, every nanometre: 0.6 nm and 0.0003 from 60 degrees alone, 0.037 nm and
// 0.00002 from three angles (numpy).
TEST(Film, StandardDeviationsMatchAnIndependentImplementation) {
    const Material sample = anodised(3000, 0.1, parse_grid("380:750:1", "wavelengths"));
    SimulationSetup setup;
    setup.wavelengths_nm = parse_grid("380:750:1", "wavelengths");
    setup.angles_deg = {60};
    const FitResult one = fit_measurement(simulate_ellipsometer(sample, setup), anodised_options());
    setup.angles_deg = {50, 60, 70};
    const FitResult three =
        fit_measurement(simulate_ellipsometer(sample, setup), anodised_options());
    EXPECT_NEAR(sigma_of(one, "thickness"), 0.6, 0.1);
    EXPECT_NEAR(sigma_of(one, "porosity"), 0.0003, 0.00006);
    EXPECT_NEAR(sigma_of(three, "thickness"), 0.037, 0.004);
    EXPECT_NEAR(value_of(three, "thickness"), 3000, 4 * sigma_of(three, "thickness"));
    EXPECT_NEAR(three.chi2_reduced(), 1, 4 * std::sqrt(2.0 / three.dof()));
    EXPECT_EQ(three.dof(), 371 * 3 * 2 - 2);
}

TEST(Film, TanSquaredPsiAloneFindsTheFilmToo) {
    FitOptions options = anodised_options();
    options.estimator = "rho2";
    const Measurement data = measured_film(2500, 0.2, 3);
    const FitResult fit = fit_measurement(data, options);
    const FitResult both = fit_measurement(data, anodised_options());
    EXPECT_NEAR(value_of(fit, "thickness"), 2500, 5 * sigma_of(fit, "thickness"));
    EXPECT_GT(sigma_of(fit, "thickness"), sigma_of(both, "thickness"));
    EXPECT_EQ(fit.data * 2, both.data);
}

TEST(Film, FixedPorosityLeavesTheThickness) {
    FitOptions options = anodised_options();
    options.film.porosity = 0.2;
    const FitResult fit = fit_measurement(measured_film(2500, 0.2, 3), options);
    ASSERT_EQ(fit.common.size(), 1u);
    EXPECT_EQ(fit.parameters, 1);
    EXPECT_NEAR(value_of(fit, "thickness"), 2500, 4 * sigma_of(fit, "thickness"));
    for (const FittedPoint& point : fit.points) EXPECT_EQ(point.sigma_n, 0);
}

// Least squares alone finds the minimum of the basin that it starts in, and no other.
TEST(Film, AGivenStartTakesThePlaceOfTheSearch) {
    const Measurement data = measured_film(3000, 0.1, 1);
    FitOptions options = anodised_options();
    const FitResult searched = fit_measurement(data, options);
    options.film.start = FilmGuess{3010, 0.11};
    const FitResult near = fit_measurement(data, options);
    EXPECT_NEAR(value_of(near, "thickness"), value_of(searched, "thickness"), 1e-5);
    EXPECT_NEAR(near.chi2, searched.chi2, 1e-6 * searched.chi2);
    EXPECT_EQ(near.rival_thickness_nm, 0);
    options.film.start = FilmGuess{2300, 0.11};
    EXPECT_GT(fit_measurement(data, options).chi2, 10 * searched.chi2);
    for (const FilmGuess& guess : {FilmGuess{-1, 0.1}, FilmGuess{20000, 0.1}, FilmGuess{3000, 1},
                                   FilmGuess{NAN, 0.1}, FilmGuess{3000, NAN}}) {
        options.film.start = guess;
        EXPECT_THROW(fit_measurement(data, options), Error);
    }
}

TEST(Film, ThreadsDoNotMoveABit) {
    const Measurement data = measured_film(1234, 0.3, 5);
    FitOptions options = anodised_options();
    options.threads = 1;
    const FitResult one = fit_measurement(data, options);
    options.threads = 4;
    const FitResult four = fit_measurement(data, options);
    EXPECT_EQ(value_of(one, "thickness"), value_of(four, "thickness"));
    EXPECT_EQ(one.chi2, four.chi2);
}

TEST(Film, TheMaterialReflectsWhatWasMeasured) {
    const Measurement data = measured_film(800, 0.25, 0);
    const FitResult fit = fit_measurement(data, anodised_options());
    const Material material = fitted_material(fit, data, "anodised", {});
    EXPECT_EQ(material.substrate.name, "Al-Rakic");
    const Material back = parse_material(format_material(material), "film.json");
    SimulationSetup setup;
    setup.angles_deg = data.angles();
    setup.wavelengths_nm = data.wavelengths();
    setup.sigma_psi_deg = setup.sigma_delta_deg = 0;
    const Measurement again = simulate_ellipsometer(back, setup);
    for (size_t i = 0; i < data.rows.size(); ++i) {
        EXPECT_NEAR(again.rows[i].psi_deg, data.rows[i].psi_deg, 1e-3);
        EXPECT_NEAR(std::remainder(again.rows[i].delta_deg - data.rows[i].delta_deg, 360.0), 0,
                    1e-2);
    }
}

TEST(Film, AngleOffsetIsFoundFromThreeAngles) {
    Measurement data = measured_film(2000, 0.15, 9, {50, 60, 70});
    for (MeasurementRow& row : data.rows) row.angle_deg -= 0.08;  // the stage's zero is off
    FitOptions options = anodised_options();
    const FitResult wrong = fit_measurement(data, options);
    options.fit_angle_offset = true;
    const FitResult right = fit_measurement(data, options);
    EXPECT_NEAR(value_of(right, "angle offset"), 0.08, 4 * sigma_of(right, "angle offset"));
    EXPECT_NEAR(value_of(right, "thickness"), 2000, 4 * sigma_of(right, "thickness"));
    EXPECT_LT(right.chi2_reduced(), 1.3);
    EXPECT_GT(wrong.chi2_reduced(), 2);
}

// A 103.5 nm oxide on silicon, measured (SENTECH SpectraRay), nothing weighted, thickness alone.
TEST(Film, MeasuredOxideOnSilicon) {
    const std::string path = shared_data("measured/spectraray_SiO2_on_Si_50_60_70.txt");
    DRUDE_NEED_SHARED(path);
    const Measurement data = import_measurement(path);
    FitOptions options;
    options.model = "film";
    options.film.substrate = published_set("Si-Aspnes");
    options.film.material = cauchy_constants({1.452, 0.0036, 0});
    options.film.porosity = 0;
    options.unweighted = true;
    options.first_nm = 210;
    options.last_nm = 830;
    const FitResult fit = fit_measurement(data, options);
    EXPECT_NEAR(value_of(fit, "thickness"), 103.5, 0.3);
    EXPECT_LT(sigma_of(fit, "thickness"), 0.1);
    options.film.substrate = published_set("Si-Green-2008");
    options.first_nm = 250;
    EXPECT_NEAR(value_of(fit_measurement(data, options), "thickness"), 103.6, 0.3);
}

TEST(Film, OtherSetsOfTheSubstrateMoveTheThickness) {
    const FitOptions options = anodised_options();
    const Measurement data = measured_film(1500, 0.1, 0);
    const FitResult fit = fit_measurement(data, options);
    const auto others = other_substrates(data, options, fit);
    ASSERT_GE(others.size(), 2u);
    for (const SubstrateAlternative& other : others) {
        EXPECT_EQ(published_set(other.name).material, "Al");
        EXPECT_NE(other.name, "Al-Rakic");
        EXPECT_NEAR(other.same_range.value, 1500, 1e-3);
        // Other samples of aluminium: far more than the noise, less than a fringe.
        EXPECT_GT(std::abs(other.thickness.value - 1500), 0.01) << other.name;
        EXPECT_LT(std::abs(other.thickness.value - 1500), 100) << other.name;
    }
    // A bare surface has no substrate.
    FitOptions bulk;
    EXPECT_TRUE(other_substrates(data, bulk, fit_measurement(data, bulk)).empty());
}

TEST(Film, RefusesWhatMakesNoSense) {
    const Measurement data = measured_film(1000, 0.1, 1);
    const auto expect_user_error = [&](const FitOptions& options, const std::string& text) {
        try {
            fit_measurement(data, options);
            FAIL() << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.cause(), Cause::user);
            EXPECT_NE(error.message().find(text), std::string::npos) << error.message();
        }
    };
    FitOptions options = anodised_options();
    options.film.substrate = {};
    expect_user_error(options, "known substrate");
    options = anodised_options();
    options.estimator = "inversion";
    expect_user_error(options, "inversion");
    options = anodised_options();
    options.film.porosity = 1;
    expect_user_error(options, "porosity of 1");
    options = anodised_options();
    options.film.largest_thickness_nm = std::nan("");
    expect_user_error(options, "largest thickness");
    options = anodised_options();
    options.model = "bulk";
    expect_user_error(options, "'film'");
    options = anodised_options();
    options.first_nm = 900;
    expect_user_error(options, "spans 380");
}

// A film of the substrate's own material has no thickness that data could know.
TEST(Film, AFilmThatIsItsSubstrateIsRefused) {
    const Material bare = find_material("Al-Rakic");
    SimulationSetup setup;
    setup.angles_deg = {60, 70};
    setup.wavelengths_nm = parse_grid("400:700:10", "wavelengths");
    FitOptions options = anodised_options();
    options.film.material = options.film.substrate;
    options.film.porosity = 0;
    try {
        fit_measurement(simulate_ellipsometer(bare, setup), options);
        FAIL() << "a thickness was reported";
    } catch (const Error& error) {
        EXPECT_EQ(error.cause(), Cause::answer_is_no);
    }
}

}  // namespace
}  // namespace drude
