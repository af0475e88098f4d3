#include "device/systematics.h"

#include <gtest/gtest.h>

namespace drude {
namespace {

// The bench does each harm visibly, and the countermeasure leaves no more than is said here:
// largest bias in degrees over five metals, six angles and the visible.
TEST(Systematics, CountermeasuresLeaveNoMoreThanTheirBounds) {
    struct Bound {
        double harm;  // least of the largest biases before, Psi and Delta together
        double psi, delta;
    };
    const std::vector<Bound> bounds = {
        {0, 1e-4, 2e-4},     // none
        {1, 1e-4, 3e-4},     // source
        {0.05, 1e-4, 1e-4},  // linearity
        {0.05, 0.02, 0.1},   // drift, shuffled
        {0.05, 1e-4, 1e-3},  // drift, fitted
        {0.2, 5e-4, 1e-3},   // eccentricity
        {0.25, 1e-4, 2e-4},  // analyser
        {0.4, 1e-3, 5e-3},   // polariser
        {0.4, 1e-4, 5e-4},   // both, calibrated
        {0, 5e-4, 2e-4},     // leak 1e-5
        {0.02, 0.05, 2e-4},  // leak 1e-3
        {0.02, 0.1, 0.1},    // mounts
        {1, 2e-3, 0.012},    // all
    };
    const std::vector<Systematic> cases = systematics();
    ASSERT_EQ(cases.size(), bounds.size());
    for (size_t i = 0; i < cases.size(); ++i) {
        const Bias before = measure_bias(cases[i], cases[i].before);
        const Bias after = measure_bias(cases[i], cases[i].after);
        EXPECT_EQ(before.missing, 0) << cases[i].name;
        EXPECT_EQ(after.missing, 0) << cases[i].name;
        EXPECT_GE(std::max(before.max_psi, before.max_delta), bounds[i].harm) << cases[i].name;
        EXPECT_LE(after.max_psi, bounds[i].psi) << cases[i].name << ": " << cases[i].countermeasure;
        EXPECT_LE(after.max_delta, bounds[i].delta)
            << cases[i].name << ": " << cases[i].countermeasure;
        if (cases[i].name == "polarisers leak 1e-3") {
            EXPECT_GT(before.depolarization, 2e-3);
            EXPECT_LT(after.depolarization, 1e-4);
        }
        if (cases[i].seeds == 1) continue;
        // Of a few dozen independent sweeps: what the reduction says that all wavelengths share.
        EXPECT_NEAR(before.rms_psi / before.common_psi, 1, 0.25);
        EXPECT_NEAR(after.rms_psi / after.common_psi, 1, 0.25);
        EXPECT_NEAR(after.rms_delta / after.common_delta, 1, 0.3);
    }
}

TEST(Systematics, TheFourthHarmonicTellsOfSourceAndLinearity) {
    for (const Systematic& systematic : systematics()) {
        SweepPlan plan;
        plan.harmonic_4 = true;
        const Bias bias = measure_bias(systematic, plan);
        if (systematic.name == "none") {
            EXPECT_LT(bias.harmonic_4, 1e-9);
        } else if (systematic.name.find("source") == 0) {
            EXPECT_NEAR(bias.harmonic_4, 0.01, 0.003);
        } else if (systematic.name.find("detector") == 0) {
            EXPECT_GT(bias.harmonic_4, 5e-4);
        } else if (systematic.name.find("analyser") == 0) {
            EXPECT_LT(bias.harmonic_4, 1e-9);
        }
    }
}

}  // namespace
}  // namespace drude
