#include "image/bilateral.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>

namespace drude {
namespace {

using Values = std::vector<float>;
constexpr int width = 96, height = 64;

Values picture(const std::function<double(int, int)>& value) {
    Values values;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) values.push_back(static_cast<float>(value(x, y)));
    }
    return values;
}

struct Case {
    const char* name;
    Values values;
};

std::vector<Case> synthetic_pictures() {
    std::mt19937 generator(7);
    std::normal_distribution<double> normal(0.0, 0.15);
    std::uniform_real_distribution<double> uniform(-3.0, 2.0);
    return {
        {"step", picture([](int x, int) { return x < 40 ? -2.0 : 1.3; })},
        {"small step", picture([](int x, int y) { return x + y < 80 ? 0.0 : 0.5; })},
        {"ramp", picture([](int x, int y) { return 0.04 * x - 0.02 * y; })},
        {"noisy step",
         picture([&](int x, int) { return (x < 50 ? -1.0 : 1.0) + normal(generator); })},
        {"white noise", picture([&](int, int) { return uniform(generator); })},
        {"spots", picture([](int x, int y) { return x % 16 == 3 && y % 16 == 5 ? 2.0 : -0.5; })},
        {"waves", picture([](int x, int y) { return std::sin(0.3 * x) + std::cos(0.21 * y); })},
    };
}

TEST(Bilateral, ExactFilterOfThreePixelsByHand) {
    const Values values = {0.0F, 1.0F, 3.0F};
    const BilateralWidths widths = {1.0, 2.0};
    const Values result = bilateral_exact(3, 1, values, widths, 1);
    const auto w = [](double pixels, double step) {
        return std::exp(-pixels * pixels / 2.0) * std::exp(-step * step / 8.0);
    };
    const double middle = (w(1, 1) * 0.0 + 1.0 + w(1, 2) * 3.0) / (w(1, 1) + 1.0 + w(1, 2));
    const double left = (0.0 + w(1, 1) * 1.0 + w(2, 3) * 3.0) / (1.0 + w(1, 1) + w(2, 3));
    EXPECT_NEAR(result[1], middle, 1e-6);
    EXPECT_NEAR(result[0], left, 1e-6);
}

TEST(Bilateral, ExactFilterOfWideRangeIsAGaussianBlur) {
    const Values spot = picture([](int x, int y) { return x == 48 && y == 32 ? 1.0 : 0.0; });
    const Values result = bilateral_exact(width, height, spot, {2.0, 1e6}, 2);
    const size_t centre = 32 * width + 48;
    EXPECT_NEAR(result[centre], 1.0 / (2.0 * 3.14159265 * 4.0), 1e-4);
    EXPECT_NEAR(result[centre + 2] / result[centre], std::exp(-0.5), 1e-5);
}

TEST(Bilateral, GridStaysWithinItsStatedErrorOfTheExactFilter) {
    for (const Case& test : synthetic_pictures()) {
        for (const double space : {4.0, 7.3}) {
            const BilateralWidths widths = {space, 0.4};
            const Values exact = bilateral_exact(width, height, test.values, widths, 0);
            const Values grid = bilateral_grid(width, height, test.values, widths, 0);
            double largest = 0.0, square = 0.0;
            for (size_t i = 0; i < exact.size(); ++i) {
                const double error = std::abs(static_cast<double>(exact[i] - grid[i]));
                largest = std::max(largest, error);
                square += error * error;
            }
            const double rms = std::sqrt(square / static_cast<double>(exact.size()));
            EXPECT_LE(largest, 0.04 * widths.range) << test.name << " space " << space;
            EXPECT_LE(rms, 0.01 * widths.range) << test.name << " space " << space;
        }
    }
}

TEST(Bilateral, BothKeepConstantsAndTheRangeOfTheirInput) {
    const Values flat(width * height, -3.7F);
    for (const float value : bilateral_exact(width, height, flat, {3.0, 0.4}, 0)) {
        EXPECT_NEAR(value, -3.7F, 1e-5);
    }
    for (const float value : bilateral_grid(width, height, flat, {3.0, 0.4}, 0)) {
        EXPECT_NEAR(value, -3.7F, 1e-5);
    }
    for (const Case& test : synthetic_pictures()) {
        const auto range = std::minmax_element(test.values.begin(), test.values.end());
        for (const float value : bilateral_grid(width, height, test.values, {5.0, 0.4}, 0)) {
            ASSERT_GE(value, *range.first - 1e-4F) << test.name;
            ASSERT_LE(value, *range.second + 1e-4F) << test.name;
        }
    }
}

TEST(Bilateral, SameBitsForAnyNumberOfThreads) {
    for (const Case& test : synthetic_pictures()) {
        const BilateralWidths widths = {4.0, 0.4};
        EXPECT_EQ(bilateral_grid(width, height, test.values, widths, 1),
                  bilateral_grid(width, height, test.values, widths, 3));
        EXPECT_EQ(bilateral_exact(width, height, test.values, widths, 1),
                  bilateral_exact(width, height, test.values, widths, 3));
    }
}

TEST(Bilateral, HugeSpansAndSinglePixelsDoNotExhaustMemory) {
    Values values(64, 0.0F);
    values[10] = 1e30F;
    const Values result = bilateral_grid(8, 8, values, {1.0, 1e-3}, 1);
    EXPECT_NEAR(result[10] / 1e30F, 1.0F, 1e-3F);
    EXPECT_EQ(bilateral_grid(1, 1, {2.5F}, {0.02, 0.4}, 1), Values{2.5F});
}

TEST(Bilateral, RefusesWhatIsNoPicture) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(bilateral_grid(2, 2, {1, 2, 3}, {1, 1}, 1), std::logic_error);
    EXPECT_THROW(bilateral_grid(1, 2, {1, nan}, {1, 1}, 1), std::logic_error);
    EXPECT_THROW(bilateral_exact(1, 1, {1}, {0, 1}, 1), std::logic_error);
}

}  // namespace
}  // namespace drude
