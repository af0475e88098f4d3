// N floats side by side in SIMD registers, one lane a wavelength.
//
// Built on the vector extension that g++ and clang share: the same source runs on any x86-64 and
// becomes AVX or AVX-512 where the build allows it. N is 4 or a multiple of 8, or 1: a plain float
// with a packet's interface.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <initializer_list>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "materials/scalar.h"

namespace drude {

// Lanes of a register.
template <int N>
inline constexpr int packet_lanes = N < 8 ? N : 8;

template <int N>
struct PacketMask {
    static constexpr int registers = N / packet_lanes<N>;
    using Vector [[gnu::vector_size(4 * packet_lanes<N>)]] = int32_t;
    Vector v[registers];  // -1 true, 0 false
};

template <int N>
struct Packet {
    static_assert(N == 1 || N == 4 || (N % 8 == 0 && N > 0), "a packet fills whole registers");
    static constexpr int size = N;
    static constexpr int registers = N / packet_lanes<N>;
    using Vector [[gnu::vector_size(4 * packet_lanes<N>)]] = float;
    using IntVector [[gnu::vector_size(4 * packet_lanes<N>)]] = int32_t;
    Vector v[registers];

    Packet() = default;
    // Every lane the same.
    Packet(float value) {
        for (Vector& r : v) r = Vector{} + value;
    }
    Packet(double value) : Packet(static_cast<float>(value)) {}
    Packet(int value) : Packet(static_cast<float>(value)) {}

    static Packet load(const float* lanes) {
        Packet p;
        std::memcpy(p.v, lanes, sizeof p.v);
        return p;
    }
    void store(float* lanes) const { std::memcpy(lanes, v, sizeof v); }
    float operator[](int lane) const { return v[lane / packet_lanes<N>][lane % packet_lanes<N>]; }
    void set(int lane, float value) { v[lane / packet_lanes<N>][lane % packet_lanes<N>] = value; }

    Packet& operator+=(const Packet& b) { return *this = *this + b; }
    Packet& operator-=(const Packet& b) { return *this = *this - b; }
    Packet& operator*=(const Packet& b) { return *this = *this * b; }

