// The sample points: nets within a batch, uniform and independent over batches.
#include "render/sampler.h"

#include <gtest/gtest.h>

#include <vector>

#include "chi_square.h"

namespace drude {
namespace {

TEST(Sampler, EveryPairOfDimensionsOfABatchIsANet) {
    for (const uint32_t size : {1u, 2u, 16u, 64u, 256u}) {
        for (uint32_t batch = 0; batch < 20; ++batch) {
            constexpr int dimensions = 6;
            std::vector<glm::vec2> points(size * dimensions);
            std::vector<float> line(size);
            for (uint32_t i = 0; i < size; ++i) {
                Sampler sampler(3, 17, 5, batch, i, size);
                line[i] = sampler.next_1d();
                for (int d = 0; d < dimensions; ++d) points[d * size + i] = sampler.next_2d();
            }
            const auto cell = [](float u, uint32_t cells) {
                return static_cast<uint32_t>(u * static_cast<float>(cells));
            };
            std::vector<int> hit(size, 0);
            for (const float u : line) {
                ASSERT_TRUE(u >= 0 && u < 1);
                ++hit[cell(u, size)];
            }
            for (const int h : hit) ASSERT_EQ(h, 1);
            // Every elementary interval of area 1/size holds one point.
            for (int d = 0; d < dimensions; ++d) {
                for (uint32_t wide = 1; wide <= size; wide *= 2) {
                    std::vector<int> boxes(size, 0);
                    for (uint32_t i = 0; i < size; ++i) {
                        const glm::vec2 p = points[d * size + i];
                        ++boxes[cell(p.x, wide) * (size / wide) + cell(p.y, size / wide)];
                    }
                    for (const int b : boxes) ASSERT_EQ(b, 1) << size << " " << d << " " << wide;
                }
            }
        }
    }
}

// One sample a batch, so that the batches alone make the distribution: of a point, of the pairs of
// different dimensions, of neighbouring pixels and of successive batches.
TEST(Sampler, IsUniformAndIndependentOverBatches) {
    constexpr uint32_t batches = 65536;
    constexpr size_t cells = 16;
    std::vector<std::vector<double>> observed(6, std::vector<double>(cells * cells, 0));
    const std::vector<double> expected(cells * cells, batches / double(cells * cells));
    float previous = 0.5f;
    for (uint32_t batch = 0; batch < batches; ++batch) {
        Sampler here(1, 8, 9, batch, 5, 16), beside(1, 9, 9, batch, 5, 16),
            other(1, 8, 9, batch, 6, 1);
        Sampler seed(2, 8, 9, batch, 5, 16);
        const float a = here.next_1d();
        const glm::vec2 b = here.next_2d();
        const auto add = [&](size_t which, float x, float y) {
            observed[which]
                    [static_cast<size_t>(x * cells) * cells + static_cast<size_t>(y * cells)] += 1;
        };
        add(0, b.x, b.y);
        add(1, a, b.x);
        add(2, a, here.next_1d());
        add(3, a, beside.next_1d());
        add(4, a, batch % 2 == 0 ? other.next_2d().y : previous);
        add(5, a, seed.next_1d());
        previous = a;
    }
    for (size_t which = 0; which < observed.size(); ++which) {
        EXPECT_LT(std::abs(chi_square_deviate(observed[which], expected)), 4) << which;
    }
}

}  // namespace
}  // namespace drude
