#include "render/reference_light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include "materials/scalar.h"

namespace drude {

double spectrum_at(const DenseSpectrum& spectrum, double nm) {
    const double x = nm - spectrum_first_nm;
    const int i = std::min(spectrum_size - 2, static_cast<int>(x));
    return spectrum[i] + (x - i) * (spectrum[i + 1] - spectrum[i]);
}

namespace {

// Where a unit vector falls in the equal-area square (Clarberg 2008): on the upper hemisphere the
// vector of length sqrt(1 - z) in the disk, its azimuth laid along squares around the middle; the
// lower hemisphere is the same seen from below, folded outwards over the edges of the diamond.
glm::dvec2 equal_area(const glm::dvec3& d) {
    const double r = std::sqrt(std::max(0.0, 1 - std::abs(d.z)));
    const double quarter = std::atan2(std::abs(d.y), std::abs(d.x)) * 2 / pi;
    double u = r * (1 - quarter), v = r * quarter;
    if (d.z < 0) {
        const double w = u;
        u = 1 - v;
        v = 1 - w;
    }
    return {(1 + (d.x < 0 ? -u : u)) / 2, (1 + (d.y < 0 ? -v : v)) / 2};
}

}  // namespace

// Angles are measured in the frame's own plane, from x towards y = h cross(k, x), which the
// conventions make counter-clockwise for who looks towards the source.
Stokes<double> emitted_stokes(const LightPolarisation& light, const glm::dvec3& zero,
                              const glm::dvec3& k, const glm::dvec3& frame, double handedness) {
    const glm::dvec3 y = handedness * glm::cross(k, frame);
    const double angle =
        std::atan2(glm::dot(zero, y), glm::dot(zero, frame)) + light.aolp_deg * degree;
    return {{1, light.dop * std::cos(2 * angle), light.dop * std::sin(2 * angle), 0}};
}

double intensity_towards(const PointLight& light, const glm::dvec3& at, double nm) {
    const double cosine = glm::dot(light.axis, glm::normalize(at - light.position));
    double share = 1;
    if (light.cos_start > -1) {
        // From 0 at the end of the cone to 1 at the start of the falloff.
        const double width = light.cos_start - light.cos_end;
        const double t = width > 0 ? std::clamp((cosine - light.cos_end) / width, 0.0, 1.0)
                                   : (cosine > light.cos_end ? 1.0 : 0.0);
        share = 3 * t * t - 2 * t * t * t;
    }
    return share * spectrum_at(light.intensity, nm);
}

Stokes<double> ReferenceSky::stokes(const glm::dvec3& d, const glm::dvec3& frame,
                                    double handedness) const {
    if (!light_.rayleigh) {
        const glm::dvec3 z(light_.world_from_light[2]);
        return emitted_stokes(light_.polarisation, glm::cross(d, z), -d, frame, handedness);
    }
    // Waves swing across the plane of the ray and the sun: a turn of 90 degrees from the sun's own
    // direction in the picture plane.
    const glm::dvec3 sun =
        glm::normalize(glm::dmat3(light_.world_from_light) * light_.rayleigh->sun);
    const double c = glm::dot(d, sun);
    const double dop = light_.rayleigh->maximum * (1 - c * c) / (1 + c * c);
    return emitted_stokes({dop, 90}, sun, -d, frame, handedness);
}

ReferenceSky::ReferenceSky(const InfiniteLight& light)
    : light_(light), light_from_world_(glm::inverse(glm::dmat3(light.world_from_light))) {
    if (!light.image.empty()) image_ = light.picture ? *light.picture : read_image(light.image);
    for (int c = 0; c < 3; ++c) {
        RGB primary{0, 0, 0};
        primary[c] = 1;
        basis_[c] = rgb_illuminant(primary);
    }
}

double ReferenceSky::radiance(const glm::dvec3& d, double nm) const {
    if (light_.image.empty()) return spectrum_at(light_.radiance, nm);
    const glm::dvec3 l = glm::normalize(light_from_world_ * d);
    glm::dvec2 uv;
    if (image_.width == 2 * image_.height) {
        const double phi = std::atan2(l.y, l.x);
        uv = {(phi < 0 ? phi + 2 * pi : phi) / (2 * pi),
              std::acos(std::clamp(l.z, -1.0, 1.0)) / pi};
    } else {
        uv = equal_area(l);
    }
    const int x = std::min(image_.width - 1, static_cast<int>(uv.x * image_.width));
    const int y = std::min(image_.height - 1, static_cast<int>(uv.y * image_.height));
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
        const Channel* channel = image_.find(std::string(1, "RGB"[c]));
        if (!channel) channel = &image_.at("Y", light_.image);
        const auto value =
            static_cast<double>(channel->data[static_cast<size_t>(y) * image_.width + x]);
        if (value > 0 && std::isfinite(value)) sum += value * spectrum_at(basis_[c], nm);
    }
    return light_.scale * sum;
}

}  // namespace drude
