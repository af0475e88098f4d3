// Reflection off a metal under films, tabulated: wavelength by wavelength on the 1 nm grid, each
// averaged over the nanometre that it stands for and over the spread of the films' thickness, and
// interpolated over the angle of incidence.
//
// A film of some micrometres has a fringe every few nanometres: the value at whole nanometres alone
// would alias, and the closed form of a stack costs several times a metal's. Here either is a
// lookup: a cubic through four angles, which the table's own number of angles keeps within
// film_table_tolerance. Thicker films need more angles, up to the point where a nanometre holds
// enough fringes to wash them out.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "materials/film_average.h"
#include "materials/packet.h"

namespace drude {

// Films thicker than this are not for a table: in single precision their phases lose the digits
// that fringes need, and no source is coherent over as much.
inline constexpr double thickest_film_nm = 1e5;

// What interpolation may add to any of Rs, Rp, C and S.
inline constexpr double film_table_tolerance = 2e-4;

namespace film_detail {

// The table's angles are even in s, cos = s (s + denser)/(1 + denser): towards grazing angles,
// where a film's surfaces reflect most and its resonances are narrow, they stand closer.
inline constexpr float denser = 0.25f;
inline float cosine_at(float s) {
    return s * (s + denser) / (1 + denser);
}
inline float place_of(float cosine) {
    return 2 * (1 + denser) * cosine /
           (denser + std::sqrt(denser * denser + 4 * (1 + denser) * cosine));
}

}  // namespace film_detail

class FilmTable {
  public:
    FilmTable() = default;

    // For packets of `lanes` wavelengths spread evenly over the film's range, a divisor of 400.
    // `material` may have any number of films. Takes some milliseconds a film of a
    // micrometre, and seconds where films are 100 micrometres thick; `for_each(count, body)` must
    // call body for 0 ... count - 1 in whatever order or at the same time. Throws Error (user) as
    // film_samples().
    using ForEach = std::function<void(int, const std::function<void(int)>&)>;
    FilmTable(const Material& material, int lanes, const ForEach& for_each = one_by_one);

    bool empty() const { return rows_.empty(); }
    // The largest error in any of Rs, Rp, C and S of interpolating between the angles, as looked
    // for at 32 wavelengths. Above film_table_tolerance where even the largest table is too coarse:
    // in a clear film that light enters under almost the critical angle, which is a resonator
    // there.
    double interpolation_error() const { return interpolation_error_; }
    // Number of angles less one, and bytes held.
    int intervals() const { return intervals_; }
    size_t bytes() const { return rows_.size() * sizeof(float); }

    // At the wavelengths 380 + phase + lane * 400/N nm, N the `lanes` of the constructor, and
    // cos_theta in [0, 1].
    template <int N>
    Reflection<Packet<N>> at(float cos_theta, int phase) const {
        const float place = film_detail::place_of(cos_theta) * static_cast<float>(intervals_);
        const int first = std::min(std::max(static_cast<int>(place) - 1, 0), intervals_ - 3);
        // Lagrange's polynomials of the nodes 0, 1, 2, 3.
        const float t = place - static_cast<float>(first), t1 = t - 1, t2 = t - 2, t3 = t - 3;
        const float weight[4] = {t1 * t2 * t3 / -6, t * t2 * t3 / 2, t * t1 * t3 / -2,
                                 t * t1 * t2 / 6};
        Packet<N> sum[4];
        const float* row = &rows_[static_cast<size_t>(first) * row_size + phase * N];
        for (int q = 0; q < 4; ++q) {
            sum[q] = Packet<N>(weight[0]) * Packet<N>::load(row + q * spectrum_integral_size);
        }
        for (int node = 1; node < 4; ++node) {
            row += row_size;
            for (int q = 0; q < 4; ++q) {
                sum[q] +=
                    Packet<N>(weight[node]) * Packet<N>::load(row + q * spectrum_integral_size);
            }
        }
        return realisable(Reflection<Packet<N>>{sum[0], sum[1], sum[2], sum[3]});
    }

  private:
    static void one_by_one(int count, const std::function<void(int)>& body) {
        for (int i = 0; i < count; ++i) body(i);
    }

    // Rs, Rp, C and S of all wavelengths at one angle.
    static constexpr int row_size = 4 * spectrum_integral_size;

    // Interpolation may leave the physical: reflectances into [0, 1], and no more phase than light.
    template <int N>
    static Reflection<Packet<N>> realisable(const Reflection<Packet<N>>& r) {
        using P = Packet<N>;
        const P zero(0.0f), one(1.0f);
        const P Rs = min(max(r.Rs, zero), one), Rp = min(max(r.Rp, zero), one);
        const P limit = Rs * Rp, size = r.C * r.C + r.S * r.S;
        const P scale = select(size > limit, sqrt(limit / max(size, P(1e-30f))), one);
        return {Rs, Rp, scale * r.C, scale * r.S};
    }

    int intervals_ = 0;
    double interpolation_error_ = 0;
    std::vector<float> rows_;  // by angle, quantity, phase, lane
};

}  // namespace drude
