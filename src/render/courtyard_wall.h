// What the courtyard's upper walls and its arcade share.
#pragma once

#include "render/courtyard_stone.h"

namespace drude::courtyard {

inline constexpr double storey = 6.2;  // top of the ground floor
inline constexpr double second_floor = 12.9;

// The share of sky over a wall point at height z: what stands above the wall across.
inline double sky_share(double z, double opposite) {
    const double rise = std::max(eaves_height - z, 0.0);
    return 0.5 * (1 - rise / std::hypot(rise, opposite));
}

// The shadow that a course throws on the wall beneath it.
inline double cornice_shadow(double z) {
    double shade = 1;
    for (const double bottom : {storey - 0.35, second_floor - 0.3, 7.45, 18.7}) {
        if (z < bottom) shade *= 1 - 0.35 * std::exp(-(bottom - z) / 0.3);
    }
    return shade;
}

// Coursed stone or plaster, with its stains.
inline glm::dvec3 stained(const glm::dvec3& albedo, double u, double z, uint64_t salt) {
    const double stain = cloud_noise(0.35 * u, 0.35 * z, salt);
    const double streak = cloud_noise(2.2 * u, 0.15 * z, salt + 31);
    return albedo * (0.80 + 0.28 * stain + 0.16 * streak);
}

// The ground floor of a façade: arches on columns, a vaulted gallery behind them. `hit` is where
// the ray meets the wall's face, `footprint` the width there of what the ray stands for, in metres.
Radiance arcade(const WallRay& ray, const glm::dvec3& hit, double footprint);

}  // namespace drude::courtyard