    friend Packet operator+(const Packet& a, const Packet& b) {
        Packet r;
        for (int i = 0; i < registers; ++i) r.v[i] = a.v[i] + b.v[i];
        return r;
    }
    friend Packet operator-(const Packet& a, const Packet& b) {
        Packet r;
        for (int i = 0; i < registers; ++i) r.v[i] = a.v[i] - b.v[i];
        return r;
    }
    friend Packet operator-(const Packet& a) {
        Packet r;
        for (int i = 0; i < registers; ++i) r.v[i] = -a.v[i];
        return r;
    }
    friend Packet operator*(const Packet& a, const Packet& b) {
        Packet r;
        for (int i = 0; i < registers; ++i) r.v[i] = a.v[i] * b.v[i];
        return r;
    }
    friend Packet operator/(const Packet& a, const Packet& b) {
        Packet r;
        for (int i = 0; i < registers; ++i) r.v[i] = a.v[i] / b.v[i];
        return r;
    }
    friend PacketMask<N> operator<(const Packet& a, const Packet& b) {
        PacketMask<N> r;
        for (int i = 0; i < registers; ++i) r.v[i] = a.v[i] < b.v[i];
        return r;
    }
    friend PacketMask<N> operator>(const Packet& a, const Packet& b) { return b < a; }
    friend PacketMask<N> operator>=(const Packet& a, const Packet& b) {
        PacketMask<N> r;
        for (int i = 0; i < registers; ++i) r.v[i] = a.v[i] >= b.v[i];
        return r;
    }
};

template <int N>
Packet<N> select(const PacketMask<N>& mask, const Packet<N>& a, const Packet<N>& b) {
    Packet<N> r;
    for (int i = 0; i < Packet<N>::registers; ++i) r.v[i] = mask.v[i] ? a.v[i] : b.v[i];
    return r;
}

template <int N>
Packet<N> max(const Packet<N>& a, const Packet<N>& b) {
    return select(a < b, b, a);
}
template <int N>
Packet<N> min(const Packet<N>& a, const Packet<N>& b) {
    return select(b < a, b, a);
}
template <int N>
Packet<N> abs(const Packet<N>& a) {
    return max(a, -a);
}

inline Packet<1> sqrt(const Packet<1>& a) {
    return Packet<1>(std::sqrt(a[0]));
}
#if defined(__SSE2__)
inline Packet<4> sqrt(const Packet<4>& a) {
    __m128 lanes;
    std::memcpy(&lanes, a.v, sizeof lanes);
    lanes = _mm_sqrt_ps(lanes);
    Packet<4> r;
    std::memcpy(r.v, &lanes, sizeof lanes);
    return r;
}
#endif

template <int N>
Packet<N> sqrt(const Packet<N>& a) {
    Packet<N> r;
    for (int i = 0; i < Packet<N>::registers; ++i) {
#if defined(__AVX__)
        const __m256 root = _mm256_sqrt_ps(reinterpret_cast<const __m256&>(a.v[i]));
        std::memcpy(&r.v[i], &root, sizeof root);
#elif defined(__SSE2__)
        __m128 half[2];
        std::memcpy(half, &a.v[i], sizeof half);
        half[0] = _mm_sqrt_ps(half[0]);
        half[1] = _mm_sqrt_ps(half[1]);
        std::memcpy(&r.v[i], half, sizeof half);
#else
        for (int lane = 0; lane < packet_lanes<N>; ++lane) {
            r.v[i][lane] = std::sqrt(a.v[i][lane]);
        }
#endif
    }
    return r;
}

// The nearest integer, for |a| < 2^22: adding and taking away 1.5 * 2^23 leaves no fraction bits.
template <int N>
Packet<N> round_small(const Packet<N>& a) {
    const Packet<N> shift(12582912.0f);
    return (a + shift) - shift;
}

// exp(a) = scale (1 + less_one), scale a power of 2 and |less_one| < 0.42.
template <int N>
struct SplitExponential {
    Packet<N> scale, less_one;
};

// For a in [-87, 88]; what is outside is moved there.
template <int N>
SplitExponential<N> split_exponential(const Packet<N>& a) {
    const Packet<N> x = min(max(a, Packet<N>(-87.0f)), Packet<N>(88.0f));
    const Packet<N> n = round_small(x * Packet<N>(1.44269504f));
    // ln 2 in two parts (Cody & Waite 1980), so that the remainder keeps its digits.
    const Packet<N> r = (x - n * Packet<N>(0.693359375f)) + n * Packet<N>(2.12194440e-4f);
    Packet<N> p(1.0f / 5040);
    for (const float c : {1.0f / 720, 1.0f / 120, 1.0f / 24, 1.0f / 6, 0.5f, 1.0f}) {
        p = p * r + Packet<N>(c);
    }
    SplitExponential<N> result;
    result.less_one = p * r;
    for (int i = 0; i < Packet<N>::registers; ++i) {
        using IntVector = typename Packet<N>::IntVector;
        const IntVector bits = (__builtin_convertvector(n.v[i], IntVector) + 127) << 23;
        std::memcpy(&result.scale.v[i], &bits, sizeof bits);
    }
    return result;
}

// exp(a) within 2e-7 relative for a in [-87, 88]; below that 0 to within 1e-38, above it clamped.
template <int N>
Packet<N> exp(const Packet<N>& a) {
    const SplitExponential<N> e = split_exponential(a);
    return (e.less_one + Packet<N>(1.0f)) * e.scale;
}

// exp(a) - 1 within 3e-7 relative for a up to 88, above it clamped.
template <int N>
Packet<N> expm1(const Packet<N>& a) {
    const SplitExponential<N> e = split_exponential(a);
    return e.less_one * e.scale + (e.scale - Packet<N>(1.0f));
}

// sin and cos of 2 pi `turns` within 2e-7 for |turns| < 2^20.
template <int N>
void sincos_turns(const Packet<N>& turns, Packet<N>* sine, Packet<N>* cosine) {
    // Quarter turns, then Taylor series on [-pi/4, pi/4]: the next terms are below 1e-9.
    const Packet<N> t = turns - round_small(turns);
    const Packet<N> quarter = round_small(t * Packet<N>(4.0f));
    const Packet<N> x = (t - quarter * Packet<N>(0.25f)) * Packet<N>(6.28318531f);
    const Packet<N> x2 = x * x;
    Packet<N> s(1.0f / 362880), c(-1.0f / 3628800);
    for (const float a : {-1.0f / 5040, 1.0f / 120, -1.0f / 6, 1.0f}) s = s * x2 + Packet<N>(a);
    for (const float a : {1.0f / 40320, -1.0f / 720, 1.0f / 24, -0.5f, 1.0f}) {
        c = c * x2 + Packet<N>(a);
    }
    s = s * x;
    // quarter is -2, -1, 0, 1 or 2; +-2 is the same half turn.
    const Packet<N> one(1.0f), zero(0.0f), size = abs(quarter);
    const PacketMask<N> odd = (one - abs(size - one)) > zero;
    const Packet<N> sign_quarter = select(quarter < zero, -one, one);
    const Packet<N> half_turn = select(size > Packet<N>(1.5f), -one, one);
    *sine = select(odd, sign_quarter * c, half_turn * s);
    *cosine = select(odd, -sign_quarter * s, half_turn * c);
}

// The sum of the lanes, in a fixed order.
template <int N>
float sum(const Packet<N>& a) {
    float total = 0;
    for (int lane = 0; lane < N; ++lane) total += a[lane];
    return total;
}

template <int N>
float max_lane(const Packet<N>& a) {
    float largest = a[0];
    for (int lane = 1; lane < N; ++lane) largest = a[lane] > largest ? a[lane] : largest;
    return largest;
}

}  // namespace drude
