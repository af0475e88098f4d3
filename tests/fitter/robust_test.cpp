// Losses that a few bad rows do not move.
#include "fitter/robust_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/numbers.h"
#include "device/virtual/ellipsometer_simulation.h"
#include "film_cases.h"
#include "fit_cases.h"

namespace drude {
namespace {

const char* const losses[] = {"huber", "cauchy", "tukey"};

Measurement copper(uint64_t seed) {
    SimulationSetup setup;
    setup.angles_deg = paper_angles();
    setup.wavelengths_nm = parse_grid("400:700:10", "wavelengths");
    setup.seed = seed;
    return simulate_ellipsometer(find_material("Cu-McPeak"), setup);
}

// Every twentieth row is off by 3 degrees in Psi and 10 in Delta: 60 and 100 standard deviations.
int spoil(Measurement* data) {
    int spoiled = 0;
    for (size_t i = 7; i < data->rows.size(); i += 20) {
        data->rows[i].psi_deg += i % 40 == 7 ? 3 : -3;
        data->rows[i].delta_deg += i % 3 == 0 ? 10 : -10;
        ++spoiled;
    }
    return spoiled;
}

struct Pulls {
    double largest = 0, sum2 = 0;
    int values = 0;
};

Pulls pulls_of(const FitResult& fit, double offset_deg = 0) {
    const OpticalConstants& truth = published_set("Cu-McPeak");
    Pulls pulls;
    const auto add = [&](double pull) {
        pulls.largest = std::max(pulls.largest, std::abs(pull));
        pulls.sum2 += pull * pull;
        ++pulls.values;
    };
    for (const FittedPoint& point : fit.points) {
        const Index index = truth.at(point.wavelength_nm);
        add((point.n - index.n) / point.sigma_n);
        add((point.k - index.k) / point.sigma_k);
    }
    for (const FittedParameter& p : fit.common) add((p.value - offset_deg) / p.sigma);
    return pulls;
}

TEST(Robust, GrossOutliersDoNotMoveTheConstants) {
    Measurement data = copper(3);
    const int spoiled = spoil(&data);
    ASSERT_NEAR(static_cast<double>(spoiled) / static_cast<double>(data.rows.size()), 0.05, 0.005);
    EXPECT_GT(pulls_of(fit_measurement(data, {})).largest, 20);
    for (const char* loss : losses) {
        FitOptions options;
        options.robust = loss;
        const FitResult fit = fit_measurement(data, options);
        const Pulls pulls = pulls_of(fit);
        // A row that counts a little still pulls a little: not so with tukey.
        EXPECT_LT(pulls.largest, 5) << loss;
        EXPECT_LT(pulls.sum2 / pulls.values, 1.5) << loss;
        EXPECT_EQ(fit.robust, loss);
        EXPECT_GE(fit.rows_down_weighted, spoiled) << loss;
        EXPECT_LE(fit.rows_down_weighted, spoiled + 20) << loss;
    }
}

TEST(Robust, Tan2PsiAloneToo) {
    Measurement data = copper(4);
    spoil(&data);
    FitOptions options;
    options.estimator = "rho2";
    const double plain = pulls_of(fit_measurement(data, options)).largest;
    options.robust = "tukey";
    const Pulls robust = pulls_of(fit_measurement(data, options));
    EXPECT_GT(plain, 20);
    EXPECT_LT(robust.largest, 5);
}

TEST(Robust, AnAngleOffsetToo) {
    Measurement data = copper(5);
    spoil(&data);
    for (MeasurementRow& row : data.rows) row.angle_deg += 0.1;
    FitOptions options;
    options.fit_angle_offset = true;
    options.robust = "tukey";
    const FitResult fit = fit_measurement(data, options);
    ASSERT_EQ(fit.common.size(), 1u);
    EXPECT_NEAR(fit.common[0].value, -0.1, 4 * fit.common[0].sigma);
    EXPECT_LT(pulls_of(fit, -0.1).largest, 6);
}

TEST(Robust, AFilmToo) {
    Measurement data = measured_film(2500, 0.15, 11);
    spoil(&data);
    FitOptions options = anodised_options();
    options.film.largest_thickness_nm = 4000;
    const FitResult plain = fit_measurement(data, options);
    EXPECT_GT(plain.chi2_reduced(), 50);
    options.robust = "tukey";
    const FitResult fit = fit_measurement(data, options);
    const double truth[] = {2500, 0.15};
    ASSERT_EQ(fit.common.size(), 2u);
    for (size_t i = 0; i < 2; ++i) {
        EXPECT_NEAR(fit.common[i].value, truth[i], 4 * fit.common[i].sigma) << fit.common[i].name;
    }
    EXPECT_LT(fit.chi2_reduced(), 1.5);
}

// On normal data nothing is lost but some per cent, and the standard deviations say so: the scatter
// of the values in units of their own sigmas is that of the asymptotic theory, 1/1.021, 1/1.100 and
// 1/1.055 for pairs (quadrature over the normal density of two dimensions), to which six angles
// come within some per cent.
TEST(Robust, StandardDeviationsHoldOnNormalData) {
    const double expected[] = {1 / 1.021, 1 / 1.100, 1 / 1.055};
    for (size_t i = 0; i < 3; ++i) {
        FitOptions options;
        options.robust = losses[i];
        double sum2 = 0;
        int values = 0;
        for (uint64_t seed = 100; seed < 110; ++seed) {
            const Pulls pulls = pulls_of(fit_measurement(copper(seed), options));
            sum2 += pulls.sum2;
            values += pulls.values;
        }
        // 620 values: a scatter of 3 %.
        EXPECT_NEAR(std::sqrt(sum2 / values), expected[i], 0.1) << losses[i];
    }
}

TEST(Robust, DataWithoutNoiseAreLeftAsTheyAre) {
    for (const MetalCase& metal : metal_cases()) {
        for (const char* loss : losses) {
            FitOptions options;
            options.robust = loss;
            const FitResult fit = fit_measurement(measured(metal, paper_angles(), 0), options);
            EXPECT_NEAR(fit.points[0].n, metal.n, 1e-8) << metal.name << " " << loss;
            EXPECT_NEAR(fit.points[0].k, metal.k, 1e-8) << metal.name << " " << loss;
            EXPECT_NEAR(fit.points[0].sigma_n, metal.sd_n_both, 0.000051) << metal.name;
            EXPECT_EQ(fit.rows_down_weighted, 0);
        }
    }
}

// At the solution the gradient of the sum of losses vanishes: moving n or k by a hundredth of a
// standard deviation either way makes it grow.
TEST(Robust, TheSumOfLossesIsSmallest) {
    Measurement data = measured(metal_cases()[0], paper_angles(), 9);
    data.rows[2].delta_deg += 3;
    for (const char* loss : losses) {
        FitOptions options;
        options.robust = loss;
        const FittedPoint point = fit_measurement(data, options).points[0];
        const auto sum_at = [&](double n, double k) {
            double sum = 0;
            for (const MeasurementRow& row : data.rows) {
                const Reflection<double> r =
                    reflect(ComplexIndex<double>{n, k}, std::cos(row.angle_deg * pi / 180));
                const double dpsi = (psi(r) * 180 / pi - row.psi_deg) / row.sigma_psi_deg;
                const double ddelta = (delta(r) * 180 / pi - row.delta_deg) / row.sigma_delta_deg;
                const double s = dpsi * dpsi + ddelta * ddelta, c = robust_constant(loss);
                const std::string name = loss;
                if (name == "huber") {
                    sum += s <= c * c ? s : 2 * c * std::sqrt(s) - c * c;
                } else if (name == "cauchy") {
                    sum += c * c * std::log1p(s / (c * c));
                } else {
                    sum += s <= c * c ? c * c / 3 * (1 - std::pow(1 - s / (c * c), 3)) : c * c / 3;
                }
            }
            return sum;
        };
        const double best = sum_at(point.n, point.k);
        EXPECT_NEAR(point.chi2, best, 0.02 * best) << loss;
        for (const double step : {-0.05, 0.05}) {
            EXPECT_GT(sum_at(point.n + step * point.sigma_n, point.k), best) << loss;
            EXPECT_GT(sum_at(point.n, point.k + step * point.sigma_k), best) << loss;
        }
    }
}

TEST(Robust, SaysWhereItCannotBeHad) {
    const Measurement data = measured(metal_cases()[0], paper_angles(), 1);
    const auto message = [&](const FitOptions& options) -> std::string {
        try {
            fit_measurement(data, options);
        } catch (const Error& error) {
            EXPECT_EQ(error.cause(), Cause::user);
            return error.message();
        }
        return "";
    };
    FitOptions options;
    options.robust = "hubert";
    EXPECT_NE(message(options).find("did you mean 'huber'"), std::string::npos);
    options.robust = "huber";
    options.estimator = "inversion";
    EXPECT_NE(message(options).find("minimises nothing"), std::string::npos);
    options.estimator = "psi-delta";
    options.model = "auto";
    EXPECT_NE(message(options).find("chi-squares"), std::string::npos);
    options.model = "bulk";
    options.unweighted = true;
    EXPECT_NE(message(options).find("unweighted"), std::string::npos);
}

}  // namespace
}  // namespace drude
