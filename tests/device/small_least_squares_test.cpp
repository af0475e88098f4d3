#include "device/signal/small_least_squares.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "device/signal/wavelength_bins.h"

namespace drude {
namespace {

TEST(SmallLeastSquares, PseudoInverseOfAStraightLine) {
    // Weighted line through (0, 1), (1, 3), (2, 2) with weights 1, 2, 1: by hand, slope 1/2 and
    // value 9/4 at the centroid x = 1.
    const std::vector<DesignRow> design = {{1, 0}, {1, 1}, {1, 2}};
    const std::vector<double> y = {1, 3, 2};
    LeastSquares fit;
    ASSERT_TRUE(factorise(design, {1, 2, 1}, 2, &fit));
    double c[2] = {};
    for (int m = 0; m < 2; ++m) {
        for (size_t k = 0; k < 3; ++k) c[m] += fit.inverse[m * 3 + k] * y[k];
    }
    EXPECT_NEAR(c[1], 0.5, 1e-14);
    EXPECT_NEAR(c[0], 1.75, 1e-14);
    EXPECT_NEAR(std::accumulate(fit.leverage.begin(), fit.leverage.end(), 0.0), 2, 1e-14);
    // What has no weight has no say.
    ASSERT_TRUE(factorise(design, {1, 0, 1}, 2, &fit));
    EXPECT_EQ(fit.inverse[1], 0);
    EXPECT_EQ(fit.leverage[1], 0);
}

TEST(SmallLeastSquares, DependentColumnsAreRefused) {
    LeastSquares fit;
    EXPECT_FALSE(factorise({{1, 2}, {2, 4}, {3, 6}}, {1, 1, 1}, 2, &fit));
    EXPECT_FALSE(factorise({{1, 0}, {1, 1}}, {1, 0}, 2, &fit));
    EXPECT_FALSE(factorise({}, {}, 1, &fit));
}

TEST(SmallLeastSquares, NormalEquationsAndTheirInverse) {
    double matrix[9] = {4, 2, 0, 2, 5, 1, 0, 1, 3}, right[3] = {8, 13, 8};
    const double original[9] = {4, 2, 0, 2, 5, 1, 0, 1, 3};
    ASSERT_TRUE(solve_normal_equations(3, matrix, right));
    for (int i = 0; i < 3; ++i) {
        double row = 0;
        for (int j = 0; j < 3; ++j) {
            double product = 0;
            for (int k = 0; k < 3; ++k) product += matrix[i * 3 + k] * original[k * 3 + j];
            EXPECT_NEAR(product, i == j, 1e-14);
            row += original[i * 3 + j] * right[j];
        }
        EXPECT_NEAR(row, (std::array<double, 3>{8, 13, 8})[i], 1e-13);
    }
    double singular[4] = {1, 1, 1, 1}, none[2] = {1, 1};
    EXPECT_FALSE(solve_normal_equations(2, singular, none));
}

TEST(WavelengthBins, ALineIsReadAtTheCentreAndAMeanWhereItCannotBe) {
    const std::vector<double> nm = {498, 499.4, 500.2, 501, 502.4, 503};
    const auto value = [&](const BinShares& shares) {
        double sum = 0, one = 0;
        for (size_t i = 0; i < shares.pixel.size(); ++i) {
            sum += shares.share[i] * (7 + 3 * nm[shares.pixel[i]]);
            one += shares.share[i];
        }
        EXPECT_NEAR(one, 1, 1e-14);
        return sum;
    };
    const BinShares all = bin_shares(nm, {1, 4, 2, 1, 3, 1}, 500, 5);
    EXPECT_EQ(all.pixel.size(), 5u);  // 503 is beyond
    EXPECT_NEAR(value(all), 7 + 3 * 500, 1e-10);
    // On one side only: the mean of what is there.
    EXPECT_NEAR(value(bin_shares(nm, {0, 0, 0, 1, 1, 1}, 500, 5)), 7 + 3 * 501.7, 1e-10);
    EXPECT_TRUE(bin_shares(nm, {1, 1, 1, 1, 1, 1}, 600, 5).pixel.empty());
    EXPECT_TRUE(bin_shares(nm, {0, 0, 0, 0, 0, 0}, 500, 5).pixel.empty());
}

}  // namespace
}  // namespace drude
