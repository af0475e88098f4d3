// Optical constants as formulas of the vacuum wavelength, or of the photon energy E in eV.
//
// The terms of a metal's permittivity, in the convention exp(-i omega t) where absorption is
// im > 0. Each is causal (no pole in the upper half-plane) and real for an imaginary E, so that any
// sum of them obeys the Kramers-Kronig relations; a critical point alone may still be negative in
// im somewhere.
#pragma once

#include "materials/fresnel.h"

namespace drude {

// hc/e in eV nm (exact in the SI of 2019, here to a double's digits).
inline constexpr double electronvolt_nanometres = 1239.8419843320026;

// The photon energy in eV of a vacuum wavelength in nm, and back.
inline double photon_energy(double wavelength_nm) {
    return electronvolt_nanometres / wavelength_nm;
}

// Cauchy's n = A + B/l^2 + C/l^4, l in micrometres, of a transparent material far from its
// resonances; coefficients in 1, um^2 and um^4.
template <class T>
ComplexIndex<T> cauchy(const T& A, const T& B, const T& C, double wavelength_nm) {
    const double x = 1e6 / (wavelength_nm * wavelength_nm);
    return {A + T(x) * (B + T(x) * C), T(0.0)};
}

// One term B l^2 / (l^2 - L^2) of Sellmeier's n^2 - 1 (Annalen der Physik 219, 272 (1871)), L the
// wavelength of the resonance in the unit of l. Diverges at l = L.
template <class T>
Complex<T> sellmeier_term(const T& B, const T& L, const T& l) {
    return {B * l * l / ((l - L) * (l + L)), T(0.0)};
}

// Free electrons (Drude, Annalen der Physik 306, 566 (1900)): -Ep^2 / (E^2 + i G E), plasma energy
// Ep and damping G in eV.
template <class T>
Complex<T> drude_term(const T& plasma, const T& damping, const T& energy) {
    // -Ep^2 (E^2 - i G E) / (E^4 + G^2 E^2)
    const T scale = plasma * plasma / (energy * energy + damping * damping);
    return {-scale, scale * damping / energy};
}

// A bound electron (Lorentz 1878): f E0^2 / (E0^2 - E^2 - i G E), strength f, energies in eV.
template <class T>
Complex<T> lorentz_term(const T& strength, const T& resonance, const T& damping, const T& energy) {
    const T distance = (resonance - energy) * (resonance + energy), loss = damping * energy;
    const T scale = strength * resonance * resonance / (distance * distance + loss * loss);
    return {scale * distance, scale * loss};
}

// A critical point of the bands: A W [e^(i phi)/(W - E - i G) + e^(-i phi)/(W + E + i G)], energies
// in eV (Etchegoin, Le Ru & Meyer, J. Chem. Phys. 125, 164705 (2006), eq. 3).
template <class T>
Complex<T> critical_point_term(const T& amplitude, const T& resonance, const T& damping,
                               const T& phase, const T& energy) {
    using std::cos;
    using std::sin;
    const T c = cos(phase), s = sin(phase);
    const Complex<T> below{resonance - energy, -damping}, above{resonance + energy, damping};
    const Complex<T> sum = Complex<T>{c, s} / below + Complex<T>{c, -s} / above;
    return (amplitude * resonance) * sum;
}

}  // namespace drude
