// The ways in which renderers get the reflectance of a metal, each as a packet of 8 wavelengths in
// float fetches its constants and evaluates them.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "materials/film_table.h"
#include "materials/fresnel.h"
#include "materials/optical_constants.h"
#include "materials/packet.h"
#include "render/wavelengths.h"

namespace drude {

using FresnelPacket = Packet<8>;
using FresnelWavelengths = Wavelengths<8>;

template <class T>
struct ReflectancePair {
    T Rs, Rp;
};

// ---- formulas, of any scalar
// -------------------------------------------------------------------

// For |N|^2 far above 1, where sin^2 is nothing beside N^2 and light goes straight down inside
// (Born & Wolf, Principles of Optics, section 14.2; it is what pbrt-v2 takes for conductors).
template <class T>
ReflectancePair<T> large_index_reflect(const ComplexIndex<T>& index, const T& cos_theta) {
    const T size2 = index.n * index.n + index.k * index.k, twice = T(2.0) * index.n * cos_theta;
    const T cos2 = cos_theta * cos_theta;
    return {(size2 + cos2 - twice) / (size2 + cos2 + twice),
            (size2 * cos2 + T(1.0) - twice) / (size2 * cos2 + T(1.0) + twice)};
}

template <class T>
T normal_reflectance(const ComplexIndex<T>& index) {
    const T below = index.n - T(1.0), above = index.n + T(1.0), k2 = index.k * index.k;
    return (below * below + k2) / (above * above + k2);
}

template <class T>
T fifth_power_below_one(const T& cos_theta) {
    const T x = T(1.0) - cos_theta, x2 = x * x;
    return x2 * x2 * x;
}

// Schlick 1994 (Computer Graphics Forum 13(3), eq. 15), of unpolarised light.
template <class T>
T schlick(const T& at_normal, const T& cos_theta) {
    return at_normal + (T(1.0) - at_normal) * fifth_power_below_one(cos_theta);
}

// The error term of Lazanyi & Szirmay-Kalos 2005 (WSCG short papers), a cos (1 - cos)^6 taken from
// Schlick, with `a` such that the reflectance is right at cos = 1/7, where the term is largest
// (Hoffman 2019, Eurographics Workshop on Material Appearance Modeling).
template <class T>
T lazanyi(const T& at_normal, const T& a, const T& cos_theta) {
    const T x = T(1.0) - cos_theta, fifth = fifth_power_below_one(cos_theta);
    return at_normal + fifth * ((T(1.0) - at_normal) - a * cos_theta * x);
}
inline double lazanyi_amplitude(const ComplexIndex<double>& index) {
    const double cosine = 1.0 / 7;
    return (schlick(normal_reflectance(index), cosine) - reflect(index, cosine).A()) /
           (cosine * std::pow(1 - cosine, 6));
}

// ---- the same with tables of a metal
// -----------------------------------------------------------

inline ComplexIndex<double> index_at(const DenseIndex& metal, int i) {
    return {metal.n[static_cast<size_t>(i)], metal.k[static_cast<size_t>(i)]};
}

template <class F>
PackedSpectrum<8> packed(const DenseIndex& metal, const F& value) {
    DenseSpectrum dense{};
    for (int i = 0; i < spectrum_size; ++i) dense[i] = value(index_at(metal, i));
    return PackedSpectrum<8>(dense);
}

struct ExactFresnel {
    PackedSpectrum<8> n, k;
    explicit ExactFresnel(const DenseIndex& metal) : n(metal.n), k(metal.k) {}

    Reflection<FresnelPacket> full(float cosine, int phase) const {
        return reflect(ComplexIndex<FresnelPacket>{n[phase], k[phase]}, FresnelPacket(cosine));
    }
    ReflectancePair<FresnelPacket> pair(float cosine, int phase) const {
        const Reflection<FresnelPacket> r = full(cosine, phase);
        return {r.Rs, r.Rp};
    }
    FresnelPacket reflectance(float cosine, int phase) const { return full(cosine, phase).A(); }
    size_t bytes() const { return size_t{4} * 2 * spectrum_integral_size; }
};

struct LargeIndexFresnel {
    PackedSpectrum<8> n, k;
    explicit LargeIndexFresnel(const DenseIndex& metal) : n(metal.n), k(metal.k) {}

