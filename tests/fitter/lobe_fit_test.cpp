// beta from scans of the lobe.
#include "fitter/lobe_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/numbers.h"
#include "lobe_cases.h"

namespace drude {
namespace {

TEST(LobeFit, NoiseFreeScansGiveBetaBackWhateverTheScale) {
    for (const Lobe lobe : all_lobes) {
        for (const double beta : {0.1, 0.3, 0.5}) {
            for (const double scale : {1.0, 0.4}) {
                const LobeFitResult fit =
                    fit_lobes(scan_of(lobe, beta, {550}, 0, scale), find_material("Cu-McPeak"));
                ASSERT_EQ(fit.lobes.size(), 4u);
                const FittedLobe& own = result_for(fit, lobe);
                EXPECT_NEAR(own.beta, beta, 1e-5) << lobe_name(lobe) << " " << beta;
                EXPECT_LT(own.chi2, 1e-3) << lobe_name(lobe) << " " << beta;
                EXPECT_TRUE(own.tied);
                EXPECT_FALSE(own.narrower_than_aperture);
                EXPECT_EQ(fit.dof(), 2 * 56 - 2);
            }
        }
    }
}

// Independent implementation (numpy): sigma of beta .0001 at .1, .0006 to .001 at .2, .002 to .003
// at .3 and about .01 at .5, over the lobes.
TEST(LobeFit, StandardDeviationsMatchAnIndependentImplementation) {
    const double expected[][3] = {
        {0.1, 0.00003, 0.00025}, {0.2, 0.0003, 0.0015}, {0.3, 0.001, 0.004}, {0.5, 0.004, 0.016}};
    for (const auto& [beta, least, most] : expected) {
        for (const Lobe lobe : all_lobes) {
            const double sigma =
                result_for(fit_lobes(scan_of(lobe, beta, {550}, 0), find_material("Cu-McPeak")),
                           lobe)
                    .sigma_beta;
            EXPECT_GT(sigma, least) << lobe_name(lobe) << " " << beta;
            EXPECT_LT(sigma, most) << lobe_name(lobe) << " " << beta;
        }
    }
}

TEST(LobeFit, SigmasCoverTheScatter) {
    int within_1 = 0, values = 0;
    for (const Lobe lobe : all_lobes) {
        for (uint64_t seed = 1; seed <= 30; ++seed) {
            const FittedLobe own = result_for(
                fit_lobes(scan_of(lobe, 0.3, {550}, seed), find_material("Cu-McPeak")), lobe);
            ++values;
            if (std::abs(own.beta - 0.3) < own.sigma_beta) ++within_1;
        }
    }
    EXPECT_NEAR(within_1, 0.683 * values, 3 * std::sqrt(values * 0.217));
}

TEST(LobeFit, TheTrueLobeIsInTheTieAndAWrongOneNeverAlone) {
    int in_tie = 0, draws = 0;
    for (const Lobe lobe : all_lobes) {
        for (const double beta : {0.15, 0.3, 0.5}) {
            for (uint64_t seed = 1; seed <= 6; ++seed) {
                const LobeFitResult fit =
                    fit_lobes(scan_of(lobe, beta, {550}, seed), find_material("Cu-McPeak"));
                ++draws;
                if (result_for(fit, lobe).tied) {
                    ++in_tie;
                } else {
                    EXPECT_TRUE(fit.lobes[1].tied) << "alone: " << lobe_name(fit.lobes[0].lobe);
                }
            }
        }
    }
    EXPECT_GE(in_tie, 0.93 * draws);
}

// No fit stops short: the truth itself, without a scale to adjust, explains the scan no better.
TEST(LobeFit, NoFitIsWorseThanTheTruth) {
    for (const Lobe lobe : all_lobes) {
        for (const double beta : {0.15, 0.5}) {
            const LobeScan truth = scan_of(lobe, beta, {550}, 0);
            for (uint64_t seed = 1; seed <= 5; ++seed) {
                const LobeScan scan = scan_of(lobe, beta, {550}, seed);
                double chi2 = 0;
                for (size_t i = 0; i < scan.rows.size(); ++i) {
                    const LobeScanRow &row = scan.rows[i], &exact = truth.rows[i];
                    chi2 += std::pow((row.reflectance_s - exact.reflectance_s) / row.sigma_s, 2) +
                            std::pow((row.reflectance_p - exact.reflectance_p) / row.sigma_p, 2);
                }
                const FittedLobe own =
                    result_for(fit_lobes(scan, find_material("Cu-McPeak")), lobe);
                // Less one for each of the two unknowns on average; the cone of 0.01 degrees costs
                // next to nothing.
                EXPECT_LT(own.chi2, chi2 + 1e-3) << lobe_name(lobe) << " " << beta << " " << seed;
                EXPECT_GT(own.chi2, chi2 - 20) << lobe_name(lobe) << " " << beta << " " << seed;
            }
        }
    }
}

// How far a wrong lobe is ahead of the true one scatters as lobe_tie's comment says: Blinn-Phong's
// 0.15 against Beckmann, D = 9.5.
TEST(LobeFit, LeadOfAWrongLobeIsNormal) {
    const auto lead = [](uint64_t seed) {
        const LobeFitResult fit =
            fit_lobes(scan_of(Lobe::blinn_phong, 0.15, {550}, seed), find_material("Cu-McPeak"));
        return result_for(fit, Lobe::beckmann).chi2 - result_for(fit, Lobe::blinn_phong).chi2;
    };
    const double distance = lead(0);
    EXPECT_NEAR(distance, 9.5, 0.05);
    constexpr int draws = 100;
    double sum = 0, squares = 0;
    for (uint64_t seed = 1; seed <= draws; ++seed) {
        const double difference = lead(seed);
        sum += difference;
        squares += difference * difference;
    }
    const double mean = sum / draws, sd = std::sqrt(squares / draws - mean * mean);
    const double expected = 2 * std::sqrt(distance);
    EXPECT_NEAR(mean, distance, 4 * expected / std::sqrt(draws));
    EXPECT_NEAR(sd, expected, 4 * expected / std::sqrt(2 * draws));
}

TEST(LobeFit, WavelengthsJoinForOneBeta) {
    const std::vector<double> many = parse_grid("400:740:20", "wavelengths");
    const double one =
        result_for(fit_lobes(scan_of(Lobe::beckmann, 0.2, {550}, 3), find_material("Cu-McPeak")),
                   Lobe::beckmann)
            .sigma_beta;
    const LobeFitResult joint =
        fit_lobes(scan_of(Lobe::beckmann, 0.2, many, 3), find_material("Cu-McPeak"));
    const FittedLobe& own = result_for(joint, Lobe::beckmann);
    EXPECT_NEAR(own.sigma_beta * std::sqrt(18.0), one, 0.1 * one);
    EXPECT_NEAR(own.beta, 0.2, 4.5 * own.sigma_beta);
    EXPECT_EQ(joint.parameters, 1 + 18);
}

// A cone of 3 degrees sees a narrow lobe wider than it is, and says at most how wide.
TEST(LobeFit, NarrowerThanTheConeIsAnUpperBound) {
    LobeScan scan = scan_of(Lobe::trowbridge_reitz, 0.005, {550}, 0);
    scan.detector_half_angle_deg = 3;
    scan.detector_solid_angle_sr = 2 * pi * (1 - std::cos(3 * pi / 180));
    for (LobeScanRow& row : scan.rows) {
        // What such a cone collects: all of the lobe, or what little is beside it.
        const bool inside = std::abs(row.offset_deg) < 3;
        row.reflectance_s = inside ? 0.8 : 0.001;
        row.reflectance_p = inside ? 0.45 : 0.0006;
        row.sigma_s = row.sigma_p = 0.02;
    }
    const LobeFitResult fit = fit_lobes(scan, find_material("Cu-McPeak"));
    for (const FittedLobe& lobe : fit.lobes) {
        EXPECT_TRUE(lobe.narrower_than_aperture) << lobe_name(lobe.lobe);
        EXPECT_GT(lobe.upper_bound, lobe.beta);
        EXPECT_LT(lobe.upper_bound, 0.06);
    }
    ASSERT_FALSE(fit.warnings.empty());
}

TEST(LobeFit, AMaterialIsWrittenForOneLobeOnly) {
    const auto lobes = [](double first, double second) {
        LobeFitResult result;
        FittedLobe beckmann, gaussian;
        beckmann.lobe = Lobe::beckmann;
        beckmann.beta = 0.2;
        beckmann.chi2 = first;
        beckmann.tied = true;
        gaussian.lobe = Lobe::gaussian;
        gaussian.beta = 0.17;
        gaussian.chi2 = second;
        gaussian.tied = second - first <= lobe_tie;
        result.lobes = {beckmann, gaussian};
        return result;
    };
    Material material = find_material("Cu-McPeak");
    set_fitted_lobe(lobes(100, 120), "", &material);
    EXPECT_EQ(material.lobe, Lobe::beckmann);
    EXPECT_EQ(material.beta, 0.2);
    EXPECT_EQ(material.masking, Masking::v_groove);
    EXPECT_THROW(set_fitted_lobe(lobes(100, 103), "", &material), Error);
    EXPECT_THROW(set_fitted_lobe(lobes(100, 120), "gaussian", &material), Error);
    EXPECT_THROW(set_fitted_lobe(lobes(100, 103), "gausian", &material), Error);
    set_fitted_lobe(lobes(100, 103), "gaussian", &material);
    EXPECT_EQ(material.lobe, Lobe::gaussian);
    EXPECT_EQ(material.beta, 0.17);
    LobeFitResult narrow = lobes(100, 120);
    narrow.lobes[0].narrower_than_aperture = true;
    EXPECT_THROW(set_fitted_lobe(narrow, "", &material), Error);
}

TEST(LobeFit, OnePositionIsRefused) {
    LobeScan scan = scan_of(Lobe::beckmann, 0.2, {550}, 1);
    scan.rows.resize(1);
    try {
        fit_lobes(scan, find_material("Cu-McPeak"));
        FAIL() << "a beta was reported";
    } catch (const Error& error) {
        EXPECT_EQ(error.cause(), Cause::answer_is_no);
    }
}

}  // namespace
}  // namespace drude
