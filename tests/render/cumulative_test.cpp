#include "render/cumulative.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace drude {
namespace {

// Against a plain binary search, over lengths around the powers of a node's size.
TEST(CumulativeRows, FindsWhatABinarySearchFinds) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (const size_t length : {1, 2, 15, 16, 17, 255, 256, 257, 272, 2048, 4096, 4100}) {
        constexpr size_t rows = 3;
        std::vector<float> sums;
        for (size_t row = 0; row < rows; ++row) {
            float sum = 0;
            for (size_t i = 0; i < length; ++i) {
                // Many of no weight, at both ends too; sums of small integers are exact.
                const bool some = random() % 3 == 0 || i == length / 2;
                sum += some ? static_cast<float>(1 + random() % 4) : 0.0f;
                sums.push_back(sum);
            }
        }
        const CumulativeRows table(sums, length);
        for (size_t row = 0; row < rows; ++row) {
            const float* first = &sums[row * length];
            const float total = first[length - 1];
            const auto check = [&](float u) {
                float inside = -1;
                const size_t found = table.find(row, u, &inside);
                ASSERT_LT(found, length);
                const float below = found > 0 ? first[found - 1] : 0;
                EXPECT_LT(below, first[found]) << "an entry of no weight";
                EXPECT_GE(inside, 0);
                EXPECT_LT(inside, 1);
                const float target = u * total;
                if (target < total) {
                    EXPECT_EQ(found, static_cast<size_t>(
                                         std::upper_bound(first, first + length, target) - first));
                    EXPECT_NEAR(below + inside * (first[found] - below), target, 1e-6f * total);
                } else {
                    EXPECT_EQ(first[found], total);
                }
            };
            for (int trial = 0; trial < 500; ++trial) check(uniform(random));
            for (size_t i = 0; i < length; i += 1 + length / 64) check(first[i] / total);
            check(0);
            check(0x1.fffffep-1f);
        }
    }
}

}  // namespace
}  // namespace drude
