// Polarisers and retarders: what stands in front of a camera or in the scene, as Mueller matrices
// in the frames and with the signs of mueller.h (Hecht, Optics, section 8.13).
#pragma once

#include <cmath>

#include "materials/frame.h"
#include "materials/mueller.h"

namespace drude {

// An ideal linear polariser. `axis` is the rotation that turns the frame's x onto its transmission
// axis: rotation_from_dots(cos a, sin a) for an axis at the angle a from x towards y.
template <class T>
Mueller<T> linear_polariser(const Rotation<T>& axis) {
    const T zero(0), half(0.5), c = axis.cos2, s = axis.sin2;
    return {{{half, half * c, half * s, zero},
             {half * c, half * c * c, half * c * s, zero},
             {half * s, half * c * s, half * s * s, zero},
             {zero, zero, zero, zero}}};
}

// An ideal linear retarder: the component along the fast axis comes out ahead of the other by
// `retardance` radians, pi/2 for a quarter-wave plate. `fast_axis` as for linear_polariser. Where
// x is fast, light at +45 degrees gets S3 < 0; so horizontal light leaves a quarter-wave plate with
// its fast axis at +45 degrees with S3 > 0.
template <class T>
Mueller<T> linear_retarder(const Rotation<T>& fast_axis, const T& retardance) {
    using std::cos;
    using std::sin;
    const T zero(0), one(1), c = fast_axis.cos2, s = fast_axis.sin2;
    const T cosine = cos(retardance), sine = sin(retardance);
    return {{{one, zero, zero, zero},
             {zero, c * c + s * s * cosine, c * s * (one - cosine), -s * sine},
             {zero, c * s * (one - cosine), s * s + c * c * cosine, c * sine},
             {zero, s * sine, -c * sine, cosine}}};
}

// An ideal circular polariser: passes light with S3 > 0 where `right_handed`, with S3 < 0
// otherwise, as it comes, and nothing of the opposite. It is the same from both sides and however
// it is turned.
template <class T>
Mueller<T> circular_polariser(bool right_handed) {
    const T zero(0), half(0.5), turn(right_handed ? 0.5 : -0.5);
    return {{{half, zero, zero, turn},
             {zero, zero, zero, zero},
             {zero, zero, zero, zero},
             {turn, zero, zero, half}}};
}

// The axis of an element that stands in a scene, for light that travels along k through it, as the
// rotation from the ray's frame (x axis `x`, across k, unit) that the matrices above take.
//
// `zero` is the element's x axis in the world, of any length; projected perpendicular to the ray
// it is where angles begin. `angle` (radians) is counter-clockwise seen looking towards the source
// by someone in front of the element, on the side to which `front` points. Light that travels to
// the back meets the same axis from behind, where it is clockwise: so that a polariser before a
// mirror passes again what it passed. Along a ray parallel to `zero` any axis serves as zero.
template <class T>
Rotation<T> element_axis(const Vec3<T>& k, const Vec3<T>& x, const Vec3<T>& zero,
                         const Vec3<T>& front, T angle, T handedness) {
    const T along = glm::dot(zero, k);
    const Vec3<T> across = zero - along * k;
    const T size2 = glm::dot(across, across);
    const Vec3<T> begin =
        size2 > T(1e-12) * glm::dot(zero, zero) ? across / std::sqrt(size2) : any_perpendicular(k);
    const Rotation<T> start = rotation_between(k, x, begin, handedness);
    const T turn = glm::dot(k, front) < 0 ? -2 * angle : 2 * angle;
    const T c = std::cos(turn), s = std::sin(turn);
    return {start.cos2 * c - start.sin2 * s, start.sin2 * c + start.cos2 * s};
}

}  // namespace drude
