// Complex numbers over any scalar. std::complex is specified for the built-in types only; the
// optics needs them over ceres::Jet and over packets of floats.
#pragma once

#include "materials/scalar.h"

namespace drude {

template <class T>
struct Complex {
    T re, im;

    friend Complex operator+(const Complex& a, const Complex& b) {
        return {a.re + b.re, a.im + b.im};
    }
    friend Complex operator-(const Complex& a, const Complex& b) {
        return {a.re - b.re, a.im - b.im};
    }
    friend Complex operator*(const Complex& a, const Complex& b) {
        return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
    }
    friend Complex operator*(const T& a, const Complex& b) { return {a * b.re, a * b.im}; }
    friend Complex operator/(const Complex& a, const Complex& b) {
        const T inverse = T(1.0) / (b.re * b.re + b.im * b.im);
        return {(a.re * b.re + a.im * b.im) * inverse, (a.im * b.re - a.re * b.im) * inverse};
    }
};

template <class T>
T norm(const Complex<T>& a) {
    return a.re * a.re + a.im * a.im;
}

template <class T>
Complex<T> conj(const Complex<T>& a) {
    return {a.re, -a.im};
}

// The square root in the first quadrant of a number with im >= 0: the larger of its parts from
// (|a| + |re a|)/2, the other by division, so that nothing cancels. The 1e-36 keeps
// derivatives finite at 0, whose root comes out as 7e-10.
template <class T>
Complex<T> sqrt_first_quadrant(const Complex<T>& a) {
    using std::sqrt;
    const T zero(0.0), half(0.5);
    const T magnitude = sqrt(norm(a) + T(1e-36));
    const T size = select(a.re < zero, -a.re, a.re);
    const T larger = sqrt(half * (magnitude + size));
    const T smaller = half * a.im / larger;
    return {select(a.re < zero, smaller, larger), select(a.re < zero, larger, smaller)};
}

}  // namespace drude
