#include "render/light_polarisation.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "materials/frame.h"

namespace drude {

bool has_polarised_lights(const Scene& scene) {
    const auto polarised = [](const auto& light) { return !light.polarisation.none(); };
    const auto polarised_sky = [&](const InfiniteLight& light) {
        return light.rayleigh ? light.rayleigh->maximum > 0 : polarised(light);
    };
    const auto any = [](const auto& lights, const auto& is) {
        return std::any_of(lights.begin(), lights.end(), is);
    };
    return any(scene.infinite_lights, polarised_sky) || any(scene.distant_lights, polarised) ||
           any(scene.point_lights, polarised) || any(scene.area_lights, polarised);
}

namespace {

// Below this sine of the angle between them a direction and a ray are taken for parallel.
constexpr float parallel = 1e-4f;

}  // namespace

// Light travels along k = -d. In the frame of x axis x and y = h cross(k, x), turning from x to y
// is counter-clockwise for who looks towards the source, so the axis at the angle a from x is
//   cos a x + sin a h cross(k, x) = cos a x - h sin a cross(d, x).
UniformPolarisation::UniformPolarisation(const LightPolarisation& polarisation, double handedness)
    : dop_(static_cast<float>(polarisation.dop)),
      cosine_(static_cast<float>(std::cos(polarisation.aolp_deg * degree))),
      sine_(static_cast<float>(-handedness * std::sin(polarisation.aolp_deg * degree))) {}

ArrivingPolarisation UniformPolarisation::arriving(const glm::vec3& d,
                                                   const glm::vec3& zero) const {
    glm::vec3 x = zero - glm::dot(zero, d) * d;
    const float size2 = glm::dot(x, x);
    x = size2 > parallel * parallel * glm::dot(zero, zero) ? x / std::sqrt(size2)
                                                           : any_perpendicular(d);
    return {dop_, cosine_ * x + sine_ * glm::cross(d, x)};
}

SkyPolarisation::SkyPolarisation(const InfiniteLight& light, double handedness)
    : uniform_(light.rayleigh ? LightPolarisation{} : light.polarisation, handedness),
      x_(glm::normalize(glm::dvec3(light.world_from_light[0]))),
      z_(glm::normalize(glm::dvec3(light.world_from_light[2]))) {
    if (!light.rayleigh) return;
    maximum_ = static_cast<float>(light.rayleigh->maximum);
    sun_ = glm::vec3(glm::normalize(glm::dmat3(light.world_from_light) * light.rayleigh->sun));
}

ArrivingPolarisation SkyPolarisation::arriving(const glm::vec3& d) const {
    const glm::vec3 across = glm::cross(d, maximum_ > 0 ? sun_ : z_);
    const float sine2 = std::min(1.0f, glm::dot(across, across));
    if (!(maximum_ > 0)) {
        return uniform_.arriving(d, sine2 > parallel * parallel ? across : x_);
    }
    const glm::vec3 axis =
        sine2 > parallel * parallel ? across / std::sqrt(sine2) : any_perpendicular(d);
    // 1 + cos^2 = 2 - sin^2, without the cancellation of 1 - cos^2 near the sun.
    return {maximum_ * sine2 / (2 - sine2), axis};
}

}  // namespace drude
