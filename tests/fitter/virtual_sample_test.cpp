// The five virtual samples of the study, measured with noise and fitted: do the fits say what is
// true, and do they know how well they know it?
#include <gtest/gtest.h>

#include <cmath>

#include "base/numbers.h"
#include "device/virtual/ellipsometer_simulation.h"
#include "fitter/fit.h"
#include "fitter/fitted_material.h"

namespace drude {
namespace {

constexpr int seeds = 20;

SimulationSetup study_setup() {
    SimulationSetup setup;
    setup.angles_deg = {45, 50, 60, 70, 75, 80};
    setup.wavelengths_nm = parse_grid("380:780:5", "wavelengths");
    return setup;
}

const std::vector<std::string>& study_sets() {
    static const std::vector<std::string> names = {"Cu-McPeak", "Ag-McPeak", "Au-McPeak",
                                                   "Al-McPeak", "Zn-Werner-DFT"};
    return names;
}

TEST(VirtualSamples, NoisyFitsAreWithinTheirOwnStandardDeviations) {
    int within_1 = 0, within_3 = 0, values = 0;
    for (const std::string& name : study_sets()) {
        const Material truth = find_material(name);
        SimulationSetup setup = study_setup();
        for (int seed = 1; seed <= seeds; ++seed) {
            setup.seed = static_cast<uint64_t>(seed);
            const FitResult fit = fit_measurement(simulate_ellipsometer(truth, setup), {});
            ASSERT_EQ(fit.points.size(), 81u);
            EXPECT_EQ(fit.dof(), 81 * (12 - 2));
            EXPECT_NEAR(fit.chi2_reduced(), 1, 3 * std::sqrt(2.0 / fit.dof()))
                << name << " seed " << seed;
            for (const FittedPoint& point : fit.points) {
                const Index index = truth.substrate.at(point.wavelength_nm);
                const double pulls[] = {(point.n - index.n) / point.sigma_n,
                                        (point.k - index.k) / point.sigma_k};
                for (const double pull : pulls) {
                    ++values;
                    if (std::abs(pull) < 1) ++within_1;
                    if (std::abs(pull) < 3) ++within_3;
                }
            }
        }
    }
    EXPECT_EQ(values, 5 * seeds * 81 * 2);
    EXPECT_GE(within_3, 0.99 * values);
    // 68.3 % of 16200 values, with a scatter of 0.37 %: too wide a sigma fails here.
    EXPECT_NEAR(within_1, 0.6827 * values, 0.015 * values);
}

TEST(VirtualSamples, NoiseFreeMeasurementsGiveTheConstantsBack) {
    SimulationSetup setup = study_setup();
    setup.sigma_psi_deg = setup.sigma_delta_deg = 0;
    for (const std::string& name : study_sets()) {
        const Material truth = find_material(name);
        // Through the file, as a user goes: every digit has to survive it.
        const Measurement data =
            parse_measurement(format_measurement(simulate_ellipsometer(truth, setup)), "m.csv");
        const FitResult fit = fit_measurement(data, {});
        for (const FittedPoint& point : fit.points) {
            const Index index = truth.substrate.at(point.wavelength_nm);
            EXPECT_NEAR(point.n, index.n, 1e-8) << name << " " << point.wavelength_nm;
            EXPECT_NEAR(point.k, index.k, 1e-8) << name << " " << point.wavelength_nm;
        }
    }
}

TEST(VirtualSamples, PaperEstimatorIsHonestlyWorse) {
    FitOptions options;
    options.estimator = "rho2";
    int within_3 = 0, values = 0;
    for (const std::string& name : study_sets()) {
        const Material truth = find_material(name);
        SimulationSetup setup = study_setup();
        const Measurement data = simulate_ellipsometer(truth, setup);
        const FitResult rho2 = fit_measurement(data, options), both = fit_measurement(data, {});
        EXPECT_EQ(rho2.dof(), 81 * (6 - 2));
        for (size_t i = 0; i < rho2.points.size(); ++i) {
            const FittedPoint& point = rho2.points[i];
            ASSERT_TRUE(point.identifiable);
            EXPECT_GT(point.sigma_n, both.points[i].sigma_n);
            EXPECT_GT(point.sigma_k, both.points[i].sigma_k);
            const Index index = truth.substrate.at(point.wavelength_nm);
            ++values;
            if (std::abs(point.n - index.n) < 3 * point.sigma_n) ++within_3;
            ++values;
            if (std::abs(point.k - index.k) < 3 * point.sigma_k) ++within_3;
        }
    }
    // Long narrow valleys are not quite normal: less is asked than of psi-delta.
    EXPECT_GE(within_3, 0.97 * values);
}

TEST(VirtualSamples, TheFitBecomesAMaterialThatReadsBack) {
    const Measurement data = simulate_ellipsometer(find_material("Cu-McPeak"), study_setup());
    const FitResult fit = fit_measurement(data, {});
    Provenance provenance;
    provenance.measurement = "cu.csv";
    provenance.measurement_sha256 = std::string(64, 'a');
    provenance.command = "drude fit cu.csv";
    provenance.version = "0";
    const Material material = fitted_material(fit, data, "", provenance);
    EXPECT_EQ(material.name, "Cu-McPeak");
    EXPECT_EQ(material.substrate.kind, "fitted");
    EXPECT_EQ(material.beta, 0);
    const Material back = parse_material(format_material(material), "cu.json");
    ASSERT_EQ(back.substrate.n.size(), fit.points.size());
    for (size_t i = 0; i < fit.points.size(); ++i) {
        EXPECT_EQ(back.substrate.n[i], fit.points[i].n);
        EXPECT_EQ(back.substrate.k[i], fit.points[i].k);
        EXPECT_EQ(back.substrate.sigma_n[i], fit.points[i].sigma_n);
    }
    EXPECT_EQ(back.provenance.measurement_sha256, provenance.measurement_sha256);
}

}  // namespace
}  // namespace drude
