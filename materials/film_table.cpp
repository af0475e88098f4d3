#include "materials/film_table.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "materials/film_stack.h"

namespace drude {

namespace {

// Fringes of 100 micrometres need some 4000.
constexpr int least_intervals = 32, most_intervals = 4096;
constexpr int angles = 8;  // a packet of them at a time
using P = Packet<angles>;

// The averaged reflection at one wavelength of the grid and at the table's angles.
std::vector<Reflection<float>> column(const Material& material, int wavelength, int intervals) {
    const double nm = spectrum_first_nm + wavelength;
    // By the number of harmonics, 4 times a power of 2: many at grazing angles only.
    std::map<int, std::vector<FilmSample>> averages;
    const int count = static_cast<int>(material.layers.size());
    std::vector<Reflection<float>> result(intervals + 1);
    std::vector<ThinFilm<P>> films(material.layers.size());
    for (int begin = 0; begin <= intervals; begin += angles) {
        P cosine;
        for (int lane = 0; lane < angles; ++lane) {
            cosine.set(
                lane, film_detail::cosine_at(static_cast<float>(std::min(begin + lane, intervals)) /
                                             static_cast<float>(intervals)));
        }
        int harmonics = 4;
        const int wanted = film_harmonics(material, nm, static_cast<double>(cosine[0]));
        while (harmonics < wanted) harmonics *= 2;
        std::vector<FilmSample>& samples = averages[harmonics];
        if (samples.empty()) samples = film_samples(material, nm, 1.0, harmonics);
        Reflection<P> sum{P(0.0f), P(0.0f), P(0.0f), P(0.0f)};
        for (const FilmSample& sample : samples) {
            for (int j = 0; j < count; ++j) {
                films[j] = {{P(sample.layers[j].n), P(sample.layers[j].k)},
                            P(sample.thickness_nm[j])};
            }
            const ComplexIndex<P> substrate{P(sample.substrate.n), P(sample.substrate.k)};
            add_weighted(reflect(films.data(), count, substrate, cosine, P(sample.wavelength_nm)),
                         P(sample.weight), &sum);
        }
        for (int lane = 0; lane < angles && begin + lane <= intervals; ++lane) {
            result[begin + lane] = {sum.Rs[lane], sum.Rp[lane], sum.C[lane], sum.S[lane]};
        }
    }
    return result;
}

// What a cubic through every other angle makes of those between, at its worst.
double interpolation_error(const std::vector<Reflection<float>>& fine) {
    double worst = 0;
    const auto look = [&](size_t at, size_t first, const float(&weight)[4]) {
        Reflection<float> sum{0, 0, 0, 0};
        for (size_t node = 0; node < 4; ++node) {
            add_weighted(fine[first + 2 * node], weight[node], &sum);
        }
        const Reflection<float>& exact = fine[at];
        for (const float error :
             {sum.Rs - exact.Rs, sum.Rp - exact.Rp, sum.C - exact.C, sum.S - exact.S}) {
            worst = std::max(worst, static_cast<double>(std::abs(error)));
        }
    };
    const size_t last = fine.size() - 1;
    for (size_t at = 3; at + 3 <= last; at += 2) {
        look(at, at - 3, {-0.0625f, 0.5625f, 0.5625f, -0.0625f});
    }
    look(1, 0, {0.3125f, 0.9375f, -0.3125f, 0.0625f});
    look(last - 1, last - 6, {0.0625f, -0.3125f, 0.9375f, 0.3125f});
    return worst;
}

struct Resolution {
    int intervals;
    double error;  // of interpolation
};

// The fewest angles that keep the tolerance, judged at wavelengths all over the range.
Resolution resolution_for(const Material& material, const FilmTable::ForEach& for_each) {
    constexpr int looks = 32;
    for (int next = least_intervals;; next += next / 4) {
        const int intervals = std::min(next, most_intervals);
        double errors[looks];
        for_each(looks, [&](int k) {
            const int wavelength = k * (spectrum_integral_size - 1) / (looks - 1);
            errors[k] = interpolation_error(column(material, wavelength, 2 * intervals));
        });
        const double worst = *std::max_element(errors, errors + looks);
        if (worst <= film_table_tolerance / 2 || intervals == most_intervals) {
            return {intervals, worst};
        }
    }
}

}  // namespace

FilmTable::FilmTable(const Material& material, int lanes, const ForEach& for_each) {
    const Resolution resolution = resolution_for(material, for_each);
    intervals_ = resolution.intervals;
    interpolation_error_ = resolution.error;
    rows_.resize(static_cast<size_t>(intervals_ + 1) * row_size);
    const int phases = spectrum_integral_size / lanes;
    for_each(spectrum_integral_size, [&](int wavelength) {
        const auto values = column(material, wavelength, intervals_);
        const int place = wavelength % phases * lanes + wavelength / phases;
        for (int angle = 0; angle <= intervals_; ++angle) {
            float* row = &rows_[static_cast<size_t>(angle) * row_size + place];
            row[0] = values[angle].Rs;
            row[spectrum_integral_size] = values[angle].Rp;
            row[2 * spectrum_integral_size] = values[angle].C;
            row[3 * spectrum_integral_size] = values[angle].S;
        }
    });
}

}  // namespace drude
