// Reflection of polarised light off a smooth surface: closed forms, one complex root, no tangents.
//
// Conventions: N = n + ik with k >= 0, time factor exp(-i omega t), angle of incidence theta from
// the normal in vacuum. Amplitudes (Verdet's sign, r_p = -r_s at normal incidence)
//   r_s = (cos t - N cos t1) / (cos t + N cos t1),   r_p = (N cos t - cos t1) / (N cos t + cos t1),
// and rho := conj(r_p / r_s) = tan(Psi) exp(i Delta): a bare metal has Delta = 180 degrees at
// normal incidence, falling to 0 at grazing.
//
// With u = sin^2 t, q = a + ib = sqrt(N^2 - u), m = |q|^2 (Born & Wolf, Principles of Optics,
// section 14.2; Azzam & Bashara 1977, section 4.2):
//   R_s = (m + cos^2 - 2 a cos) / (m + cos^2 + 2 a cos)
//   conj(rho) = (u - q cos) / (u + q cos)
// from which everything below follows by multiplying out.
#pragma once

#include "materials/complex.h"

namespace drude {

// Complex refractive index n + ik of a medium against vacuum.
template <class T>
struct ComplexIndex {
    T n, k;
};

// What an isotropic surface does to Stokes vectors in its own frame (S1 > 0 along s):
//   [A B 0 0; B A 0 0; 0 0 C -S; 0 0 S C], A = (Rs + Rp)/2, B = (Rs - Rp)/2,
//   C = sqrt(Rs Rp) cos(Delta), S = sqrt(Rs Rp) sin(Delta).
template <class T>
struct Reflection {
    T Rs, Rp, C, S;

    T A() const { return T(0.5) * (Rs + Rp); }
    T B() const { return T(0.5) * (Rs - Rp); }
};

// q = a + ib = sqrt(N^2 - sin^2), the normal component of the refracted wave vector over that of
// vacuum, for cos_theta in [0, 1].
//
// re q^2 = n^2 - k^2 - sin^2 is summed in the order that cancels least. Where sin^2 is the smaller
// half, as (n - k)(n + k) - sin^2: a small N keeps its digits. Towards grazing, where sin^2 holds
// next to nothing of cos, as (n - 1)(n + 1) - (k - cos)(k + cos): an index of 1 gives q = cos and
// reflects nothing at any angle.
template <class T>
Complex<T> normal_component(const ComplexIndex<T>& index, const T& cos_theta) {
    const T one(1.0);
    const T& n = index.n;
    const T& k = index.k;
    const T re = select(cos_theta * cos_theta < T(0.5),
                        (n - one) * (n + one) - (k - cos_theta) * (k + cos_theta),
                        (n - k) * (n + k) - (one - cos_theta) * (one + cos_theta));
    return sqrt_first_quadrant(Complex<T>{re, T(2.0) * n * k});
}

// A bare surface of index n + ik (n > 0, k >= 0), cos_theta in [0, 1]. At cos_theta = 0 everything
// is reflected: Rs = Rp = 1, Delta = 0.
template <class T>
Reflection<T> reflect(const ComplexIndex<T>& index, const T& cos_theta) {
    const T u = (T(1.0) - cos_theta) * (T(1.0) + cos_theta);
    const Complex<T> q = normal_component(index, cos_theta);
    const T b2 = q.im * q.im;
    // The squares |cos -+ q|^2 and |u -+ q cos|^2 as sums, so that rounding makes neither
    // reflectance negative where it nearly vanishes (n close to 1, Brewster's angle).
    const T s_minus = q.re - cos_theta, s_plus = q.re + cos_theta;
    const T Rs = (s_minus * s_minus + b2) / (s_plus * s_plus + b2);
    const T a_cos = q.re * cos_theta, b_cos = q.im * cos_theta;
    const T p_minus = u - a_cos, p_plus = u + a_cos;
    // The denominator vanishes only where q = 0 at normal incidence, i.e. N = 0, which is outside
    // the range.
    const T scale = Rs / (p_plus * p_plus + b_cos * b_cos);
    return {Rs, scale * (p_minus * p_minus + b_cos * b_cos),
            scale * (u * u - (a_cos * a_cos + b_cos * b_cos)), scale * T(2.0) * b_cos * u};
}

// r_s and r_p between two media of normal components q and squared indices, Verdet's sign.
template <class T>
struct Amplitudes {
    Complex<T> s, p;
};

// From amplitudes: C + iS = |r_s|^2 rho = r_s conj(r_p).
template <class T>
Reflection<T> reflection_from_amplitudes(const Amplitudes<T>& r) {
    const Complex<T> cross = r.s * conj(r.p);
    return {norm(r.s), norm(r.p), cross.re, cross.im};
}

// Psi in [0, pi/2], Delta in (-pi, pi] in radians. Where nothing is reflected (Rs = Rp = 0) both
// are meaningless; callers check has_angles().
template <class T>
T psi(const Reflection<T>& r) {
    using std::atan2;
    using std::sqrt;
    return atan2(sqrt(r.Rp), sqrt(r.Rs));
}
template <class T>
T delta(const Reflection<T>& r) {
    using std::atan2;
    return atan2(r.S, r.C);
}
// Nothing but rounding is reflected by a surface of index 1.
inline bool has_angles(const Reflection<double>& r) {
    return r.Rs + r.Rp > 1e-30;
}

}  // namespace drude
