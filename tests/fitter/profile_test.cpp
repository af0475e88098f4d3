// Profile likelihood against the covariance, against brute force, and where it is open.
#include "fitter/profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/numbers.h"
#include "device/virtual/ellipsometer_simulation.h"
#include "film_cases.h"
#include "fit_cases.h"
#include "fitter/point_profile.h"

namespace drude {
namespace {

const double roots[] = {1, std::sqrt(profile_rises[1])};

TEST(ProfileInterval, OfAParabolaIsItsStandardDeviation) {
    const auto parabola = [](double x) { return 5 + (x - 2) * (x - 2) / 0.09; };
    for (const double guess : {0.3, 1e-5, 40.0, std::nan("")}) {
        const Profile profile = profile_of(parabola, 2, 5, guess, -10, 10);
        for (size_t i = 0; i < 2; ++i) {
            EXPECT_NEAR(profile.intervals[i].lower, 2 - 0.3 * roots[i], 1e-4) << guess;
            EXPECT_NEAR(profile.intervals[i].upper, 2 + 0.3 * roots[i], 1e-4) << guess;
        }
        EXPECT_EQ(profile.deepest, 0);
    }
}

TEST(ProfileInterval, IsOpenWhereTheRiseIsNotReachedBeforeTheBound) {
    // Levels off at 2 on the right, and the left bound is at a rise of 1.44.
    const auto valley = [](double x) { return x > 0 ? 2 * x * x / (1 + x * x) : x * x; };
    const Profile profile = profile_of(valley, 0, 0, 1, -1.2, 1e6);
    EXPECT_NEAR(profile.intervals[0].lower, -1, 1e-4);
    EXPECT_NEAR(profile.intervals[0].upper, 1, 1e-4);
    EXPECT_TRUE(std::isnan(profile.intervals[1].lower));
    EXPECT_TRUE(std::isnan(profile.intervals[1].upper));
    // At its bound already.
    const Profile at_bound = profile_of(valley, 0, 0, 1, 0, 10);
    EXPECT_TRUE(std::isnan(at_bound.intervals[0].lower));
    EXPECT_NEAR(at_bound.intervals[0].upper, 1, 1e-4);
}

TEST(ProfileInterval, WallsAndLowerMinimaAreSeen) {
    const auto wall = [](double x) { return x < 0.5 ? 0.1 * x * x : std::nan(""); };
    EXPECT_NEAR(profile_of(wall, 0, 0, 1, -10, 10).intervals[0].upper, 0.5, 1e-3);
    const auto deeper = [](double x) { return 1 - std::cos(x) - (x > 4 ? 3 : 0); };
    EXPECT_GT(profile_of(deeper, 0, 0, 5, -10, 10).deepest, 1);
}

TEST(LineMinimum, OfKnownFunctions) {
    const auto cubic = [](double x) { return x * x * x - 3 * x; };
    EXPECT_NEAR(minimise_on_line(cubic, 0, 5, 1e-8).at, 1, 1e-6);
    EXPECT_NEAR(minimise_on_line(cubic, 0, 5, 1e-8).value, -2, 1e-12);
    const auto kink = [](double x) { return std::abs(x - 0.3); };
    EXPECT_NEAR(minimise_on_line(kink, -4, 1, 1e-6).at, 0.3, 1e-5);
    // At an end.
    EXPECT_NEAR(minimise_on_line(cubic, 2, 3, 1e-6).at, 2, 1e-5);
}

TEST(Chebyshev, InterpolatesPolynomialsExactly) {
    const auto f = [](double x) { return ((x - 2) * x + 0.5) * x * x - 1; };
    std::vector<double> values;
    for (size_t i = 0; i < 6; ++i) values.push_back(f(chebyshev_point(i, 6, -1.5, 2)));
    for (const double x : {-1.5, -1.0, 0.1, 0.25, 1.99, 2.0}) {
        EXPECT_NEAR(chebyshev_value(values, -1.5, 2, x), f(x), 1e-12) << x;
    }
}

TEST(Profile, EqualsTheStandardDeviationWhereTheProblemIsNearlyLinear) {
    const Measurement data = measured(metal_cases()[0], paper_angles(), 3);
    const FitResult fit = fit_measurement(data, {});
    const ProfileResult result = profile_likelihood(data, {}, fit);
    ASSERT_EQ(result.parameters.size(), 2u);
    EXPECT_TRUE(result.warnings.empty());
    for (const ProfiledParameter& p : result.parameters) {
        EXPECT_EQ(p.wavelength_nm, 516);
        for (size_t i = 0; i < 2; ++i) {
            EXPECT_NEAR(p.intervals[i].lower, p.value - roots[i] * p.sigma, 0.01 * p.sigma);
            EXPECT_NEAR(p.intervals[i].upper, p.value + roots[i] * p.sigma, 0.01 * p.sigma);
        }
    }
}

// The definition itself, on a grid of both indices.
TEST(Profile, MatchesBruteForce) {
    FitOptions options;
    options.estimator = "rho2";
    const Measurement data = measured(metal_cases()[5], paper_angles(), 4);
    const FitResult fit = fit_measurement(data, options);
    const ProfileResult result = profile_likelihood(data, options, fit);
    const ProfiledParameter& k = result.parameters.at(1);
    const auto chi2_at = [&](double n, double held) {
        double sum = 0;
        for (const MeasurementRow& row : data.rows) {
            const Reflection<double> r =
                reflect(ComplexIndex<double>{n, held}, std::cos(row.angle_deg * pi / 180));
            const double t = std::tan(row.psi_deg * pi / 180);
            const double sigma = 2 * t * (1 + t * t) * row.sigma_psi_deg * pi / 180;
            sum += std::pow((r.Rp / r.Rs - t * t) / sigma, 2);
        }
        return sum;
    };
    for (size_t i = 0; i < 2; ++i) {
        for (const double end : {k.intervals[i].lower, k.intervals[i].upper}) {
            double smallest = 1e9;
            for (int j = 0; j <= 20000; ++j) smallest = std::min(smallest, chi2_at(j * 5e-5, end));
            EXPECT_NEAR(smallest - fit.chi2, profile_rises[i], 0.01) << end;
        }
    }
}

// Silver from tan^2 Psi alone: a long curved valley (condition 139). Two small angles leave k
// almost free on its way to a perfect mirror, where the covariance has it symmetric; an instrument
// ten times as coarse sets no upper limit at all.
TEST(Profile, OfSilverFromTan2PsiIsSkewedAndOpens) {
    FitOptions options;
    options.estimator = "rho2";
    const auto profile_of_k = [&](const Measurement& data) {
        return profile_likelihood(data, options, fit_measurement(data, options)).parameters.at(1);
    };
    const ProfiledParameter k = profile_of_k(measured(metal_cases()[6], paper_angles(), 0));
    EXPECT_EQ(k.name, "k");
    for (const ProfileInterval& interval : k.intervals) {
        EXPECT_GT((interval.upper - k.value) / (k.value - interval.lower), 1.1);
    }
    Measurement few = measured(metal_cases()[6], {45, 50}, 0);
    const ProfiledParameter wide = profile_of_k(few);
    EXPECT_LT(wide.value - wide.sigma, -5);
    EXPECT_GT(wide.intervals[0].lower, 0.1);
    EXPECT_GT(wide.intervals[0].upper, wide.value + 5 * wide.sigma);
    for (MeasurementRow& row : few.rows) row.sigma_psi_deg *= 10;
    const ProfiledParameter open = profile_of_k(few);
    EXPECT_TRUE(std::isnan(open.intervals[1].upper)) << open.intervals[1].upper;
    EXPECT_TRUE(std::isnan(open.intervals[1].lower)) << open.intervals[1].lower;
}

SimulationSetup copper_setup() {
    SimulationSetup setup;
    setup.angles_deg = paper_angles();
    setup.wavelengths_nm = parse_grid("400:700:30", "wavelengths");
    return setup;
}

// Through the table of the other wavelengths' chi-square, n and k see the offset as the covariance
// of all parameters together does.
TEST(Profile, WithAnAngleOffset) {
    const Measurement data = simulate_ellipsometer(find_material("Cu-McPeak"), copper_setup());
    FitOptions options;
    options.fit_angle_offset = true;
    const FitResult fit = fit_measurement(data, options);
    const ProfileResult result = profile_likelihood(data, options, fit, {402, 550});
    ASSERT_EQ(result.parameters.size(), 1u + 2 * 2);
    EXPECT_EQ(result.parameters[0].name, "angle offset");
    EXPECT_EQ(result.parameters[1].wavelength_nm, 400);
    EXPECT_EQ(result.parameters[3].wavelength_nm, 550);
    for (const ProfiledParameter& p : result.parameters) {
        for (size_t i = 0; i < 2; ++i) {
            EXPECT_NEAR(p.intervals[i].lower, p.value - roots[i] * p.sigma, 0.03 * p.sigma)
                << p.name;
            EXPECT_NEAR(p.intervals[i].upper, p.value + roots[i] * p.sigma, 0.03 * p.sigma)
                << p.name;
        }
    }
}

TEST(Profile, SameBitsForAnyNumberOfThreads) {
    const Measurement data = simulate_ellipsometer(find_material("Cu-McPeak"), copper_setup());
    FitOptions options;
    options.fit_angle_offset = true;
    options.threads = 1;
    const FitResult fit = fit_measurement(data, options);
    const ProfileResult one = profile_likelihood(data, options, fit);
    options.threads = 5;
    const ProfileResult five = profile_likelihood(data, options, fit);
    ASSERT_EQ(one.parameters.size(), 1u + 2 * 11);
    ASSERT_EQ(five.parameters.size(), one.parameters.size());
    for (size_t i = 0; i < one.parameters.size(); ++i) {
        EXPECT_EQ(one.parameters[i].intervals[0].lower, five.parameters[i].intervals[0].lower);
        EXPECT_EQ(one.parameters[i].intervals[1].upper, five.parameters[i].intervals[1].upper);
    }
}

TEST(Profile, OfAFilm) {
    const Measurement data = measured_film(1500, 0.1, 3);
    FitOptions options = anodised_options();
    options.film.largest_thickness_nm = 3000;
    const FitResult thick = fit_measurement(data, options);
    const ProfileResult closed = profile_likelihood(data, options, thick);
    ASSERT_EQ(closed.parameters.size(), 2u);
    for (const ProfiledParameter& p : closed.parameters) {
        for (size_t i = 0; i < 2; ++i) {
            EXPECT_NEAR(p.intervals[i].lower, p.value - roots[i] * p.sigma, 0.03 * p.sigma);
            EXPECT_NEAR(p.intervals[i].upper, p.value + roots[i] * p.sigma, 0.03 * p.sigma);
        }
    }
    // A film too thin to tell porosity from thickness: it may have no pores at all.
    const Measurement thin = measured_film(1, 0.2, 3);
    options.film.largest_thickness_nm = 100;
    const FitResult fit = fit_measurement(thin, options);
    const ProfileResult result = profile_likelihood(thin, options, fit);
    const ProfiledParameter& porosity = result.parameters.at(1);
    EXPECT_EQ(porosity.name, "porosity");
    EXPECT_TRUE(std::isnan(porosity.intervals[1].lower));
}

TEST(Profile, UnweightedFitsMeasureTheRiseInTheirOwnScatter) {
    SimulationSetup setup = copper_setup();
    setup.sigma_psi_deg = setup.sigma_delta_deg = 0.2;
    const Measurement data = simulate_ellipsometer(find_material("Cu-McPeak"), setup);
    FitOptions options;
    options.unweighted = true;
    const FitResult fit = fit_measurement(data, options);
    for (const ProfiledParameter& p : profile_likelihood(data, options, fit).parameters) {
        EXPECT_NEAR(p.intervals[0].upper, p.value + p.sigma, 0.03 * p.sigma) << p.wavelength_nm;
    }
}

TEST(Profile, SaysWhereItCannotBeHad) {
    const Measurement data = measured(metal_cases()[0], paper_angles(), 3);
    FitOptions options;
    EXPECT_THROW(profile_likelihood(data, options, fit_measurement(data, options), {600}), Error);
    options.robust = "huber";
    EXPECT_THROW(profile_likelihood(data, options, fit_measurement(data, options)), Error);
    options.robust = "none";
    options.estimator = "inversion";
    EXPECT_THROW(profile_likelihood(data, options, fit_measurement(data, options)), Error);
}

}  // namespace
}  // namespace drude
