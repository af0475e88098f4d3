// The equal-area square of directions (Clarberg 2008, JGT 13(1)), in which pbrt-v4 keeps square
// environments and takes pictures all around: the upper hemisphere (z >= 0) is the diamond in the
// middle, the lower one is folded out over its edges.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "materials/scalar.h"

namespace drude {

// The unit direction at p in [0, 1]^2; the middle is +z, the right edge's middle +x, the edge of
// y = 1 has +y in its middle.
template <class T>
glm::vec<3, T> equal_area_direction(const glm::vec<2, T>& p) {
    const T u = 2 * p.x - 1, v = 2 * p.y - 1;
    const T au = std::abs(u), av = std::abs(v);
    const T signed_distance = 1 - (au + av);
    const T r = 1 - std::abs(signed_distance);
    const T phi = (r == 0 ? 1 : (av - au) / r + 1) * static_cast<T>(pi) / 4;
    const T z = std::copysign(1 - r * r, signed_distance);
    const T side = r * std::sqrt(std::max(T(0), 2 - r * r));
    return {std::copysign(std::cos(phi), u) * side, std::copysign(std::sin(phi), v) * side, z};
}

// Where a unit direction lies in the square.
template <class T>
glm::vec<2, T> equal_area_square(const glm::vec<3, T>& d) {
    const T x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    // sqrt(1 - z) without the cancellation at the poles.
    const T r = std::sqrt((x * x + y * y) / (1 + z));
    const T large = std::max(x, y), small = std::min(x, y);
    T phi = large == 0 ? 0 : std::atan(small / large) * 2 / static_cast<T>(pi);
    if (x < y) phi = 1 - phi;
    T v = phi * r, u = r - v;
    if (d.z < 0) {
        std::swap(u, v);
        u = 1 - u;
        v = 1 - v;
    }
    return {(std::copysign(u, d.x) + 1) / 2, (std::copysign(v, d.y) + 1) / 2};
}

// The point of the square that continues it at p outside: across an edge the square meets itself,
// turned by half a turn about the edge's middle. Where p is more than a square away, the nearest.
template <class T>
glm::vec<2, T> wrapped_equal_area(glm::vec<2, T> p) {
    for (int axis = 0; axis < 2; ++axis) {
        if (p[axis] >= 0 && p[axis] <= 1) continue;
        p[axis] = p[axis] < 0 ? -p[axis] : 2 - p[axis];
        p[1 - axis] = 1 - p[1 - axis];
    }
    return {std::clamp(p.x, T(0), T(1)), std::clamp(p.y, T(0), T(1))};
}

}  // namespace drude
