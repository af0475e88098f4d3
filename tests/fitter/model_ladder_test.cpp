#include "fitter/model_ladder.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/numbers.h"
#include "film_cases.h"
#include "fit_cases.h"
#include "fitter/named_constants.h"

namespace drude {
namespace {

FitOptions ladder_options() {
    FitOptions options = anodised_options();
    options.model = "auto";
    return options;
}

Measurement simulated(const Material& material, uint64_t seed) {
    SimulationSetup setup;
    setup.angles_deg = {60, 70, 75};
    setup.wavelengths_nm = parse_grid("400:700:10", "wavelengths");
    setup.seed = seed;
    return simulate_ellipsometer(material, setup);
}

TEST(Ladder, BareMetalStaysBulk) {
    FitOptions options = ladder_options();
    options.overlayers = {find_layer("Al2O3-Malitson-o,3", "layer")};
    for (uint64_t seed = 1; seed <= 5; ++seed) {
        const FitResult fit = fit_measurement(simulated(find_material("Cu-McPeak"), seed), options);
        EXPECT_EQ(fit.model, "bulk");
        ASSERT_EQ(fit.ladder.size(), 5u);
        EXPECT_TRUE(fit.ladder[0].taken);
        for (size_t i = 1; i < fit.ladder.size(); ++i) {
            EXPECT_FALSE(fit.ladder[i].taken) << fit.ladder[i].model;
            EXPECT_FALSE(fit.ladder[i].objection.empty());
        }
    }
}

TEST(Ladder, AnodisedMetalBecomesAFilm) {
    const FitResult fit =
        fit_measurement(measured_film(1800, 0.2, 4, {50, 60, 70}), ladder_options());
    EXPECT_EQ(fit.model, "film");
    EXPECT_NEAR(fit.layers.at(0).thickness_nm, 1800, 1);
    ASSERT_EQ(fit.common.size(), 2u);  // no offset
    EXPECT_TRUE(fit.ladder[1].taken);
    EXPECT_FALSE(fit.ladder[2].taken);
}

TEST(Ladder, AnOffsetIsTakenWhereThereIsOne) {
    Measurement data = simulated(find_material("Cu-McPeak"), 2);
    for (MeasurementRow& row : data.rows) row.angle_deg += 0.2;
    FitOptions options;
    options.model = "auto";
    const FitResult fit = fit_measurement(data, options);
    ASSERT_EQ(fit.common.size(), 1u);
    EXPECT_NEAR(fit.common[0].value, -0.2, 5 * fit.common[0].sigma);
    EXPECT_GT(fit.ladder[0].bic - fit.ladder[1].bic, ladder_bic_gain);
}

// Standard deviations stated too large bring every reduced chi-square below 1: that one falls
// further from it speaks against none.
TEST(Ladder, AnOffsetIsTakenUnderSigmasThatAreTooLarge) {
    Measurement data = simulated(find_material("Cu-McPeak"), 2);
    for (MeasurementRow& row : data.rows) {
        row.angle_deg += 0.2;
        row.sigma_psi_deg *= 2;
        row.sigma_delta_deg *= 2;
    }
    FitOptions options;
    options.model = "auto";
    const FitResult fit = fit_measurement(data, options);
    ASSERT_EQ(fit.ladder.size(), 2u);
    EXPECT_LT(fit.ladder[0].chi2_reduced, 1);
    EXPECT_LT(fit.chi2_reduced() + 3 * chi2_scatter(fit, options), 1);
    ASSERT_EQ(fit.common.size(), 1u) << fit.ladder[1].objection;
    EXPECT_NEAR(fit.common[0].value, -0.2, 2 * fit.common[0].sigma);
}

TEST(Ladder, CriterionIsSchwarzs) {
    FitResult fit;
    fit.chi2 = 120;
    fit.data = 100;
    fit.parameters = 4;
    EXPECT_DOUBLE_EQ(bayesian_criterion(fit, false), 120 + 4 * std::log(100.0));
    EXPECT_DOUBLE_EQ(bayesian_criterion(fit, true), 100 * std::log(1.2) + 4 * std::log(100.0));
    fit.chi2 = 1e-24;
    fit.parameters = 100;
    EXPECT_TRUE(std::isnan(bayesian_criterion(fit, true)));
    EXPECT_DOUBLE_EQ(bayesian_criterion(fit, false), 1e-24 + 100 * std::log(100.0));
}

TEST(Ladder, WhatHoldsNothingIsRefused) {
    FitOptions options;
    options.model = "auto";
    options.estimator = "rho2";
    try {
        fit_measurement(measured(metal_cases()[0], {60}, 1), options);
        FAIL() << "one tan^2 Psi gave n and k";
    } catch (const Error& error) {
        EXPECT_EQ(error.cause(), Cause::answer_is_no);
    }
    options.estimator = "inversion";
    EXPECT_THROW(fit_measurement(measured(metal_cases()[0], {60}, 1), options), Error);
}

}  // namespace
}  // namespace drude
