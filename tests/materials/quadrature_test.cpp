#include "materials/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>

namespace drude {
namespace {

TEST(Quadrature, GaussLegendreIsExactForPolynomials) {
    for (const int count : {1, 2, 3, 5, 16, 64}) {
        const QuadratureRule rule = gauss_legendre(count);
        ASSERT_EQ(rule.x.size(), static_cast<size_t>(count));
        for (int power = 0; power < 2 * count; ++power) {
            double sum = 0;
            for (size_t i = 0; i < rule.x.size(); ++i) {
                sum += rule.weight[i] * std::pow(rule.x[i], power);
            }
            EXPECT_NEAR(sum, power % 2 ? 0 : 2.0 / (power + 1), 1e-13) << count << " " << power;
        }
        // The first power that is not: off by 2^(2n+1) (n!)^4 / ((2n+1) ((2n)!)^2) (A & S 25.4.29).
        if (count > 5) continue;
        double sum = 0;
        for (size_t i = 0; i < rule.x.size(); ++i) {
            sum += rule.weight[i] * std::pow(rule.x[i], 2 * count);
        }
        const double n = count;
        const double off = std::exp((2 * n + 1) * std::log(2.0) + 4 * std::lgamma(n + 1) -
                                    std::log(2 * n + 1) - 2 * std::lgamma(2 * n + 1));
        EXPECT_NEAR(2 / (2 * n + 1) - sum, off, 1e-13);
    }
    EXPECT_TRUE(gauss_legendre(0).x.empty());
}

}  // namespace
}  // namespace drude
