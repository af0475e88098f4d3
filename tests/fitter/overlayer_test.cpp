// n and k below a layer that the user knows.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "device/virtual/ellipsometer_simulation.h"
#include "fit_cases.h"
#include "fitter/fit.h"
#include "fitter/fitted_material.h"
#include "fitter/named_constants.h"

namespace drude {
namespace {

struct LayeredCase {
    const char* name;
    double n, k;            // of the metal
    const char* layer;      // constants, thickness
    double bare_n, bare_k;  // what a bare surface is found to have
};

// Independent implementation (scipy) at 550 nm or near, six angles.
const LayeredCase layered_cases[] = {
    {"Al + 3 nm Al2O3", .871, 6.235, "1.77,0,3", .653, 5.357},
    {"Al + 10 nm Al2O3", .871, 6.235, "1.77,0,10", .382, 3.999},
    {"Ag + 2 nm tarnish", .05, 3.085, "2.9,0.6,2", .129, 2.737},
    {"Cu + 2 nm oxide", 1.19, 2.60, "3.1,0.2,2", 1.087, 2.308},
    {"Cu + 10 nm oxide", 1.19, 2.60, "3.1,0.2,10", .769, 1.365},
};

Measurement measured_below(const LayeredCase& sample, uint64_t seed) {
    Material material =
        material_from_set(find_constants(fmt::format("{},{}", sample.n, sample.k), "metal"));
    material.layers = {find_layer(sample.layer, "layer")};
    SimulationSetup setup;
    setup.angles_deg = paper_angles();
    setup.wavelengths_nm = {516};
    setup.seed = seed;
    if (seed == 0) setup.sigma_psi_deg = setup.sigma_delta_deg = 0;
    return simulate_ellipsometer(material, setup);
}

FitOptions below(const char* layer) {
    FitOptions options;
    options.model = "overlayer";
    options.overlayers = {find_layer(layer, "layer")};
    return options;
}

TEST(Overlayer, TheKnownLayerIsTakenAway) {
    for (const LayeredCase& sample : layered_cases) {
        const Measurement data = measured_below(sample, 0);
        const FitResult fit = fit_measurement(data, below(sample.layer));
        EXPECT_NEAR(fit.points[0].n, sample.n, 1e-6) << sample.name;
        EXPECT_NEAR(fit.points[0].k, sample.k, 1e-6) << sample.name;
        EXPECT_LT(fit.chi2, 1e-10) << sample.name;
    }
}

TEST(Overlayer, WithoutItPseudoConstantsAreWhatOthersFind) {
    for (const LayeredCase& sample : layered_cases) {
        const FitResult bare = fit_measurement(measured_below(sample, 0), {});
        // The wavelengths of the table are not stated to the nanometre.
        EXPECT_NEAR(bare.points[0].n, sample.bare_n, 0.03 * sample.bare_n) << sample.name;
        EXPECT_NEAR(bare.points[0].k, sample.bare_k, 0.03 * sample.bare_k) << sample.name;
    }
}

TEST(Overlayer, ThickLayersDoNotTrapTheFit) {
    for (const double thickness : {50.0, 120.0, 333.0, 1000.0}) {
        for (const MetalCase& metal : metal_cases()) {
            const std::string layer = fmt::format("1.65,0,{}", thickness);
            const LayeredCase sample{"", metal.n, metal.k, layer.c_str(), 0, 0};
            const FitResult fit = fit_measurement(measured_below(sample, 0), below(layer.c_str()));
            EXPECT_NEAR(fit.points[0].n, metal.n, 1e-5) << metal.name << " " << thickness;
            EXPECT_NEAR(fit.points[0].k, metal.k, 1e-5) << metal.name << " " << thickness;
        }
    }
}

TEST(Overlayer, StandardDeviationsCoverTheScatter) {
    int within_1 = 0, values = 0;
    for (const LayeredCase& sample : layered_cases) {
        for (uint64_t seed = 1; seed <= 200; ++seed) {
            const FittedPoint point =
                fit_measurement(measured_below(sample, seed), below(sample.layer)).points[0];
            values += 2;
            if (std::abs(point.n - sample.n) < point.sigma_n) ++within_1;
            if (std::abs(point.k - sample.k) < point.sigma_k) ++within_1;
        }
    }
    // 2000 values scatter by 1 % about 68.3 %; n >= 0 cuts into silver's.
    EXPECT_NEAR(within_1, 0.683 * values, 0.045 * values);
}

TEST(Overlayer, TheMaterialCarriesTheLayer) {
    const LayeredCase& sample = layered_cases[1];
    const Measurement data = measured_below(sample, 0);
    const FitResult fit = fit_measurement(data, below(sample.layer));
    const Material material = fitted_material(fit, data, "Al", {});
    ASSERT_EQ(material.layers.size(), 1u);
    EXPECT_EQ(material.layers[0].thickness_nm, 10);
    EXPECT_EQ(material.substrate.citation.find("pseudo"), std::string::npos);
    EXPECT_NE(fitted_material(fit_measurement(data, {}), data, "Al", {})
                  .substrate.citation.find("pseudo"),
              std::string::npos);
}

TEST(Overlayer, IsRefusedWithoutALayerAndALayerWithoutIt) {
    const Measurement data = measured_below(layered_cases[0], 0);
    FitOptions options = below("1.77,0,3");
    options.overlayers.clear();
    EXPECT_THROW(fit_measurement(data, options), Error);
    options = below("1.77,0,3");
    options.model = "bulk";
    EXPECT_THROW(fit_measurement(data, options), Error);
    options = below("1.77,0,3");
    options.estimator = "inversion";
    EXPECT_THROW(fit_measurement(data, options), Error);
}

}  // namespace
}  // namespace drude
