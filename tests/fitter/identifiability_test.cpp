#include "fitter/identifiability.h"

#include <gtest/gtest.h>

#include <cmath>

namespace drude {
namespace {

TEST(Identifiability, IndependentColumnsHaveTheirOwnSigmas) {
    const Identifiability known = analyse_jacobian({2, 0, 0, 0.5, 0, 0}, 3, 2);
    EXPECT_TRUE(known.all());
    EXPECT_NEAR(known.sigma[0], 0.5, 1e-15);
    EXPECT_NEAR(known.sigma[1], 2, 1e-15);
    EXPECT_NEAR(known.correlation[1], 0, 1e-15);
    EXPECT_NEAR(known.correlation[3], 1, 1e-15);
    EXPECT_NEAR(known.condition, 4, 1e-14);
}

TEST(Identifiability, CovarianceIsTheInverseOfTheNormalMatrix) {
    // J^T J = [14 32; 32 77], inverse [77 -32; -32 14]/54.
    const Identifiability known = analyse_jacobian({1, 4, 2, 5, 3, 6}, 3, 2);
    EXPECT_NEAR(known.sigma[0], std::sqrt(77.0 / 54), 1e-12);
    EXPECT_NEAR(known.sigma[1], std::sqrt(14.0 / 54), 1e-12);
    EXPECT_NEAR(known.correlation[1], -32 / std::sqrt(77.0 * 14), 1e-12);
}

// A parameter nothing depends on, as beta in Psi and Delta, never gets a standard deviation of 0.
TEST(Identifiability, AParameterWithoutEffectIsNamedAndHasNoSigma) {
    const Identifiability known = analyse_jacobian({1, 0, 2, 3, 0, 5, 4, 0, 1}, 3, 3);
    EXPECT_TRUE(known.identifiable[0]);
    EXPECT_FALSE(known.identifiable[1]);
    EXPECT_TRUE(known.identifiable[2]);
    EXPECT_FALSE(known.all());
    EXPECT_TRUE(std::isnan(known.sigma[1]));
    EXPECT_TRUE(std::isinf(known.condition));
}

TEST(Identifiability, TwoParametersThatActAlikeAreBothNamed) {
    const Identifiability known = analyse_jacobian({1, 2, 0, 2, 4, 1, 3, 6, 0}, 3, 3);
    EXPECT_FALSE(known.identifiable[0]);
    EXPECT_FALSE(known.identifiable[1]);
    EXPECT_TRUE(known.identifiable[2]);
}

TEST(Identifiability, UnitsDoNotMatter) {
    // The first parameter in units 1e14 times larger: full rank all the same.
    EXPECT_TRUE(analyse_jacobian({1e-14, 0, 0, 1, 1e-14, 1}, 3, 2).all());
}

TEST(Identifiability, FewerDataThanParametersOrNaN) {
    const Identifiability few = analyse_jacobian({1, 2}, 1, 2);
    EXPECT_FALSE(few.all());
    EXPECT_TRUE(std::isnan(few.sigma[0]));
    EXPECT_FALSE(analyse_jacobian({1, NAN, 3, 4}, 2, 2).all());
    EXPECT_FALSE(analyse_jacobian({}, 0, 2).all());
}

}  // namespace
}  // namespace drude
