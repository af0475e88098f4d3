// Clear media: what their interface, or a plate of one, does to polarised light that it reflects
// and lets through.
//
// eta is the index behind the interface over that in front of it, the side on which light arrives:
// below 1 it arrives in the denser medium and beyond the critical angle, sin t = eta, is reflected
// totally. cos_theta is taken in front. With N = eta everything reflected is reflect() of
// fresnel.h, total reflection and its phases included: there q = i sqrt(sin^2 - eta^2), and
// tan(Delta/2) = cos t sqrt(sin^2 - eta^2) / sin^2 (Born & Wolf, Principles of Optics, eq. 1.5.61).
//
// What is transmitted has the same shape of Mueller matrix, in the frames of s axis common to all
// rays and p = k x s on each. Its amplitudes t_s = 2 cos t / (cos t + q), t_p = 2 eta cos t /
// (eta^2 cos t + q) are real and positive, so that S = 0 and C = sqrt(Ts Tp); Ts and Tp are ratios
// of flux (Born & Wolf, eq. 1.5.37): R + T = 1 in s and in p.
//
// Radiance: L / n^2 is what Ts and Tp act on. Radiance itself is compressed on its way into the
// denser medium: L(front) = T L(behind) / eta^2 for light that comes from behind, and for it the
// matrix is the same one, at the same pair of directions (T is that of the reversed light, and
// O M^T O = M for all matrices here). The matrices leave that factor out.
#pragma once

#include "materials/fresnel.h"

namespace drude {

// The Mueller matrices of the light that comes back and of the light that goes through.
template <class T>
struct DividedLight {
    Reflection<T> reflected, transmitted;
};

// One interface. T is double, float or a packet; eta > 0, cos_theta in [0, 1].
template <class T>
DividedLight<T> divide_at_interface(const T& eta, const T& cos_theta) {
    const ComplexIndex<T> index{eta, T(0.0)};
    // eta cos of the angle behind; 0 in total reflection.
    const T q = normal_component(index, cos_theta).re;
    // The addend decides 0/0: at grazing incidence on a thinner medium nothing is transmitted.
    const T tiny = T(1e-36);
    const T along_s = T(1.0) / (cos_theta + q + tiny);
    const T along_p = T(1.0) / (eta * eta * cos_theta + q + tiny);
    const T twice_s = T(2.0) * cos_theta * along_s, twice_p = T(2.0) * eta * cos_theta * along_p;
    const T share_s = T(2.0) * q * along_s, share_p = T(2.0) * eta * q * along_p;
    return {reflect(index, cos_theta),
            {twice_s * share_s, twice_p * share_p, twice_s * share_p, T(0.0)}};
}

// The unpolarised reflectance of an interface, in [0, 1].
template <class T>
T interface_reflectance(const T& eta, const T& cos_theta) {
    return reflect(ComplexIndex<T>{eta, T(0.0)}, cos_theta).A();
}

// A plane-parallel plate of relative index eta with the same medium on both sides, all its inner
// reflections summed without interference (a plate thicker than the light's coherence length).
// Light leaves it as it arrived, so that radiance needs no factor. The sums are geometric: with
// the interface's R and T in s and in p, and z = C + iS, t = sqrt(Ts Tp) in the channel of S2 + iS3
// (both interfaces have the same z, since r changes sign in s and in p),
//   R + T^2 R (1 + R^2 + ...) = 2R/(1 + R),   T^2 (1 + R^2 + ...) = (1 - R)/(1 + R),
//   z + t^2 z (1 + z^2 + ...) = z (1 + w),    w = t^2 / (1 - z^2) = Ts Tp / (Ts + Tp - Ts Tp);
// in total reflection t = 0 and z stays.
template <class T>
DividedLight<T> divide_at_plate(const T& eta, const T& cos_theta) {
    const DividedLight<T> once = divide_at_interface(eta, cos_theta);
    const T& Rs = once.reflected.Rs;
    const T& Rp = once.reflected.Rp;
    const T& Ts = once.transmitted.Rs;
    const T& Tp = once.transmitted.Rp;
    const T one(1.0), two(2.0);
    const T through = Ts * Tp / (Ts + Tp - Ts * Tp + T(1e-36));
    const T back = one + through;
    return {{two * Rs / (one + Rs), two * Rp / (one + Rp), back * once.reflected.C,
             back * once.reflected.S},
            {Ts / (one + Rs), Tp / (one + Rp), through, T(0.0)}};
}

}  // namespace drude
