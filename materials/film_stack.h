// Coherent films on a substrate.
//
// From the substrate upwards, the ratio Y of the tangential fields: q in a medium that extends for
// ever (for p: q/N^2), so that an interface reflects (Y_above - Y)/(Y_above + Y), and at the upper
// side of a film of ratio y = q or q/N^2, of which e = exp(2 i beta), beta = 2 pi d q / lambda, is
// left after a passage there and back,
//   Y <- y (y (1 - e) + Y (1 + e)) / (y (1 + e) + Y (1 - e))
// (Abeles 1950; Born & Wolf, Principles of Optics, section 1.6; with exponentials for the sines).
// Only decaying exponentials occur: thick and strongly absorbing films cannot overflow, as the
// transfer matrix does. 1 - e keeps its digits, so that a thin film is as exact as none, and at a
// film's critical angle, where y and 1 - e vanish together, their ratio stays. Airy's sum of the
// interfaces' reflections (Rouard 1937) is 0/0 there.
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

// Of one polarisation, the ratio Y = over / under. A fraction, because where light is reflected
// totally below a film of the right thickness Y passes through infinity.
template <class T>
struct FieldRatio {
    Complex<T> over, under;
};

// At the upper side of a film of ratio y; `gone` = 1 - e, `left` = 1 + e.
template <class T>
FieldRatio<T> above_film(const Complex<T>& y, const FieldRatio<T>& below, const Complex<T>& gone,
                         const Complex<T>& left) {
    using std::abs;
    const Complex<T> over = y * (y * gone * below.under + left * below.over);
    const Complex<T> under = y * left * below.under + gone * below.over;
    // Any factor serves that keeps both in range, however many films there are.
    const T factor = T(1.0) / (abs(over.re) + abs(over.im) + abs(under.re) + abs(under.im));
    return {factor * over, factor * under};
}

// In front of all films, in a medium of ratio y.
template <class T>
Complex<T> amplitude(const T& y, const FieldRatio<T>& below) {
    const Complex<T> front = y * below.under;
    return (front - below.over) / (front + below.over);
}

}  // namespace film_detail

// `films[0]` is the outermost of `count` films; light comes from vacuum at cos_theta in (0, 1].
// `wavelength` is the vacuum wavelength, > 0. count = 0 is the bare substrate.
template <class T>
Reflection<T> reflect(const ThinFilm<T>* films, int count, const ComplexIndex<T>& substrate,
                      const T& cos_theta, const T& wavelength) {
    using std::expm1;
    if (count == 0) return reflect(substrate, cos_theta);
    const T two(2.0);
    const Complex<T> q_substrate = normal_component(substrate, cos_theta);
    film_detail::FieldRatio<T> s{q_substrate, {T(1.0), T(0.0)}};
    film_detail::FieldRatio<T> p{q_substrate, film_detail::squared(substrate)};
    for (int j = count - 1; j >= 0; --j) {
        const Complex<T> q = normal_component(films[j].index, cos_theta);
        const T length = films[j].thickness / wavelength;
        // Of half the phase: 1 - cos = 2 sin^2 of the half.
        T sine, cosine;
        sincos_turns(length * q.re, &sine, &cosine);
        const T absorbed = -expm1(T(-4.0 * pi) * length * q.im);
        const T twice = two * (T(1.0) - absorbed) * sine;
        const Complex<T> gone{absorbed + twice * sine, -(twice * cosine)};
        const Complex<T> left{two - gone.re, -gone.im};
        s = film_detail::above_film(q, s, gone, left);
        p = film_detail::above_film(q / film_detail::squared(films[j].index), p, gone, left);
    }
    return reflection_from_amplitudes(
        Amplitudes<T>{film_detail::amplitude(cos_theta, s), film_detail::amplitude(cos_theta, p)});
}

}  // namespace drude
