// Coherent films on a substrate.
//
// Airy's sum taken layer by layer from the substrate upwards (Rouard 1937; Azzam & Bashara 1977,
// eq. 4.32): r <- (r_ij + r e) / (1 + r_ij r e), e = exp(2 i beta), beta = 2 pi d q / lambda.
// Only decaying exponentials occur, so that thick or strongly absorbing films cannot overflow, as
// the transfer-matrix form does.
#pragma once

#include "materials/fresnel.h"

namespace drude {

template <class T>
struct ThinFilm {
    ComplexIndex<T> index;
    T thickness;  // in the unit of the wavelength, >= 0
};

namespace film_detail {

template <class T>
Complex<T> squared(const ComplexIndex<T>& index) {
    return {(index.n - index.k) * (index.n + index.k), T(2.0) * index.n * index.k};
}

template <class T>
Amplitudes<T> interface_amplitudes(const Complex<T>& q1, const Complex<T>& eps1,
                                   const Complex<T>& q2, const Complex<T>& eps2) {
    const Complex<T> p1 = eps2 * q1, p2 = eps1 * q2;
    return {(q1 - q2) / (q1 + q2), (p1 - p2) / (p1 + p2)};
}

}  // namespace film_detail

// `films[0]` is the outermost of `count` films; light comes from vacuum at cos_theta in (0, 1].
// `wavelength` is the vacuum wavelength, > 0. count = 0 is the bare substrate.
template <class T>
Reflection<T> reflect(const ThinFilm<T>* films, int count, const ComplexIndex<T>& substrate,
                      const T& cos_theta, const T& wavelength) {
    using std::exp;
    if (count == 0) return reflect(substrate, cos_theta);
    const Complex<T> one{T(1.0), T(0.0)};
    Complex<T> q_below = normal_component(substrate, cos_theta);
    Complex<T> eps_below = film_detail::squared(substrate);
    Amplitudes<T> r{{T(0.0), T(0.0)}, {T(0.0), T(0.0)}};
    for (int j = count - 1; j >= -1; --j) {
        const Complex<T> q =
            j >= 0 ? normal_component(films[j].index, cos_theta) : Complex<T>{cos_theta, T(0.0)};
        const Complex<T> eps = j >= 0 ? film_detail::squared(films[j].index) : one;
        const Amplitudes<T> step = film_detail::interface_amplitudes(q, eps, q_below, eps_below);
        if (j == count - 1) {
            r = step;
        } else {
            const ThinFilm<T>& above = films[j + 1];
            const T turns = T(2.0) * above.thickness / wavelength;
            T sine, cosine;
            sincos_turns(turns * q_below.re, &sine, &cosine);
            const T decay = exp(T(-2.0 * pi) * turns * q_below.im);
            const Complex<T> e{decay * cosine, decay * sine};
            const Complex<T> rs = r.s * e, rp = r.p * e;
            r.s = (step.s + rs) / (one + step.s * rs);
            r.p = (step.p + rp) / (one + step.p * rp);
        }
        q_below = q;
        eps_below = eps;
    }
    return reflection_from_amplitudes(r);
}

}  // namespace drude
