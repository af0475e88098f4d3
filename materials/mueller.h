// Stokes vectors, Mueller matrices and the rotation of their frames.
//
// A Stokes vector (S0, S1, S2, S3) belongs to a frame (x, y, k), k the direction in which light
// travels: S1 > 0 along x, S2 > 0 at 45 degrees from x towards y, S3 > 0 clockwise seen looking
// towards the source (right-handed in optics; Hecht, Optics, section 8.13).
#pragma once

#include "materials/fresnel.h"

namespace drude {

template <class T>
struct Stokes {
    T s[4];

    T& operator[](int i) { return s[i]; }
    const T& operator[](int i) const { return s[i]; }
};

// cos and sin of twice the angle of a frame rotation: all that Stokes vectors see of it.
template <class T>
struct Rotation {
    T cos2, sin2;
};

// The rotation that takes components in (x, y) to those in (x', y'), where the unit vector
// x' = c x + s y: pass the two dot products c = x'.x, s = x'.y; they are normalised here. For
// c = s = 0 (x' along k) there is no such rotation; the result is the identity.
template <class T>
Rotation<T> rotation_from_dots(const T& c, const T& s) {
    const T size = c * c + s * s;
    if (!(size > T(0))) return {T(1), T(0)};
    const T inverse = T(1) / size;
    return {(c * c - s * s) * inverse, T(2) * c * s * inverse};
}

template <class T>
Rotation<T> inverse(const Rotation<T>& r) {
    return {r.cos2, -r.sin2};
}

template <class T>
Stokes<T> rotate(const Rotation<T>& r, const Stokes<T>& v) {
    return {{v[0], r.cos2 * v[1] + r.sin2 * v[2], r.cos2 * v[2] - r.sin2 * v[1], v[3]}};
}

template <class T>
Stokes<T> apply(const Reflection<T>& r, const Stokes<T>& v) {
    const T A = r.A(), B = r.B();
    return {{A * v[0] + B * v[1], B * v[0] + A * v[1], r.C * v[2] - r.S * v[3],
             r.S * v[2] + r.C * v[3]}};
}

// A dense Mueller matrix, for optical elements and for checking; the hot path works with the four
// numbers of a Reflection and never builds one.
template <class T>
struct Mueller {
    T m[4][4];

    static Mueller diagonal(T a, T b, T c, T d) {
        return {{{a, T(0), T(0), T(0)},
                 {T(0), b, T(0), T(0)},
                 {T(0), T(0), c, T(0)},
                 {T(0), T(0), T(0), d}}};
    }
    static Mueller identity() { return diagonal(T(1), T(1), T(1), T(1)); }

    friend Mueller operator*(const Mueller& a, const Mueller& b) {
        Mueller r;
        for (int i = 0; i < 4; ++i) {
            for (int j = 0; j < 4; ++j) {
                r.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j] +
                            a.m[i][3] * b.m[3][j];
            }
        }
        return r;
    }
    friend Stokes<T> operator*(const Mueller& a, const Stokes<T>& v) {
        Stokes<T> r;
        for (int i = 0; i < 4; ++i) {
            r[i] = a.m[i][0] * v[0] + a.m[i][1] * v[1] + a.m[i][2] * v[2] + a.m[i][3] * v[3];
        }
        return r;
    }
};

template <class T>
Mueller<T> mueller(const Reflection<T>& r) {
    const T zero(0), A = r.A(), B = r.B();
    return {
        {{A, B, zero, zero}, {B, A, zero, zero}, {zero, zero, r.C, -r.S}, {zero, zero, r.S, r.C}}};
}

template <class T>
Mueller<T> mueller(const Rotation<T>& r) {
    const T zero(0), one(1);
    return {{{one, zero, zero, zero},
             {zero, r.cos2, r.sin2, zero},
             {zero, -r.sin2, r.cos2, zero},
             {zero, zero, zero, one}}};
}

// The same surface seen with light going the other way, in the same x axes: O M^T O with
// O = diag(1, 1, -1, 1) (Sekera 1966; van de Hulst 1957, section 5.22).
template <class T>
Mueller<T> reversed(const Mueller<T>& a) {
    Mueller<T> r;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) r.m[i][j] = ((i == 2) != (j == 2)) ? -a.m[j][i] : a.m[j][i];
    }
    return r;
}

// The smallest eigenvalue, over M_00, of Cloude's coherency matrix: a Mueller matrix is that of a
// physical (passive or not) device where none is negative (Cloude 1986, Optik 75, 26). Returns a
// value >= -tolerance for a realisable matrix.
double smallest_coherency_eigenvalue(const Mueller<double>& matrix);

}  // namespace drude
