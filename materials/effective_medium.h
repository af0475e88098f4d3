// Mixtures of two materials on a scale far below the wavelength.
#pragma once

#include "materials/fresnel.h"

namespace drude {

// The fraction of void in a layer that stands for a rough surface (Aspnes, Theeten & Hottier,
// Phys. Rev. B 20, 3292 (1979)).
inline constexpr double roughness_void = 0.5;

namespace effective_medium_detail {

// The square root with im >= 0, and with re >= 0 on the real axis.
template <class T>
Complex<T> sqrt_upper(const Complex<T>& a) {
    if (!(a.im < T(0.0))) return sqrt_first_quadrant(a);
    const Complex<T> root = sqrt_first_quadrant(conj(a));
    return {-root.re, root.im};
}

}  // namespace effective_medium_detail

// Bruggeman's mixture (Annalen der Physik 416, 636 (1935)) of spherical grains: with volume
// fractions f_a + f_b = 1,
//   f_a (e_a - e)/(e_a + 2e) + f_b (e_b - e)/(e_b + 2e) = 0,
// i.e. 2 e^2 - b e - e_a e_b = 0 with b = (3 f_a - 1) e_a + (3 f_b - 1) e_b. Neither material is
// the host: exchanging them together with their fractions changes nothing.
//
// `fraction_b` in [0, 1]; n > 0 and k >= 0 of both. Of the two roots one has im e >= 0 (and re e >
// 0 where nothing absorbs): their product is -e_a e_b/2, and the one with the upper root of the
// discriminant is it. Over double and ceres::Jet.
template <class T>
ComplexIndex<T> bruggeman(const ComplexIndex<T>& a, const ComplexIndex<T>& b, const T& fraction_b) {
    const Complex<T> ea{(a.n - a.k) * (a.n + a.k), T(2.0) * a.n * a.k};
    const Complex<T> eb{(b.n - b.k) * (b.n + b.k), T(2.0) * b.n * b.k};
    const T weight_b = T(3.0) * fraction_b - T(1.0), weight_a = T(1.0) - weight_b;
    const Complex<T> middle = weight_a * ea + weight_b * eb;
    const Complex<T> root =
        effective_medium_detail::sqrt_upper(middle * middle + T(8.0) * (ea * eb));
    const Complex<T> epsilon = T(0.25) * (middle + root);
    // Rounding may leave an absorption of -1e-17 where there is none.
    const T loss = select(epsilon.im < T(0.0), T(0.0), epsilon.im);
    const Complex<T> index = sqrt_first_quadrant(Complex<T>{epsilon.re, loss});
    return {index.re, index.im};
}

}  // namespace drude