    ReflectancePair<FresnelPacket> pair(float cosine, int phase) const {
        return large_index_reflect(ComplexIndex<FresnelPacket>{n[phase], k[phase]},
                                   FresnelPacket(cosine));
    }
    FresnelPacket reflectance(float cosine, int phase) const {
        const ReflectancePair<FresnelPacket> r = pair(cosine, phase);
        return FresnelPacket(0.5f) * (r.Rs + r.Rp);
    }
    size_t bytes() const { return size_t{4} * 2 * spectrum_integral_size; }
};

struct SchlickFresnel {
    PackedSpectrum<8> at_normal;
    explicit SchlickFresnel(const DenseIndex& metal)
        : at_normal(packed(metal, [](const auto& index) { return normal_reflectance(index); })) {}

    FresnelPacket reflectance(float cosine, int phase) const {
        return schlick(at_normal[phase], FresnelPacket(cosine));
    }
    size_t bytes() const { return size_t{4} * spectrum_integral_size; }
};

struct LazanyiFresnel {
    PackedSpectrum<8> at_normal, amplitude;
    explicit LazanyiFresnel(const DenseIndex& metal)
        : at_normal(packed(metal, [](const auto& index) { return normal_reflectance(index); })),
          amplitude(packed(metal, lazanyi_amplitude)) {}

    FresnelPacket reflectance(float cosine, int phase) const {
        return lazanyi(at_normal[phase], amplitude[phase], FresnelPacket(cosine));
    }
    size_t bytes() const { return size_t{4} * 2 * spectrum_integral_size; }
};

// Rs and Rp, or their mean alone, at cosines an equal step apart, interpolated linearly; phase by
// phase, so that the two rows of a lookup are neighbours.
template <int Values>
class FresnelTable {
  public:
    FresnelTable(const DenseIndex& metal, int intervals) : intervals_(intervals) {
        rows_.resize(static_cast<size_t>(FresnelWavelengths::spacing) * (intervals + 1) * 8 *
                     Values);
        float* out = rows_.data();
        for (int phase = 0; phase < FresnelWavelengths::spacing; ++phase) {
            for (int node = 0; node <= intervals; ++node) {
                const double cosine = static_cast<double>(node) / intervals;
                for (int value = 0; value < Values; ++value) {
                    for (int lane = 0; lane < 8; ++lane) {
                        const int i = phase + lane * FresnelWavelengths::spacing;
                        const Reflection<double> r = reflect(index_at(metal, i), cosine);
                        *out++ = static_cast<float>(Values == 1 ? r.A() : value ? r.Rp : r.Rs);
                    }
                }
            }
        }
    }

    // cosine in [0, 1].
    std::array<FresnelPacket, Values> at(float cosine, int phase) const {
        const float place = cosine * static_cast<float>(intervals_);
        const int whole = static_cast<int>(place), node = whole < intervals_ ? whole : whole - 1;
        const FresnelPacket t(place - static_cast<float>(node));
        const float* row =
            &rows_[static_cast<size_t>(phase * (intervals_ + 1) + node) * 8 * Values];
        std::array<FresnelPacket, Values> result;
        for (int value = 0; value < Values; ++value) {
            const auto a = FresnelPacket::load(row + 8 * value);
            const auto b = FresnelPacket::load(row + 8 * (value + Values));
            result[static_cast<size_t>(value)] = a + t * (b - a);
        }
        return result;
    }
    size_t bytes() const { return rows_.size() * sizeof(float); }

  private:
    int intervals_;
    std::vector<float> rows_;
};

}  // namespace drude
