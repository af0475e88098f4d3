// The scatter of refitted draws against the covariance of the linearised problem.
#include "fitter/bootstrap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/numbers.h"
#include "device/virtual/ellipsometer_simulation.h"
#include "film_cases.h"
#include "fit_cases.h"

namespace drude {
namespace {

// A sample standard deviation of N normal values scatters by 1/sqrt(2(N - 1)), a mean by
// sigma/sqrt(N), and the 16 % quantile by 1.52 sigma/sqrt(N): sqrt(p(1 - p)) over the density.
TEST(Bootstrap, CopperScattersAsItsCovarianceSays) {
    SimulationSetup setup;
    setup.angles_deg = paper_angles();
    setup.wavelengths_nm = {450, 550, 650};
    const Measurement data = simulate_ellipsometer(find_material("Cu-McPeak"), setup);
    const FitResult fit = fit_measurement(data, {});
    constexpr int draws = 2000;
    const BootstrapResult result = bootstrap(data, {}, fit, {draws, 7});
    EXPECT_EQ(result.failures, 0);
    ASSERT_EQ(result.points.size(), 3u);
    for (size_t i = 0; i < 3; ++i) {
        const FittedPoint& point = fit.points[i];
        const std::array<double, 4> normal = {-1.959964, -0.994458, 0.994458, 1.959964};
        const auto expect = [&](const Scatter& scatter, double value, double sigma) {
            EXPECT_EQ(scatter.draws, draws);
            EXPECT_NEAR(scatter.sigma, sigma, 4 * sigma / std::sqrt(2.0 * draws));
            EXPECT_NEAR(scatter.mean, value, 4 * sigma / std::sqrt(draws));
            for (size_t q = 0; q < 4; ++q) {
                const double widest = q == 1 || q == 2 ? 1.52 : 2.67;
                EXPECT_NEAR(scatter.quantiles[q], value + normal[q] * sigma,
                            4 * widest * sigma / std::sqrt(draws))
                    << "quantile " << bootstrap_quantiles[q];
            }
        };
        expect(result.points[i].n, point.n, point.sigma_n);
        expect(result.points[i].k, point.k, point.sigma_k);
    }
}

// The notes' Monte Carlo of silver from tan^2 Psi alone: biased towards larger k, and wider above.
TEST(Bootstrap, SilverFromTan2PsiIsSkewed) {
    FitOptions options;
    options.estimator = "rho2";
    const Measurement data = measured(metal_cases()[6], paper_angles(), 0);
    const FitResult fit = fit_measurement(data, options);
    const BootstrapResult result = bootstrap(data, options, fit, {2000, 1});
    const Scatter& k = result.points.at(0).k;
    EXPECT_GT(k.sigma, 1.02 * fit.points[0].sigma_k);
    EXPECT_GT(k.mean, fit.points[0].k);
    EXPECT_GT(k.quantiles[3] - fit.points[0].k, 1.15 * (fit.points[0].k - k.quantiles[0]));
}

TEST(Bootstrap, CommonParametersToo) {
    const Measurement data = measured_film(1500, 0.1, 3, {60});
    FitOptions options = anodised_options();
    options.film.largest_thickness_nm = 3000;
    const FitResult fit = fit_measurement(data, options);
    constexpr int draws = 60;
    const BootstrapResult result = bootstrap(data, options, fit, {draws, 5});
    ASSERT_EQ(result.common.size(), 2u);
    for (size_t i = 0; i < 2; ++i) {
        const double sigma = fit.common[i].sigma;
        EXPECT_NEAR(result.common[i].sigma, sigma, 4 * sigma / std::sqrt(2.0 * draws));
        EXPECT_NEAR(result.common[i].mean, fit.common[i].value, 4 * sigma / std::sqrt(draws));
    }
}

TEST(Bootstrap, TheLadderIsNotClimbedAgain) {
    SimulationSetup setup;
    setup.angles_deg = paper_angles();
    setup.wavelengths_nm = parse_grid("400:700:20", "wavelengths");
    Measurement data = simulate_ellipsometer(find_material("Cu-McPeak"), setup);
    for (MeasurementRow& row : data.rows) row.angle_deg += 0.1;
    FitOptions options;
    options.model = "auto";
    const FitResult fit = fit_measurement(data, options);
    ASSERT_EQ(fit.common.size(), 1u) << "the ladder should end on the angle offset";
    constexpr int draws = 300;
    const BootstrapResult result = bootstrap(data, options, fit, {draws, 5});
    ASSERT_EQ(result.common.size(), 1u);
    EXPECT_NEAR(result.common[0].sigma, fit.common[0].sigma,
                4 * fit.common[0].sigma / std::sqrt(2.0 * draws));
    EXPECT_NEAR(result.common[0].mean, fit.common[0].value,
                4 * fit.common[0].sigma / std::sqrt(draws));
}

// The scatter of the residuals stands in for standard deviations that nobody stated.
TEST(Bootstrap, UnweightedFitsTakeTheScatterOfTheirResiduals) {
    SimulationSetup setup;
    setup.angles_deg = paper_angles();
    setup.wavelengths_nm = parse_grid("400:700:4", "wavelengths");
    setup.sigma_psi_deg = setup.sigma_delta_deg = 0.2;
    const Measurement data = simulate_ellipsometer(find_material("Cu-McPeak"), setup);
    FitOptions options;
    options.unweighted = true;
    const FitResult fit = fit_measurement(data, options);
    constexpr int draws = 500;
    const BootstrapResult result = bootstrap(data, options, fit, {draws, 5});
    double ratio = 0;
    for (size_t i = 0; i < fit.points.size(); ++i) {
        ratio += result.points[i].n.sigma / fit.points[i].sigma_n;
    }
    EXPECT_NEAR(ratio / static_cast<double>(fit.points.size()), 1, 0.02);
}

TEST(Bootstrap, SameBitsForAnyNumberOfThreads) {
    const Measurement data = measured(metal_cases()[0], paper_angles(), 2);
    FitOptions options;
    options.threads = 1;
    const FitResult fit = fit_measurement(data, options);
    const BootstrapResult one = bootstrap(data, options, fit, {200, 3});
    options.threads = 5;
    const BootstrapResult five = bootstrap(data, options, fit, {200, 3});
    const BootstrapResult other = bootstrap(data, options, fit, {200, 4});
    EXPECT_EQ(one.points[0].n.sigma, five.points[0].n.sigma);
    EXPECT_EQ(one.points[0].k.quantiles, five.points[0].k.quantiles);
    EXPECT_NE(one.points[0].n.sigma, other.points[0].n.sigma);
}

TEST(Bootstrap, RefusesNumbersOfDrawsThatSayNothingOrNeverEnd) {
    const Measurement data = measured(metal_cases()[0], paper_angles(), 2);
    const FitResult fit = fit_measurement(data, {});
    for (const int draws : {-1, 0, 19, 1'000'001}) {
        EXPECT_THROW(bootstrap(data, {}, fit, {draws, 1}), Error) << draws;
    }
}

}  // namespace
}  // namespace drude
