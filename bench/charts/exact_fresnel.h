// Fresnel's amplitudes and Airy's sums in extended precision, straight from the boundary
// conditions: the reference of the closed forms that everything else uses.
#pragma once

#include <cmath>
#include <complex>
#include <vector>

#include "materials/film_stack.h"

namespace drude {

using Exact = long double;
using ExactComplex = std::complex<long double>;

// The normal component of the wave vector in a medium of squared index `epsilon`, over that of
// vacuum: the root with both parts >= 0 (Born & Wolf, Principles of Optics, section 14.2).
inline ExactComplex exact_normal_component(const ExactComplex& epsilon, Exact cos_theta) {
    ExactComplex q = std::sqrt(epsilon - (1 - cos_theta) * (1 + cos_theta));
    if (q.imag() < 0) q = -q;
    return q;
}

// r_s and r_p at an interface, Verdet's sign, from normal components and squared indices.
struct ExactAmplitudes {
    ExactComplex s, p;
};
inline ExactAmplitudes exact_interface(const ExactComplex& q1, const ExactComplex& epsilon1,
                                       const ExactComplex& q2, const ExactComplex& epsilon2) {
    return {(q1 - q2) / (q1 + q2),
            (epsilon2 * q1 - epsilon1 * q2) / (epsilon2 * q1 + epsilon1 * q2)};
}

inline Reflection<Exact> exact_reflection(const ExactAmplitudes& r) {
    const ExactComplex cross = r.s * std::conj(r.p);
    return {std::norm(r.s), std::norm(r.p), cross.real(), cross.imag()};
}

// A bare surface; cos_theta in (0, 1].
inline Reflection<Exact> exact_reflect(Exact n, Exact k, Exact cos_theta) {
    const ExactComplex index(n, k), epsilon = index * index;
    return exact_reflection(
        exact_interface(cos_theta, 1, exact_normal_component(epsilon, cos_theta), epsilon));
}

// Coherent films, the first the outermost, at cos_theta in (0, 1]: the field's amplitudes on both
// sides of every interface from the substrate upwards (Born & Wolf, section 1.6), as forward and
// backward waves; only their ratio is kept, so that nothing overflows.
inline Reflection<Exact> exact_reflect(const std::vector<ThinFilm<Exact>>& films,
                                       const ComplexIndex<Exact>& substrate, Exact cos_theta,
                                       Exact wavelength) {
    const ExactComplex i(0, 1), below_index(substrate.n, substrate.k);
    ExactComplex epsilon_below = below_index * below_index;
    ExactComplex q_below = exact_normal_component(epsilon_below, cos_theta);
    // Of the waves just below the interface: backward over forward.
    ExactAmplitudes ratio{0, 0};
    for (size_t j = films.size() + 1; j-- > 0;) {
        const bool ambient = j == 0;
        ExactComplex epsilon = 1, q = cos_theta;
        if (!ambient) {
            const ExactComplex index(films[j - 1].index.n, films[j - 1].index.k);
            epsilon = index * index;
            q = exact_normal_component(epsilon, cos_theta);
        }
        const ExactAmplitudes step = exact_interface(q, epsilon, q_below, epsilon_below);
        ratio = {(step.s + ratio.s) / (1.0L + step.s * ratio.s),
                 (step.p + ratio.p) / (1.0L + step.p * ratio.p)};
        if (!ambient) {
            const Exact turn = 4 * std::acos(Exact(-1)) * films[j - 1].thickness / wavelength;
            const ExactComplex there_and_back = std::exp(i * turn * q);
            ratio = {ratio.s * there_and_back, ratio.p * there_and_back};
        }
        epsilon_below = epsilon;
        q_below = q;
    }
    return exact_reflection(ratio);
}

// The largest difference in the four distinct elements of the Mueller matrix.
template <class T>
double largest_difference(const Reflection<T>& a, const Reflection<Exact>& b) {
    double worst = 0;
    for (const Exact difference :
         {static_cast<Exact>(a.A()) - b.A(), static_cast<Exact>(a.B()) - b.B(),
          static_cast<Exact>(a.C) - b.C, static_cast<Exact>(a.S) - b.S}) {
        const double size = static_cast<double>(std::abs(difference));
        if (!(size <= worst)) worst = std::isnan(size) ? HUGE_VAL : size;
    }
    return worst;
}

}  // namespace drude
