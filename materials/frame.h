// Frames of polarised light along a ray, with the handedness of the world kept straight.
//
// A ray's frame is (x, y) with y = h cross(k, x), k the direction in which light travels. h = +1
// where the world's coordinates are right-handed, -1 where they are left-handed (an ordinary pbrt
// scene), so that "S3 > 0 is clockwise seen looking towards the source" and "S2 > 0 is up-right in
// the picture" hold in either. No other cross product enters polarisation.
#pragma once

#include "materials/microfacet.h"
#include "materials/mueller.h"

namespace drude {

// A unit vector across k, of whatever azimuth: the s axis of a reflection straight back, where
// every azimuth serves (B = S = 0 and C = -A there).
template <class T>
Vec3<T> any_perpendicular(const Vec3<T>& k) {
    // Duff et al. 2017, JCGT 6(1): a branch-free orthonormal basis.
    const T sign = std::copysign(T(1), k.z);
    const T a = T(-1) / (sign + k.z);
    return {1 + sign * k.x * k.x * a, sign * k.x * k.y * a, -sign * k.x};
}

// The s axis (perpendicular to the plane of incidence, unit) of light that arrives along k and is
// reflected by a facet of normal m. Its sign is free: Stokes components do not see it.
template <class T>
Vec3<T> s_axis(const Vec3<T>& k, const Vec3<T>& m) {
    const Vec3<T> s = glm::cross(k, m);
    const T size2 = glm::dot(s, s);
    return size2 > T(1e-12) ? s / std::sqrt(size2) : any_perpendicular(k);
}

// The rotation from the frame of x axis `x` to that of x axis `s` on a ray of direction k.
template <class T>
Rotation<T> rotation_between(const Vec3<T>& k, const Vec3<T>& x, const Vec3<T>& s, T handedness) {
    return rotation_from_dots<T>(glm::dot(s, x), handedness * glm::dot(s, glm::cross(k, x)));
}

}  // namespace drude
