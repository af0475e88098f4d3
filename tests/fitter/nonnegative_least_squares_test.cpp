#include "fitter/nonnegative_least_squares.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/counter_random.h"

namespace drude {
namespace {

TEST(NonnegativeLeastSquares, IsTheOrdinarySolutionWhereThatIsPositive) {
    Eigen::MatrixXd A(3, 2);
    A << 1, 0, 0, 2, 1, 1;
    const Eigen::Vector2d x(3, 0.5);
    EXPECT_LT((nonnegative_least_squares(A, A * x) - x).norm(), 1e-12);
}

TEST(NonnegativeLeastSquares, StopsAtZero) {
    // x = (1, -1) without the bound; with it y = 0 and x is the projection of b on the first
    // column.
    Eigen::MatrixXd A(2, 2);
    A << 1, 1, 0, 1;
    const Eigen::Vector2d b(0, -1);
    const Eigen::VectorXd x = nonnegative_least_squares(A, b);
    EXPECT_EQ(x(0), 0);
    EXPECT_EQ(x(1), 0);
    EXPECT_NEAR(nonnegative_least_squares(A, Eigen::Vector2d(2, -1))(0), 2, 1e-14);
}

// Kuhn and Tucker: where x > 0 the gradient vanishes, where x = 0 it points upwards.
TEST(NonnegativeLeastSquares, MeetsTheConditionsOfAMinimum) {
    for (uint64_t seed = 1; seed <= 40; ++seed) {
        Eigen::MatrixXd A(30, 12);
        Eigen::VectorXd b(30);
        uint64_t at = 0;
        for (Eigen::Index i = 0; i < A.rows(); ++i) {
            for (Eigen::Index j = 0; j < A.cols(); ++j) A(i, j) = normal_pair(seed, at++)[0];
            b(i) = normal_pair(seed, at++)[0];
        }
        const Eigen::VectorXd x = nonnegative_least_squares(A, b);
        const Eigen::VectorXd gradient = A.transpose() * (A * x - b);
        for (Eigen::Index j = 0; j < x.size(); ++j) {
            EXPECT_GE(x(j), 0);
            if (x(j) > 0) {
                EXPECT_NEAR(gradient(j), 0, 1e-10) << seed;
            } else {
                EXPECT_GT(gradient(j), -1e-10) << seed;
            }
        }
    }
}

TEST(NonnegativeLeastSquares, ColumnsOfZerosAndDoubledColumnsDoNoHarm) {
    Eigen::MatrixXd A(3, 3);
    A << 1, 0, 1, 2, 0, 2, 3, 0, 3;
    const Eigen::VectorXd x = nonnegative_least_squares(A, Eigen::Vector3d(2, 4, 6));
    EXPECT_EQ(x(1), 0);
    EXPECT_NEAR(x(0) + x(2), 2, 1e-12);
}

}  // namespace
}  // namespace drude
