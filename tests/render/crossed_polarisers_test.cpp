// scenes/crossed-polarisers.pbrt against what its six windows let through on paper.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <utility>

#include "render/camera_ray.h"
#include "render/render.h"

namespace drude {
namespace {

class CrossedPolarisers : public testing::Test {
  protected:
    static constexpr int width = 96, height = 72;
    Scene scene_ = read_scene(DRUDE_SOURCE_DIR "/scenes/crossed-polarisers.pbrt");

    CrossedPolarisers() {
        scene_.film.width = width;
        scene_.film.height = height;
    }

    // The pixel whose ray runs nearest to a point of the world.
    std::pair<int, int> pixel_of(const glm::vec3& p) const {
        const CameraRays camera(scene_.camera, width, height);
        std::pair<int, int> best;
        float largest = -1;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const CameraRay ray = camera(x + 0.5, y + 0.5);
                const float cosine = glm::dot(ray.d, glm::normalize(p - ray.o));
                if (cosine > largest) {
                    largest = cosine;
                    best = {x, y};
                }
            }
        }
        return best;
    }

    float green(const Image& image, const glm::vec3& p) const {
        const auto [x, y] = pixel_of(p);
        return image.at("G", "picture").data[static_cast<size_t>(y) * width + x];
    }
};

TEST_F(CrossedPolarisers, LetThroughWhatMalusSays) {
    RenderOptions options;
    options.samples_per_pixel = 16;
    options.wavelengths = 40;
    options.quiet = true;
    const RenderResult result = render(scene_, options);
    EXPECT_EQ(result.transport, Transport::intensity) << result.transport_reason;
    const Image& image = result.image;
    // Beside the windows the panel itself: radiance 1.
    EXPECT_NEAR(green(image, {2.2f, 0.6f, 1.5f}), 1, 2e-3);
    EXPECT_NEAR(green(image, {1, 0.1f, 1.55f}), 0.5, 2e-3);
    EXPECT_NEAR(green(image, {0, 0.1f, 1.55f}), 0.25, 5e-3);  // the axes turn with the ray
    EXPECT_NEAR(green(image, {-1, 0.1f, 1.55f}), 0, 5e-3);
    EXPECT_NEAR(green(image, {1, 0.1f, 0.6f}), 0.25, 5e-3);
    EXPECT_NEAR(green(image, {0, 0.1f, 0.6f}), 0.5, 2e-3);
    EXPECT_NEAR(green(image, {-1, 0.1f, 0.6f}), 0, 2e-3);
}

TEST_F(CrossedPolarisers, AreAllAlikeToScalarTransport) {
    RenderOptions options;
    options.samples_per_pixel = 16;
    options.wavelengths = 40;
    options.quiet = true;
    options.transport = Transport::scalar;
    const Image image = render(scene_, options).image;
    for (const float x : {-1.0f, 0.0f, 1.0f}) {
        for (const float z : {0.6f, 1.55f}) {
            EXPECT_NEAR(green(image, {x, 0.1f, z}), 0.25, 2e-3) << x << " " << z;
        }
    }
}

}  // namespace
}  // namespace drude
