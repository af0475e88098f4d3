// Measurements that hold nothing are refused with a reason; whatever the start, a fit ends, and
// ends finite or refused.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "fit_cases.h"
#include "fitter/fit.h"
#include "fitter/fit_data.h"
#include "fitter/point_fit.h"

namespace drude {
namespace {

MeasurementRow row_of(double angle_deg, double psi_deg, double delta_deg) {
    MeasurementRow row;
    row.wavelength_nm = 550;
    row.angle_deg = angle_deg;
    row.psi_deg = psi_deg;
    row.delta_deg = delta_deg;
    row.sigma_psi_deg = 0.05;
    row.sigma_delta_deg = 0.1;
    return row;
}

Measurement constant(double psi_deg, double delta_deg, const std::vector<double>& angles_deg) {
    Measurement data;
    for (const double angle : angles_deg) data.rows.push_back(row_of(angle, psi_deg, delta_deg));
    return data;
}

void expect_refused(const Measurement& data, const std::string& estimator,
                    const std::string& what) {
    FitOptions options;
    options.estimator = estimator;
    try {
        const FittedPoint point = fit_measurement(data, options).points[0];
        ADD_FAILURE() << what << ", " << estimator << ": reported " << point.n << " +- "
                      << point.sigma_n << ", " << point.k << " +- " << point.sigma_k;
    } catch (const Error& error) {
        EXPECT_EQ(error.cause(), Cause::answer_is_no) << what << ": " << error.message();
        // "no fit: ... (the reason)"
        EXPECT_GT(error.message().size(), 60u) << error.message();
    }
}

TEST(Refusal, OneValueOfTan2PsiForTwoUnknowns) {
    for (const MetalCase& metal : metal_cases()) {
        for (const double angle : paper_angles()) {
            for (const uint64_t seed : {uint64_t{0}, uint64_t{1}, uint64_t{2}}) {
                expect_refused(measured(metal, {angle}, seed), "rho2", metal.name);
            }
        }
    }
}

// Two angles that are one: the same equation twice.
TEST(Refusal, OneAngleTwice) {
    for (const MetalCase& metal : metal_cases()) {
        for (const uint64_t seed : {uint64_t{0}, uint64_t{1}, uint64_t{2}}) {
            expect_refused(measured(metal, {60, 60.0001}, seed), "rho2", metal.name);
        }
    }
    Measurement twice = measured(metal_cases()[0], {60, 60}, 1);
    EXPECT_THROW(fit_measurement(twice, {}), Error);
}

// At normal incidence every isotropic surface has Psi = 45 and Delta = 180 degrees.
TEST(Refusal, NextToNormalIncidence) {
    for (const MetalCase& metal : metal_cases()) {
        for (const std::string& estimator : estimator_names()) {
            for (const uint64_t seed : {uint64_t{0}, uint64_t{1}, uint64_t{2}}) {
                expect_refused(measured(metal, {0.01, 0.02}, seed), estimator, metal.name);
            }
        }
    }
}

TEST(Refusal, PerfectMirrorsAndWhatReflectsOnePolarisation) {
    struct Nothing {
        double psi_deg, delta_deg;
    };
    for (const auto& [psi_deg, delta_deg] :
         {Nothing{45, 180}, Nothing{0, 30}, Nothing{0, 180}, Nothing{90, 0}, Nothing{90, 250}}) {
        const std::string what = fmt::format("Psi {}, Delta {}", psi_deg, delta_deg);
        for (const std::string& estimator : estimator_names()) {
            expect_refused(constant(psi_deg, delta_deg, {60}), estimator, what);
            // At several angles they contradict every surface instead, which chi-square says.
            FitOptions options;
            options.estimator = estimator;
            try {
                const FitResult fit =
                    fit_measurement(constant(psi_deg, delta_deg, paper_angles()), options);
                EXPECT_GT(fit.chi2_reduced(), 1000) << what << " " << estimator;
                EXPECT_NE(psi_deg, 45) << estimator;
            } catch (const Error& error) {
                EXPECT_EQ(error.cause(), Cause::answer_is_no) << what << ": " << error.message();
            }
        }
    }
    // tan^2 Psi = 1 is every mirror without loss, whatever its k.
    expect_refused(constant(45, 90, paper_angles()), "rho2", "Psi 45");
}

// n = 1, k = 0 reflects nothing; Psi and Delta are whatever the detector's noise makes of them.
TEST(Refusal, NoiseOfADarkDetector) {
    int reported = 0;
    for (uint64_t seed = 1; seed <= 50; ++seed) {
        Measurement data;
        for (size_t i = 0; i < paper_angles().size(); ++i) {
            const auto bits =
                philox({static_cast<uint32_t>(i), 7, 0, 0}, {static_cast<uint32_t>(seed), 0});
            data.rows.push_back(
                row_of(paper_angles()[i], 90 * (bits[0] * 0x1p-32), 360 * (bits[1] * 0x1p-32)));
        }
        for (const std::string& estimator : estimator_names()) {
            FitOptions options;
            options.estimator = estimator;
            try {
                const FitResult fit = fit_measurement(data, options);
                ++reported;
                EXPECT_TRUE(std::isfinite(fit.points[0].n) && std::isfinite(fit.points[0].k));
                // Five hundredths of a degree are claimed: chi-square says that no surface is this.
                EXPECT_GT(fit.chi2_reduced(), 100) << seed << " " << estimator;
                EXPECT_FALSE(fit.warnings.empty()) << seed << " " << estimator;
            } catch (const Error& error) {
                EXPECT_EQ(error.cause(), Cause::answer_is_no);
            }
        }
    }
    EXPECT_GT(reported, 0);
}

// A seeded subset of bench/stability_map.cpp, with noise in every second case: random metals,
// angles and starts.
TEST(Refusal, AnyStartEndsFiniteOrRefused) {
    int found = 0, trials = 0;
    for (uint32_t trial = 0; trial < 600; ++trial) {
        uint32_t count = 0;
        const auto uniform = [&] { return philox({trial, count++, 3, 0}, {1, 0})[0] * 0x1p-32; };
        const auto logarithmic = [&](double low, double high) {
            return low * std::pow(high / low, uniform());
        };
        const MetalCase metal = {"random", logarithmic(0.02, 10), logarithmic(0.02, 15)};
        std::vector<double> angles(1 + static_cast<size_t>(6 * uniform()));
        for (double& angle : angles) angle = 5 + 80 * uniform();
        const WavelengthData data =
            group_by_wavelength(measured(metal, angles, trial % 2 ? trial : 0), {}).front();
        const Index start = {logarithmic(1e-8, 1e8), logarithmic(1e-8, 1e8)};
        for (const Estimator estimator : {Estimator::psi_delta, Estimator::rho2}) {
            const FittedPoint point = fit_point_from(data, estimator, start);
            ++trials;
            if (!point.identifiable) {
                EXPECT_TRUE(std::isnan(point.n) && std::isnan(point.sigma_k)) << trial;
                EXPECT_FALSE(point.reason.empty()) << trial;
                continue;
            }
            EXPECT_TRUE(std::isfinite(point.n) && point.n > 0) << trial;
            EXPECT_TRUE(std::isfinite(point.k) && point.k >= 0) << trial;
            EXPECT_TRUE(point.sigma_n > 0 && std::isfinite(point.sigma_n)) << trial;
            EXPECT_TRUE(point.sigma_k > 0 && std::isfinite(point.sigma_k)) << trial;
            found += trial % 2 == 0 && std::hypot(point.n - metal.n, point.k - metal.k) <
                                           1e-4 * std::hypot(metal.n, metal.k);
        }
        const FittedPoint own = fit_point(data, Estimator::psi_delta);
        ASSERT_TRUE(own.identifiable) << trial;
        if (trial % 2 == 0) {
            EXPECT_NEAR(own.n, metal.n, 1e-4 * std::hypot(metal.n, metal.k)) << trial;
            EXPECT_NEAR(own.k, metal.k, 1e-4 * std::hypot(metal.n, metal.k)) << trial;
        }
    }
    EXPECT_GT(found, trials / 4);  // of the half that is free of noise
}

TEST(Refusal, AnInversionTakesNoStart) {
    const WavelengthData data =
        group_by_wavelength(measured(metal_cases()[0], {60}, 0), {}).front();
    EXPECT_THROW(fit_point_from(data, Estimator::inversion, {1, 1}), std::logic_error);
}

}  // namespace
}  // namespace drude
