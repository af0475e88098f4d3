// Small procedural means of the courtyard: repeatable noise, soft edges, diffuse light on stone.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>

#include "render/courtyard_scene.h"

namespace drude::courtyard {

// Linear albedos.
inline const glm::dvec3 plaster{0.60, 0.49, 0.34};
inline const glm::dvec3 limestone{0.50, 0.46, 0.39};
inline const glm::dvec3 grey_stone{0.27, 0.265, 0.26};
inline const glm::dvec3 paving_stone{0.34, 0.315, 0.28};
inline const glm::dvec3 oak{0.13, 0.085, 0.05};

// What arrives from the average piece of sky and, once reflected, from the average wall.
inline const glm::dvec3 sky_light{4.25, 4.75, 5.75};
inline const glm::dvec3 wall_light{0.62, 0.53, 0.42};

// A number in [0, 1) from a cell of an integer grid.
inline double cell_noise(int64_t i, int64_t j, uint64_t salt) {
    uint64_t h = static_cast<uint64_t>(i) * 0x9e3779b97f4a7c15u;
    h ^= static_cast<uint64_t>(j) * 0xc2b2ae3d27d4eb4fu + salt * 0x165667b19e3779f9u;
    h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 32)) * 0x94d049bb133111ebu;
    return static_cast<double>((h ^ (h >> 31)) >> 11) * 0x1p-53;
}

// Value noise in [0, 1], smooth, one octave a unit.
inline double smooth_noise(double x, double y, uint64_t salt) {
    const double fx = std::floor(x), fy = std::floor(y);
    const int64_t i = static_cast<int64_t>(fx), j = static_cast<int64_t>(fy);
    const double u = x - fx, v = y - fy;
    const double su = u * u * (3 - 2 * u), sv = v * v * (3 - 2 * v);
    const double low = std::lerp(cell_noise(i, j, salt), cell_noise(i + 1, j, salt), su);
    const double high = std::lerp(cell_noise(i, j + 1, salt), cell_noise(i + 1, j + 1, salt), su);
    return std::lerp(low, high, sv);
}

// Four octaves, mean 1/2.
inline double cloud_noise(double x, double y, uint64_t salt) {
    double sum = 0, weight = 0.5;
    for (uint64_t octave = 0; octave < 4; ++octave, weight *= 0.5) {
        sum += weight * smooth_noise(x, y, salt + octave);
        x = 2.03 * x + 17.3;
        y = 2.03 * y - 9.1;
    }
    return sum / 0.9375;
}

// 0 below `from`, 1 above `to`, smooth between.
inline double ramp(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

// How much of a footprint `width` wide, `distance` away from the middle of a line, the line covers.
inline double line_cover(double distance, double line_width, double width) {
    const double soft = std::max(width, 1e-6);
    const double overlap =
        std::clamp((0.5 * (line_width + soft) - std::abs(distance)) / soft, 0., 1.);
    return overlap * std::min(1.0, line_width / soft);
}

// The signed distance from x to the nearest multiple of `period`.
inline double to_nearest(double x, double period) {
    return x - period * std::round(x / period);
}

// Diffuse reflection under the share `sky` of the hemisphere that is sky, walls for the rest.
inline Radiance lit(const glm::dvec3& albedo, double sky, double openness) {
    return {albedo * openness * (sky * sky_light + (1 - sky) * wall_light), 0.0};
}

// Darkening `distance` away from an inner corner.
inline double corner_shade(double distance, double reach) {
    return 1 - 0.45 * std::exp(-std::max(distance, 0.0) / reach);
}

}  // namespace drude::courtyard
