// Polarisers and retarders: what stands in front of a camera, as Mueller matrices in the frames and
// with the signs of mueller.h (Hecht, Optics, section 8.13).
#pragma once

#include <cmath>

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

}  // namespace drude
