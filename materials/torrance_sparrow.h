// The polarised Torrance-Sparrow conductor: a lobe of little mirrors, each of which reflects
// polarised light by Fresnel's equations at its own angle.
//
//   M(o <- i) cos_i = D(m) G2(o, i, m) / (4 cos_o) * Fresnel Mueller(i.m)
//
// (Torrance & Sparrow 1967; with Mueller matrices Priest & Germer 2000). The four numbers of the
// facet's reflection stay apart from the scalar in front: in a renderer the scalar is one number a
// path, the reflection one a wavelength.
#pragma once

#include "materials/film_stack.h"
#include "materials/frame.h"
#include "materials/microfacet.h"

namespace drude {

// A smooth metal: n + ik under any number of films (the first is the outermost).
template <class T>
struct Surface {
    ComplexIndex<T> substrate;
    const ThinFilm<T>* films = nullptr;
    int film_count = 0;
    T wavelength{1.0};  // in the unit of the films' thickness; unused without films

    Reflection<T> operator()(const T& cos_theta) const {
        return reflect(films, film_count, substrate, cos_theta, wavelength);
    }
};

// The Mueller matrix, times cos_i and per unit solid angle, from light arriving out of direction i
// to light leaving along o, in local coordinates (surface normal z, both directions away from the
// surface and above it; otherwise zero). Frames: the incoming ray (travelling along -i) has x axis
// x_i, the outgoing one (along o) x_o, both unit and across their rays; `handedness` as in
// frame.h. A mirror (beta = 0) has no finite value: use reflect() and mirror_mueller() there.
template <class T>
Mueller<T> evaluate_conductor(const Microfacets<T>& microfacets, const Surface<T>& surface,
                              const Vec3<T>& i, const Vec3<T>& x_i, const Vec3<T>& o,
                              const Vec3<T>& x_o, T handedness) {
    const auto e = microfacets.evaluate(o, i);
    if (!(e.value > 0)) return Mueller<T>::diagonal(0, 0, 0, 0);
    const Vec3<T> k_in = -i;
    const Vec3<T> s = s_axis(k_in, e.m);
    const Rotation<T> in = rotation_between(k_in, x_i, s, handedness);
    const Rotation<T> out = inverse(rotation_between(o, x_o, s, handedness));
    Mueller<T> result = mueller(out) * mueller(surface(glm::dot(i, e.m))) * mueller(in);
    for (auto& row : result.m) {
        for (T& element : row) element *= e.value;
    }
    return result;
}

// The Mueller matrix of a perfect mirror of normal m between the rays along -i and along o, where
// o is i mirrored at m.
template <class T>
Mueller<T> mirror_mueller(const Surface<T>& surface, const Vec3<T>& m, const Vec3<T>& i,
                          const Vec3<T>& x_i, const Vec3<T>& o, const Vec3<T>& x_o, T handedness) {
    const Vec3<T> k_in = -i;
    const Vec3<T> s = s_axis(k_in, m);
    return mueller(inverse(rotation_between(o, x_o, s, handedness))) *
           mueller(surface(glm::dot(i, m))) * mueller(rotation_between(k_in, x_i, s, handedness));
}

}  // namespace drude
