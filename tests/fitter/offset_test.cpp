// A common error of the angles of incidence as a parameter.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/numbers.h"
#include "device/virtual/ellipsometer_simulation.h"
#include "fit_cases.h"
#include "fitter/fit.h"

namespace drude {
namespace {

FitOptions with_offset() {
    FitOptions options;
    options.fit_angle_offset = true;
    return options;
}

TEST(AngleOffset, NoiseFreeDataGiveItBack) {
    for (const MetalCase& metal : metal_cases()) {
        for (const double offset : {-0.5, 0.0, 0.05}) {
            Measurement data = measured(metal, paper_angles(), 0);
            for (MeasurementRow& row : data.rows) row.angle_deg -= offset;
            const FitResult fit = fit_measurement(data, with_offset());
            ASSERT_EQ(fit.common.size(), 1u);
            EXPECT_NEAR(fit.common[0].value, offset, 1e-4) << metal.name;
            EXPECT_NEAR(fit.points[0].n, metal.n, 2e-4) << metal.name;
            EXPECT_NEAR(fit.points[0].k, metal.k, 2e-4) << metal.name;
            EXPECT_EQ(fit.dof(), 12 - 3);
        }
    }
}

// Independent implementation (scipy), one wavelength and six angles: 0.042 to 0.052 degrees over
// the metals; sigma of k grows to 0.0065 to 0.0275.
TEST(AngleOffset, StandardDeviationsMatchAnIndependentImplementation) {
    double least = 1, most = 0, least_k = 1, most_k = 0;
    for (const MetalCase& metal : metal_cases()) {
        const FitResult fit = fit_measurement(measured(metal, paper_angles(), 0), with_offset());
        least = std::min(least, fit.common[0].sigma);
        most = std::max(most, fit.common[0].sigma);
        least_k = std::min(least_k, fit.points[0].sigma_k);
        most_k = std::max(most_k, fit.points[0].sigma_k);
    }
    EXPECT_NEAR(least, 0.042, 0.001);
    EXPECT_NEAR(most, 0.052, 0.001);
    EXPECT_NEAR(least_k, 0.0065, 0.0005);
    EXPECT_NEAR(most_k, 0.0275, 0.001);
}

TEST(AngleOffset, SigmasCoverTheScatterOverManyWavelengths) {
    SimulationSetup setup;
    setup.angles_deg = {60, 70, 75};
    setup.wavelengths_nm = parse_grid("400:700:20", "wavelengths");
    const Material truth = find_material("Cu-McPeak");
    int offset_1 = 0, within_1 = 0, values = 0;
    constexpr int draws = 60;
    for (uint64_t seed = 1; seed <= draws; ++seed) {
        setup.seed = seed;
        Measurement data = simulate_ellipsometer(truth, setup);
        for (MeasurementRow& row : data.rows) row.angle_deg += 0.1;
        const FitResult fit = fit_measurement(data, with_offset());
        if (std::abs(fit.common[0].value + 0.1) < fit.common[0].sigma) ++offset_1;
        EXPECT_NEAR(fit.common[0].value, -0.1, 4.5 * fit.common[0].sigma);
        for (const FittedPoint& point : fit.points) {
            const Index index = truth.substrate.at(point.wavelength_nm);
            values += 2;
            if (std::abs(point.n - index.n) < point.sigma_n) ++within_1;
            if (std::abs(point.k - index.k) < point.sigma_k) ++within_1;
        }
    }
    // The 16 wavelengths of a draw share its offset, so 60 draws count, not 1920 values.
    EXPECT_NEAR(offset_1, 0.683 * draws, 3 * std::sqrt(draws * 0.217));
    EXPECT_NEAR(within_1, 0.683 * values, 0.12 * values);
}

TEST(AngleOffset, TakesThreeAngles) {
    try {
        fit_measurement(measured(metal_cases()[0], {60, 70}, 1), with_offset());
        FAIL() << "two angles were taken";
    } catch (const Error& error) {
        EXPECT_EQ(error.cause(), Cause::answer_is_no);
        EXPECT_NE(error.message().find("three angles"), std::string::npos);
    }
}

}  // namespace
}  // namespace drude
