#include "device/signal/small_least_squares.h"

#include <gtest/gtest.h>

#include <algorithm>
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

// What shares make of 7 + 3 x + bend x^2, x from 500 nm.
double value_at_500(const BinShares& shares, const std::vector<double>& nm, double bend) {
    double sum = 0, one = 0;
    for (size_t i = 0; i < shares.pixel.size(); ++i) {
        const double x = nm[shares.pixel[i]] - 500;
        sum += shares.share[i] * (7 + 3 * x + bend * x * x);
        one += shares.share[i];
    }
    EXPECT_NEAR(one, 1, 1e-13);
    return sum;
}

TEST(WavelengthBins, AParabolaIsReadAtTheCentreOrNothing) {
    const std::vector<double> nm = {497.6, 498.3, 499.4, 500.2, 501, 501.8, 502.4, 503};
    const BinShares all = bin_shares(nm, {1, 2, 3, 2, 1, 2, 2, 1}, 500, 5);
    EXPECT_EQ(all.pixel.size(), 7u);  // 503 is beyond
    EXPECT_NEAR(value_at_500(all, nm, 0.5), 7, 1e-11);
    // Four in the middle are enough; so are three on either side of it.
    for (const std::vector<double>& weights :
         {std::vector<double>{0, 1, 1, 1, 1, 0, 0, 1}, {0, 0, 1, 1, 1, 0, 0, 0}}) {
        const BinShares some = bin_shares(nm, weights, 500, 5);
        EXPECT_FALSE(some.pixel.empty());
        EXPECT_NEAR(value_at_500(some, nm, 0.5), 7, 1e-11);
    }
    // On one side only, two alone, at the ends alone: nothing is made up.
    for (const std::vector<double>& weights : {std::vector<double>{0, 0, 0, 0, 1, 1, 1, 1},
                                               {1, 1, 1, 0, 0, 0, 0, 1},
                                               {0, 0, 1, 1, 0, 0, 0, 0},
                                               {1, 1, 0, 0, 0, 1, 1, 0},
                                               {0, 0, 0, 0, 0, 0, 0, 0}}) {
        EXPECT_TRUE(bin_shares(nm, weights, 500, 5).pixel.empty());
    }
    EXPECT_TRUE(bin_shares(nm, {1, 1, 1, 1, 1, 1, 1, 1}, 600, 5).pixel.empty());
    // The end of the spectrometer's range.
    EXPECT_TRUE(bin_shares(nm, {1, 1, 1, 1, 1, 1, 1, 1}, 497, 5).pixel.empty());
    // Steep weights (the foot of a filter) do not make it one-sided.
    const BinShares steep = bin_shares(nm, {1, 1, 1, 1, 1, 1e4, 1e8, 1}, 500, 5);
    EXPECT_NEAR(value_at_500(steep, nm, 0.5), 7, 1e-8);
}

TEST(WavelengthBins, FewPixelsAreReadByALineAndOneAtTheCentreIsTheValue) {
    const std::vector<double> three = {498.2, 500.1, 502};
    EXPECT_NEAR(value_at_500(bin_shares(three, {1, 1, 1}, 500, 5), three, 0), 7, 1e-12);
    EXPECT_NEAR(value_at_500(bin_shares(three, {1, 0, 1}, 500, 5), three, 0), 7, 1e-12);
    EXPECT_TRUE(bin_shares(three, {0, 1, 1}, 500, 5).pixel.empty());
    // The bin holds its lower end, so one of two neighbours.
    const std::vector<double> centred = {497.5, 500, 502.5};
    const BinShares shares = bin_shares(centred, {1, 1, 1}, 500, 5);
    EXPECT_NEAR(value_at_500(shares, centred, 0.5), 7, 1e-12);
    const std::vector<double> one = {500.001};
    EXPECT_NEAR(value_at_500(bin_shares(one, {1}, 500, 5), one, 0), 7.003, 1e-12);
    EXPECT_TRUE(bin_shares({500.01}, {1}, 500, 5).pixel.empty());
}

// What a parabola leaves out is odd about the centre first: it must not tell where pixels were
// lost. The spectrum is a step of the width of copper's.
TEST(WavelengthBins, PixelsThatAreLostOnOneSideShiftNothing) {
    std::vector<double> nm;
    for (int j = 0; j < 149; ++j) nm.push_back(490 + 0.1354 * j);
    const auto read = [&](const BinShares& shares) {
        double sum = 0;
        for (size_t i = 0; i < shares.pixel.size(); ++i) {
            sum += shares.share[i] * std::tanh((nm[shares.pixel[i]] - 500) / 15);
        }
        return sum;
    };
    int left_out = 0;
    for (size_t lost = 0; lost < nm.size(); ++lost) {
        std::vector<double> weights(nm.size(), 1);
        std::fill_n(weights.begin(), lost, 0);
        const BinShares shares = bin_shares(nm, weights, 500, 20);
        left_out += shares.pixel.empty() ? 1 : 0;
        if (!shares.pixel.empty()) {
            EXPECT_NEAR(read(shares), 0, 1e-3) << lost;
        }
    }
    EXPECT_GE(left_out, 74);  // all of those whose centre is lost
    EXPECT_LE(left_out, 76);
}

}  // namespace
}  // namespace drude
