#include "fitter/inversion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fit_cases.h"
#include "fitter/residuals.h"

namespace drude {
namespace {

WavelengthData prepared(const Measurement& measurement) {
    WavelengthData data;
    for (const MeasurementRow& row : measurement.rows) {
        data.points.push_back(make_angle_point(row.angle_deg, row.psi_deg, row.delta_deg,
                                               row.sigma_psi_deg, row.sigma_delta_deg));
    }
    return data;
}

// Psi/Delta of the notes at 45, 50, 60, 70, 75, 80 degrees, to the printed hundredth of a degree.
TEST(Inversion, PrintedAnglesBelongToPrintedConstants) {
    struct Known {
        double n, k, psi_delta[12];
    };
    constexpr Known table[] = {
        {1.030,
         2.460,
         {39.92, 152.69, 38.77, 145.10, 36.38, 124.85, 34.83, 94.63, 35.20, 74.60, 36.98, 51.45}},
        {.549,
         1.810,
         {40.36, 142.02, 39.55, 132.28, 38.32, 108.25, 38.34, 77.46, 39.16, 59.60, 40.62, 40.46}},
        {.875,
         6.233,
         {44.13, 167.37, 43.89, 163.76, 43.25, 153.64, 42.28, 136.09, 41.65, 121.19, 41.13, 97.56}},
        {.290,
         3.040,
         {43.89, 154.66, 43.63, 147.75, 43.05, 129.49, 42.57, 102.13, 42.54, 83.17, 42.87, 59.62}},
        {2.400,
         3.699,
         {40.21, 164.54, 38.93, 160.02, 35.64, 147.14, 31.39, 123.95, 29.51, 104.07, 29.59, 75.02}},
        {3.708,
         4.721,
         {40.92, 169.32, 39.77, 166.19, 36.69, 157.16, 31.93, 140.17, 28.80, 124.02, 26.36, 95.44}},
    };
    for (const Known& metal : table) {
        for (size_t i = 0; i < 6; ++i) {
            const AnglePoint point = make_angle_point(paper_angles()[i], metal.psi_delta[2 * i],
                                                      metal.psi_delta[2 * i + 1], 0.005, 0.005);
            const Reflection<double> r =
                reflect(ComplexIndex<double>{metal.n, metal.k}, point.cos_theta);
            EXPECT_NEAR(psi(r) * 180 / pi, metal.psi_delta[2 * i], 0.0051);
            EXPECT_NEAR(delta(r) * 180 / pi, metal.psi_delta[2 * i + 1], 0.0051);
            // Rounded to a hundredth of a degree, so to about three standard deviations of that.
            const InvertedIndex inverted = invert_psi_delta(point);
            EXPECT_NEAR(inverted.n, metal.n, 2 * (inverted.sigma_n + inverted.sigma_k));
            EXPECT_NEAR(inverted.k, metal.k, 2 * (inverted.sigma_n + inverted.sigma_k));
        }
    }
}

TEST(Inversion, PropagatedErrorsMatchFiniteDifferences) {
    for (const MetalCase& metal : metal_cases()) {
        for (const MeasurementRow& row : measured(metal, paper_angles(), 0).rows) {
            const auto inverted = [&](double psi_step, double delta_step) {
                return invert_psi_delta(make_angle_point(row.angle_deg, row.psi_deg + psi_step,
                                                         row.delta_deg + delta_step, 0.05, 0.1));
            };
            const InvertedIndex centre = inverted(0, 0);
            EXPECT_NEAR(centre.n, metal.n, 1e-10);
            EXPECT_NEAR(centre.k, metal.k, 1e-10);
            const double h = 1e-4;
            const InvertedIndex a = inverted(h, 0), b = inverted(-h, 0), c = inverted(0, h),
                                d = inverted(0, -h);
            const double n_psi = (a.n - b.n) / (2 * h) * 0.05,
                         n_delta = (c.n - d.n) / (2 * h) * 0.1;
            const double k_psi = (a.k - b.k) / (2 * h) * 0.05,
                         k_delta = (c.k - d.k) / (2 * h) * 0.1;
            EXPECT_NEAR(centre.sigma_n, std::hypot(n_psi, n_delta), 1e-5 * centre.sigma_n);
            EXPECT_NEAR(centre.sigma_k, std::hypot(k_psi, k_delta), 1e-5 * centre.sigma_k);
            EXPECT_NEAR(centre.covariance, n_psi * k_psi + n_delta * k_delta,
                        1e-5 * centre.sigma_n * centre.sigma_k);
        }
    }
}

// With n as small as its noise, half of the draws lie below 0; k keeps its sign in all of them.
TEST(Inversion, NoiseAcrossZeroMovesTheSmallConstantOnly) {
    const MetalCase mirror = {"mirror", 1e-3, 3.085}, glass = {"glass", 1.52, 1e-3};
    int below = 0;
    for (uint64_t seed = 1; seed <= 50; ++seed) {
        const InvertedIndex metal =
            invert_psi_delta(prepared(measured(mirror, {45}, seed)).points[0]);
        EXPECT_NEAR(metal.k, mirror.k, 5 * metal.sigma_k) << seed;
        EXPECT_NEAR(metal.n, mirror.n, 5 * metal.sigma_n) << seed;
        const InvertedIndex clear =
            invert_psi_delta(prepared(measured(glass, {45}, seed)).points[0]);
        EXPECT_NEAR(clear.n, glass.n, 5 * clear.sigma_n) << seed;
        EXPECT_NEAR(clear.k, glass.k, 5 * clear.sigma_k) << seed;
        below += (metal.n < 0) + (clear.k < 0);
    }
    EXPECT_GT(below, 20);
    EXPECT_LT(below, 80);
}

TEST(Inversion, StartOfTheRho2FitIsNear) {
    for (const MetalCase& metal : metal_cases()) {
        const AveragedIndex start =
            start_from_tan2_psi(prepared(measured(metal, paper_angles(), 0)));
        EXPECT_NEAR(start.n, metal.n, 0.1 * metal.n) << metal.name;
        EXPECT_NEAR(start.k, metal.k, 0.1 * metal.k) << metal.name;
    }
}

// Near the data the residuals are plain differences over standard deviations.
TEST(Residuals, AreDifferencesInStandardDeviations) {
    const MetalCase metal = metal_cases()[0];
    const Reflection<double> r = reflect(ComplexIndex<double>{metal.n, metal.k}, 0.5);
    const double psi_deg = psi(r) * 180 / pi, delta_deg = delta(r) * 180 / pi;
    double residuals[2];
    ASSERT_TRUE(psi_delta_residuals(
        make_angle_point(60, psi_deg - 0.05, delta_deg + 0.2, 0.05, 0.1), r, residuals));
    EXPECT_NEAR(residuals[0], 1, 1e-2);
    EXPECT_NEAR(residuals[1], -2, 1e-2);
    double rho2 = 0;
    ASSERT_TRUE(rho2_residual(make_angle_point(60, psi_deg - 0.05, 0, 0.05, 0.1), r, &rho2));
    EXPECT_NEAR(rho2, 1, 1e-2);
}

// Growing distance on the sphere grows the residuals, up to the antipode.
TEST(Residuals, TheAntipodeIsNoMinimum) {
    // A model of Psi = 45 degrees and Delta = angle: Rs = Rp = 1.
    const auto length = [](double angle) {
        const Reflection<double> r{1, 1, std::cos(angle), std::sin(angle)};
        double residuals[2];
        EXPECT_TRUE(
            psi_delta_residuals(make_angle_point(60, 45, 0, 90 / pi, 180 / pi), r, residuals));
        return std::hypot(residuals[0], residuals[1]);
    };
    EXPECT_NEAR(length(0.5), std::sin(0.5), 1e-12);
    double last = length(1.58);
    EXPECT_NEAR(last, 2 * std::sin(0.79), 1e-9);
    for (double angle = 1.6; angle < pi; angle += 0.01) {
        EXPECT_GT(length(angle), last);
        last = length(angle);
    }
    EXPECT_NEAR(length(pi), 2, 1e-9);
    const Reflection<double> nothing{0, 0, 0, 0};
    double residuals[2];
    EXPECT_FALSE(psi_delta_residuals(make_angle_point(60, 45, 0, 1, 1), nothing, residuals));
}

}  // namespace
}  // namespace drude
