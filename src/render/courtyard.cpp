#include "render/courtyard.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "base/error.h"
#include "base/executor.h"
#include "render/courtyard_scene.h"

namespace drude {

namespace {

constexpr int grid = 4;  // grid * grid fixed samples a texel
const glm::dvec3 luminance_weights(0.2126, 0.7152, 0.0722);

// The mean of a texel's samples.
courtyard::Radiance texel(int x, int y, int height) {
    const double step = std::numbers::pi / height;  // radians a texel, in theta and in phi
    courtyard::Radiance sum;
    for (int j = 0; j < grid; ++j) {
        const double theta = step * (y + (j + 0.5) / grid);
        for (int i = 0; i < grid; ++i) {
            const double phi = step * (x + (i + 0.5) / grid);
            const glm::dvec3 direction(std::sin(theta) * std::cos(phi),
                                       std::sin(theta) * std::sin(phi), std::cos(theta));
            const courtyard::Radiance seen =
                courtyard::trace({{0, 0, courtyard::eye_height}, direction, step / grid, 0});
            sum.base += seen.base;
            sum.veil += seen.veil;
        }
    }
    constexpr double share = 1.0 / (grid * grid);
    return {sum.base * share, sum.veil * share};
}

}  // namespace

Image make_courtyard(int height, int threads) {
    if (height < 16 || height > 8192)
        user_error("a courtyard {} texels high: expected 16 to 8192", height);
    const int width = 2 * height;
    const size_t row_size = static_cast<size_t>(width);
    std::vector<courtyard::Radiance> texels(row_size * static_cast<size_t>(height));
    parallel_for(static_cast<size_t>(height), threads, [&](size_t y) {
        for (size_t x = 0; x < row_size; ++x)
            texels[y * row_size + x] = texel(static_cast<int>(x), static_cast<int>(y), height);
    });

    // Solid-angle means, summed in one fixed order.
    double mean_base = 0, mean_veil = 0, weights = 0;
    for (size_t y = 0; y < static_cast<size_t>(height); ++y) {
        const double weight = std::sin(std::numbers::pi * (static_cast<double>(y) + 0.5) / height);
        for (size_t x = 0; x < row_size; ++x) {
            const courtyard::Radiance& r = texels[y * row_size + x];
            mean_base += weight * glm::dot(r.base, luminance_weights);
            mean_veil += weight * r.veil;
        }
        weights += weight * width;
    }
    mean_base /= weights;
    mean_veil /= weights;

    // The strength s of the sun behind the clouds: every texel has b + s v, the mean is B + s V,
    // and the first texel to reach `ratio` times the mean as s grows sets it.
    constexpr double ratio = courtyard_max_over_mean;
    double strength = std::numeric_limits<double>::infinity();
    for (const courtyard::Radiance& r : texels) {
        const double gain = r.veil - ratio * mean_veil;
        if (gain <= 0) continue;
        const double gap = ratio * mean_base - glm::dot(r.base, luminance_weights);
        strength = std::min(strength, gap / gain);
    }
    const double scale = courtyard_mean_luminance / (mean_base + strength * mean_veil);

    Image image;
    image.width = width;
    image.height = height;
    for (const char* name : {"R", "G", "B"})
        image.channels.push_back({name, std::vector<float>(texels.size())});
    const glm::dvec3 veil = strength * courtyard::veil_colour();
    for (size_t i = 0; i < texels.size(); ++i) {
        const glm::dvec3 colour = scale * (texels[i].base + texels[i].veil * veil);
        for (int c = 0; c < 3; ++c) image.channels[c].data[i] = static_cast<float>(colour[c]);
    }
    return image;
}

}  // namespace drude
