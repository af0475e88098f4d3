// The estimator against the Cramer-Rao bound, a seeded subset of bench/cramer_rao.cpp.
#include "cramer_rao.h"

#include <gtest/gtest.h>

namespace drude {
namespace {

// Of 400 draws: the ratio of standard deviations scatters by 1/sqrt(2 x 400) = 3.5 %, the mean by
// 0.05 sigma, the coverage by sqrt(0.683 x 0.317/400) = 2.3 %. Bounds at 4.5 times that, plus what
// 10 000 draws may be off: none of the 42 numbers exceeds them by chance, and a weight wrong by a
// factor of 1.3 does.
TEST(CramerRao, PsiDeltaReachesTheBoundWithoutBiasAndKnowsIt) {
    const auto& metals = metal_cases();
    for (size_t i = 0; i < metals.size(); ++i) {
        const CramerRao result = sample_cramer_rao(metals[i], "psi-delta", i, 400, 0);
        EXPECT_EQ(result.refused, 0u) << metals[i].name;
        for (const Scatter& scatter : {result.n, result.k}) {
            EXPECT_NEAR(scatter.ratio, 1, 0.2) << metals[i].name;
            EXPECT_NEAR(scatter.bias, 0, 0.25) << metals[i].name;
            EXPECT_NEAR(scatter.coverage, 0.6827, 0.11) << metals[i].name;
        }
    }
}

// tan^2 Psi alone says less, never more: its bound lies above that of Psi and Delta.
TEST(CramerRao, BoundOfTan2PsiLiesAbove) {
    for (const MetalCase& metal : metal_cases()) {
        const Identifiability both = bound_at_truth(metal, Estimator::psi_delta);
        const Identifiability alone = bound_at_truth(metal, Estimator::rho2);
        EXPECT_GT(alone.sigma[0], 1.5 * both.sigma[0]) << metal.name;
        EXPECT_GT(alone.sigma[1], 2 * both.sigma[1]) << metal.name;
    }
}

// The printed digits of an independent implementation (scipy, central differences).
TEST(CramerRao, BoundsAndConditionsMatchAnIndependentImplementation) {
    for (const MetalCase& metal : metal_cases()) {
        const Identifiability both = bound_at_truth(metal, Estimator::psi_delta);
        EXPECT_NEAR(both.sigma[0], metal.sd_n_both, 0.000051) << metal.name;
        EXPECT_NEAR(both.sigma[1], metal.sd_k_both, 0.000051) << metal.name;
        EXPECT_NEAR(both.condition, metal.condition_both, 0.051) << metal.name;
        const Identifiability alone = bound_at_truth(metal, Estimator::rho2);
        EXPECT_NEAR(alone.sigma[0], metal.sd_n_rho2, 0.000051) << metal.name;
        EXPECT_NEAR(alone.sigma[1], metal.sd_k_rho2, metal.sd_k_rho2 > 0.1 ? 0.00051 : 0.000051)
            << metal.name;
        EXPECT_NEAR(alone.condition, metal.condition_rho2, 0.051) << metal.name;
    }
}

TEST(CramerRao, ThreadsDoNotChangeTheBits) {
    const MetalCase& metal = metal_cases()[3];
    const CramerRao serial = sample_cramer_rao(metal, "rho2", 3, 40, 1);
    const CramerRao parallel = sample_cramer_rao(metal, "rho2", 3, 40, 5);
    EXPECT_EQ(serial.n.ratio, parallel.n.ratio);
    EXPECT_EQ(serial.k.bias, parallel.k.bias);
    EXPECT_EQ(serial.k.coverage, parallel.k.coverage);
}

}  // namespace
}  // namespace drude
