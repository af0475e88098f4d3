// Distances from published sets, and which of them is meant.
#include "fitter/literature.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/numbers.h"

namespace drude {
namespace {

// A fit that gave exactly `constants` plus (dn, dk).
FitResult fit_of(const OpticalConstants& constants, const std::string& grid, double dn, double dk) {
    FitResult fit;
    for (const double nm : parse_grid(grid, "wavelengths")) {
        FittedPoint point;
        point.wavelength_nm = nm;
        point.n = constants.at(nm).n + dn;
        point.k = constants.at(nm).k + dk;
        point.identifiable = true;
        fit.points.push_back(point);
    }
    return fit;
}

// Root mean squares of the notes' comparison over 380 to 750 nm: Cu Johnson against McPeak .20/.09,
// against Hagemann .07/.01; an independent program.
TEST(Literature, DistancesMatchAnIndependentComparison) {
    const FitResult fit = fit_of(published_set("Cu-Johnson"), "380:750:5", 0, 0);
    const LiteratureComparison comparison = compare_with_literature(fit, "", "");
    EXPECT_EQ(comparison.material, "Cu");
    EXPECT_EQ(comparison.choice, LiteratureComparison::Choice::nearest);
    EXPECT_EQ(comparison.nearest(), "Cu-Johnson");
    EXPECT_EQ(comparison.sets.front().distance.rms(), 0);
    for (const LiteratureSet& set : comparison.sets) {
        EXPECT_EQ(set.distance.wavelengths, 75) << set.name;
        if (set.name == "Cu-McPeak") {
            EXPECT_NEAR(set.distance.rms_dn, .20, .01);
            EXPECT_NEAR(set.distance.rms_dk, .09, .01);
        }
        if (set.name == "Cu-Hagemann") {
            EXPECT_NEAR(set.distance.rms_dn, .07, .01);
            EXPECT_NEAR(set.distance.rms_dk, .01, .005);
        }
    }
}

TEST(Literature, TheEnvelopeHoldsEverySetAndTouchesTwo) {
    const FitResult fit = fit_of(published_set("Cu-Johnson"), "400:700:50", 0.3, 0);
    const LiteratureComparison comparison = compare_with_literature(fit, "", "Cu");
    const LiteratureEnvelope& envelope = comparison.envelope;
    ASSERT_EQ(envelope.wavelength_nm.size(), 7u);
    for (size_t i = 0; i < 7; ++i) {
        double low = 1e9, high = 0;
        for (const LiteratureSet& set : comparison.sets) {
            const double k = published_set(set.name).at(envelope.wavelength_nm[i]).k;
            low = std::min(low, k);
            high = std::max(high, k);
        }
        EXPECT_EQ(envelope.k_low[i], low);
        EXPECT_EQ(envelope.k_high[i], high);
        EXPECT_EQ(envelope.sets[i], static_cast<int>(comparison.sets.size()));
    }
}

TEST(Literature, OnlyWhatASetCoversIsCompared) {
    // McPeak begins at 300 nm, Johnson at 187.9.
    const FitResult fit = fit_of(published_set("Cu-Johnson"), "200:400:50", 0.1, -0.2);
    const LiteratureComparison comparison = compare_with_literature(fit, "", "Cu");
    EXPECT_EQ(comparison.nearest(), "Cu-Johnson");
    EXPECT_NEAR(comparison.sets.front().distance.rms_dn, 0.1, 1e-12);
    EXPECT_NEAR(comparison.sets.front().distance.rms_dk, 0.2, 1e-12);
    EXPECT_NEAR(comparison.sets.front().distance.rms(), std::hypot(0.1, 0.2), 1e-12);
    for (const LiteratureSet& set : comparison.sets) {
        if (set.name == "Cu-McPeak") {
            EXPECT_EQ(set.distance.wavelengths, 3);
        }
    }
    // Nothing published begins at 1e-3 nm.
    FitResult nowhere;
    nowhere.points.push_back({});
    nowhere.points[0].wavelength_nm = 1e-3;
    nowhere.points[0].identifiable = true;
    const LiteratureComparison none = compare_with_literature(nowhere, "", "Cu");
    EXPECT_TRUE(none.sets.empty());
    EXPECT_EQ(none.envelope.sets.at(0), 0);
    EXPECT_TRUE(std::isnan(none.envelope.n_low.at(0)));
}

TEST(Literature, TheSampleNamesTheMaterialAndTheUserOverrules) {
    const FitResult fit = fit_of(published_set("Au-Johnson"), "400:700:10", 0, 0);
    EXPECT_EQ(compare_with_literature(fit, "", "").material, "Au");
    const LiteratureComparison named = compare_with_literature(fit, "cu-mcpeak", "");
    EXPECT_EQ(named.material, "Cu");
    EXPECT_EQ(named.choice, LiteratureComparison::Choice::sample_header);
    EXPECT_GT(named.sets.size(), 3u);
    EXPECT_EQ(compare_with_literature(fit, "coin no. 3", "").material, "Au");
    const LiteratureComparison asked = compare_with_literature(fit, "Cu", "Ag-Johnson");
    EXPECT_EQ(asked.choice, LiteratureComparison::Choice::asked_for);
    ASSERT_EQ(asked.sets.size(), 1u);
    EXPECT_EQ(asked.sets[0].name, "Ag-Johnson");
    try {
        compare_with_literature(fit, "", "Ag-Jonson");
        FAIL() << "an unknown set was taken";
    } catch (const Error& error) {
        EXPECT_EQ(error.cause(), Cause::user);
        EXPECT_NE(error.message().find("did you mean 'Ag-Johnson'"), std::string::npos);
    }
}

TEST(Literature, ADielectricHasNoNearestMetal) {
    const FitResult fit = fit_of(published_set("Al2O3-Malitson-o"), "400:700:50", 0.01, 0);
    EXPECT_TRUE(compare_with_literature(fit, "", "").sets.empty());
    EXPECT_EQ(compare_with_literature(fit, "", "").material, "");
    EXPECT_EQ(compare_with_literature(fit, "", "Al2O3").nearest(), "Al2O3-Malitson-o");
    const FitResult steel = fit_of(published_set("steel-Karlsson-ferritic"), "400:700:50", 0, 0);
    EXPECT_EQ(compare_with_literature(steel, "", "").nearest(), "steel-Karlsson-ferritic");
}

TEST(Literature, AFilmIsNotComparedWithTheMetalBelow) {
    FitResult fit = fit_of(published_set("Al2O3-Malitson-o"), "400:700:50", 0, 0);
    fit.substrate = published_set("Al-Rakic");
    EXPECT_TRUE(compare_with_literature(fit, "Al", "").sets.empty());
    EXPECT_EQ(compare_with_literature(fit, "Al", "Al2O3").nearest(), "Al2O3-Malitson-o");
}

TEST(Literature, WhatWasNotDeterminedIsNotCompared) {
    FitResult fit = fit_of(published_set("Au-Johnson"), "400:700:100", 0, 0);
    fit.points[1].identifiable = false;
    fit.points[1].n = fit.points[1].k = std::nan("");
    const LiteratureComparison comparison = compare_with_literature(fit, "", "Au");
    EXPECT_EQ(comparison.wavelengths, 3);
    EXPECT_EQ(comparison.sets.front().distance.wavelengths, 3);
    EXPECT_EQ(comparison.sets.front().distance.rms(), 0);
}

}  // namespace
}  // namespace drude
