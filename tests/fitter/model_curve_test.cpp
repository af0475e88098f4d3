// What fits predict, against an independent forward model.
#include "fitter/model_curve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/numbers.h"
#include "device/virtual/ellipsometer_simulation.h"
#include "film_cases.h"
#include "fit_cases.h"
#include "fitter/row_residuals.h"

namespace drude {
namespace {

SimulationSetup setup_of(double noise) {
    SimulationSetup setup;
    setup.angles_deg = {50, 60, 75};
    setup.wavelengths_nm = parse_grid("400:700:50", "wavelengths");
    setup.sigma_psi_deg = noise;
    setup.sigma_delta_deg = 2 * noise;
    return setup;
}

void expect_same(const Measurement& curve, const Measurement& data, double tolerance_deg) {
    ASSERT_EQ(curve.rows.size(), data.rows.size());
    for (size_t i = 0; i < data.rows.size(); ++i) {
        EXPECT_EQ(curve.rows[i].angle_deg, data.rows[i].angle_deg);
        EXPECT_EQ(curve.rows[i].wavelength_nm, data.rows[i].wavelength_nm);
        EXPECT_NEAR(curve.rows[i].psi_deg, data.rows[i].psi_deg, tolerance_deg);
        EXPECT_NEAR(std::remainder(curve.rows[i].delta_deg - data.rows[i].delta_deg, 360), 0,
                    tolerance_deg);
    }
}

TEST(ModelCurve, OfNoiseFreeDataIsTheData) {
    const Measurement bare = simulate_ellipsometer(find_material("Au-Johnson"), setup_of(0));
    expect_same(model_curve(fit_measurement(bare, {}), bare), bare, 1e-7);

    Material layered = find_material("Al-Rakic");
    layered.layers = {{published_set("Al2O3-Malitson-o"), 3}};
    const Measurement oxide = simulate_ellipsometer(layered, setup_of(0));
    FitOptions options;
    options.model = "overlayer";
    options.overlayers = layered.layers;
    expect_same(model_curve(fit_measurement(oxide, options), oxide), oxide, 1e-6);

    Measurement tilted = simulate_ellipsometer(find_material("Au-Johnson"), setup_of(0));
    for (MeasurementRow& row : tilted.rows) row.angle_deg -= 0.3;
    FitOptions offset;
    offset.fit_angle_offset = true;
    expect_same(model_curve(fit_measurement(tilted, offset), tilted), tilted, 2e-3);

    const Measurement film = measured_film(1200, 0.2, 0);
    FitOptions film_options = anodised_options();
    film_options.film.largest_thickness_nm = 2000;
    expect_same(model_curve(fit_measurement(film, film_options), film), film, 1e-4);
}

TEST(RowResiduals, AddUpToChiSquare) {
    const Measurement data = simulate_ellipsometer(find_material("Au-Johnson"), setup_of(0.05));
    for (const char* estimator : {"psi-delta", "rho2"}) {
        FitOptions options;
        options.estimator = estimator;
        const FitResult fit = fit_measurement(data, options);
        double sum = 0;
        for (const RowResidual& residual : row_residuals(fit, data, options)) {
            sum += residual.squared();
        }
        EXPECT_NEAR(sum, fit.chi2, 1e-6 * fit.chi2) << estimator;
    }
}

TEST(RowResiduals, AreUnknownWhereNothingWasFitted) {
    const Measurement data = simulate_ellipsometer(find_material("Au-Johnson"), setup_of(0.05));
    FitOptions options;
    options.first_nm = 500;
    const FitResult fit = fit_measurement(data, options);
    const auto residuals = row_residuals(fit, data, options);
    for (size_t i = 0; i < residuals.size(); ++i) {
        EXPECT_EQ(std::isnan(residuals[i].psi), data.rows[i].wavelength_nm < 500);
    }
}

TEST(Weights, OfOneAreNoneAndSmallOnesSilenceARow) {
    Measurement data = measured(metal_cases()[0], paper_angles(), 1);
    FitOptions options;
    const FittedPoint plain = fit_measurement(data, options).points[0];
    options.weights.assign(6, 1);
    EXPECT_EQ(fit_measurement(data, options).points[0].n, plain.n);
    data.rows[4].psi_deg += 5;
    options.weights[4] = 1e-12;
    const double silenced = fit_measurement(data, options).points[0].n;
    Measurement without = data;
    without.rows.erase(without.rows.begin() + 4);
    EXPECT_NEAR(silenced, fit_measurement(without, {}).points[0].n, 1e-6);
    // Four times the weight is half the standard deviation.
    options.weights.assign(6, 4);
    EXPECT_NEAR(fit_measurement(data, options).points[0].sigma_n,
                0.5 * fit_measurement(data, {}).points[0].sigma_n, 1e-9);
    for (const std::vector<double>& bad :
         {std::vector<double>(5, 1.0), std::vector<double>(6, 0.0), std::vector<double>(6, -1.0)}) {
        options.weights = bad;
        EXPECT_THROW(fit_measurement(data, options), Error);
    }
}

}  // namespace
}  // namespace drude
