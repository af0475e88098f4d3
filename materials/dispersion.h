// Optical constants as formulas of the vacuum wavelength.
#pragma once

#include "materials/fresnel.h"

namespace drude {

// Cauchy's n = A + B/l^2 + C/l^4, l in micrometres, of a transparent material far from its
// resonances; coefficients in 1, um^2 and um^4.
template <class T>
ComplexIndex<T> cauchy(const T& A, const T& B, const T& C, double wavelength_nm) {
    const double x = 1e6 / (wavelength_nm * wavelength_nm);
    return {A + T(x) * (B + T(x) * C), T(0.0)};
}

}  // namespace drude
