// The environment's sampling: its density is one, is where its samples fall, and is theirs.
#include "render/environment.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <random>

#include "chi_square.h"
#include "materials/scalar.h"

namespace drude {
namespace {

Image sky(int width, int height) {
    Image image;
    image.width = width;
    image.height = height;
    std::mt19937 random(5);
    for (const char* name : {"R", "G", "B"}) {
        Channel& channel = image.add(name);
        for (float& value : channel.data) value = static_cast<float>(random() % 1000) * 1e-3f;
        channel.data[static_cast<size_t>(height / 3) * width + width / 2] = 20;
    }
    return image;
}

glm::vec3 direction(double z, double phi) {
    const double r = std::sqrt(std::max(0.0, 1 - z * z));
    return {r * std::cos(phi), r * std::sin(phi), z};
}

class EnvironmentSampling : public testing::TestWithParam<std::pair<bool, bool>> {
  protected:
    EnvironmentSampling() {
        const auto [square, sheared] = GetParam();
        // A rotation, or a matrix that is none: pbrt-v4 looks such a light up all the same.
        const glm::dmat4 matrix =
            sheared ? glm::dmat4({2, 0.3, 0, 0}, {0, -1, 0.4, 0}, {0, 0, 0.7, 0}, {0, 0, 0, 1})
                    : glm::dmat4({0.6, 0.8, 0, 0}, {0, 0, -1, 0}, {0.8, -0.6, 0, 0}, {0, 0, 0, 1});
        environment_ = std::make_unique<Environment>(square ? sky(16, 16) : sky(24, 12), 2.0,
                                                     matrix, "made here");
    }
    std::unique_ptr<Environment> environment_;
};

TEST_P(EnvironmentSampling, DensityIsOneAndIsWhereSamplesFall) {
    constexpr int nz = 16, nphi = 24, fine = 64, samples = 400000;
    std::vector<double> expected(nz * nphi, 0), observed(nz * nphi, 0);
    double total = 0;
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> inside(0, 1);
    for (int a = 0; a < nz * fine; ++a) {
        for (int b = 0; b < nphi * fine; ++b) {
            // A point anywhere in its cell, because the borders of texels are steps.
            const double z = 2 * (a + inside(random)) / (nz * fine) - 1,
                         phi = 2 * pi * (b + inside(random)) / (nphi * fine);
            const double share = static_cast<double>(environment_->pdf(direction(z, phi))) * 4 *
                                 pi / (nz * fine * nphi * fine);
            total += share;
            expected[static_cast<size_t>(a / fine * nphi + b / fine)] += samples * share;
        }
    }
    EXPECT_NEAR(total, 1, 3e-3);
    std::uniform_real_distribution<float> uniform(0, 0x1.fffffep-1f);
    int same = 0;
    for (int i = 0; i < samples; ++i) {
        const auto s = environment_->sample({uniform(random), uniform(random)});
        ASSERT_NEAR(glm::length(s.d), 1, 1e-5);
        ASSERT_GT(s.pdf, 0);
        // Rounding may carry a sample on the border of a texel over to the next.
        same += std::abs(environment_->pdf(s.d) / s.pdf - 1) < 1e-3f &&
                glm::length(environment_->radiance(s.d) - s.radiance) < 1e-5f;
        double phi = std::atan2(s.d.y, s.d.x);
        if (phi < 0) phi += 2 * pi;
        const int a = std::clamp(static_cast<int>((s.d.z + 1) / 2 * nz), 0, nz - 1);
        const int b = std::clamp(static_cast<int>(phi / (2 * pi) * nphi), 0, nphi - 1);
        observed[static_cast<size_t>(a * nphi + b)] += 1;
    }
    EXPECT_GT(same, samples * 0.9995);
    EXPECT_LT(chi_square_deviate(observed, expected), 4.5);
}

INSTANTIATE_TEST_SUITE_P(Layouts, EnvironmentSampling,
                         testing::Values(std::pair{false, false}, std::pair{false, true},
                                         std::pair{true, false}, std::pair{true, true}));

// One bright texel at a known place of the picture.
TEST(Environment, LooksWhereItsLayoutSays) {
    Image image;
    image.width = 16;
    image.height = 8;
    image.add("Y").data[2 * 16 + 5] = 1;
    const Environment lat_long(image, 3, glm::dmat4(1), "made here");
    const double t = pi * 2.5 / 8, p = 2 * pi * 5.5 / 16;
    EXPECT_EQ(lat_long.radiance(direction(std::cos(t), p)), glm::vec3(3));
    EXPECT_EQ(lat_long.radiance(direction(std::cos(t), -p)), glm::vec3(0));
    // Equal-area: the middle of the square is +z, its corners are -z, its right edge's middle +x,
    // its lower edge's middle +y.
    for (const auto& [x, y, d] : {std::tuple{4, 4, glm::vec3(0.05f, 0.05f, 1)},
                                  std::tuple{0, 0, glm::vec3(-0.05f, -0.05f, -1)},
                                  std::tuple{7, 4, glm::vec3(1, 0.05f, 0.02f)},
                                  std::tuple{4, 7, glm::vec3(0.05f, 1, 0.02f)}}) {
        Image square;
        square.width = square.height = 8;
        square.add("Y").data[static_cast<size_t>(y) * 8 + x] = 1;
        const Environment equal_area(square, 1, glm::dmat4(1), "made here");
        EXPECT_EQ(equal_area.radiance(glm::normalize(d)), glm::vec3(1)) << x << " " << y;
    }
}

}  // namespace
}  // namespace drude
