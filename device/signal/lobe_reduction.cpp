#include "device/signal/lobe_reduction.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "base/numbers.h"
#include "device/signal/harmonic_fit.h"
#include "device/signal/lamp_drift.h"
#include "device/signal/scan_readings.h"
#include "device/signal/wavelength_bins.h"

namespace drude {

namespace {

constexpr double straight = 90;
constexpr double least_signal = 5;  // straight beam over its noise, below which a pixel is dark
constexpr double least_sigma = 1e-9;

// Linear counts a second of every pixel, with their variance; the mean of some readings.
struct Rates {
    std::vector<double> value, variance;
    std::vector<int> readings;  // that were not saturated

    explicit Rates(size_t pixels = 0)
        : value(pixels, 0), variance(pixels, 0), readings(pixels, 0) {}
};

struct Position {
    double incidence_deg, offset_deg;
    bool operator<(const Position& other) const {
        return incidence_deg != other.incidence_deg ? incidence_deg < other.incidence_deg
                                                    : offset_deg < other.offset_deg;
    }
};

std::string position_name(const Position& position) {
    if (position.incidence_deg == straight) return "straight through";
    return fmt::format("at {} degrees, offset {}", format_double(position.incidence_deg),
                       format_double(position.offset_deg));
}

void check(const LobeReading& reading, size_t pixels) {
    const std::string name = position_name({reading.incidence_deg, reading.offset_deg});
    for (const size_t found :
         {reading.step.counts.size(), reading.step.variance.size(), reading.step.saturated.size(),
          reading.dark.size(), reading.dark_variance.size()}) {
        if (found != pixels) {
            user_error("the lobe reading {} has {} pixels, expected {} as the spectrometer has",
                       name, found, pixels);
        }
    }
    if (!(reading.integration_s > 0 && std::isfinite(reading.integration_s))) {
        user_error("the lobe reading {} has an integration time of {} s, expected one above 0",
                   name, format_double(reading.integration_s));
    }
    if (!std::isfinite(reading.step.time_s)) {
        user_error("the lobe reading {} was taken at {} s, expected a finite time", name,
                   format_double(reading.step.time_s));
    }
    if (!(reading.incidence_deg > 0 && reading.incidence_deg <= straight)) {
        user_error(
            "found a lobe reading at {} degrees of incidence, expected one above 0 and "
            "below 90, or 90 for the straight beam",
            format_double(reading.incidence_deg));
    }
}

// `lamp`: what the light of every pixel was at the time, over that of the mean beam.
void add(const LobeReading& reading, const std::vector<double>& polynomial,
         const std::vector<double>& lamp, Rates* rates) {
    for (size_t j = 0; j < rates->value.size(); ++j) {
        if (reading.step.saturated[j]) continue;
        const LinearCounts linear =
            linear_counts(reading.step.counts[j] - reading.dark[j], polynomial);
        if (!std::isfinite(linear.value)) continue;
        const double seconds = reading.integration_s * lamp[j];
        if (!(seconds > 0)) continue;
        const double scale = linear.slope / seconds;
        rates->value[j] += linear.value / seconds;
        rates->variance[j] += scale * scale * (reading.step.variance[j] + reading.dark_variance[j]);
        ++rates->readings[j];
    }
}

void finish(Rates* rates) {
    for (size_t j = 0; j < rates->value.size(); ++j) {
        const int n = rates->readings[j];
        if (n == 0) continue;
        rates->value[j] /= n;
        rates->variance[j] /= static_cast<double>(n) * n;
    }
}

bool is_lit(double signal, double variance) {
    return signal > 0 && signal > least_signal * std::sqrt(variance);
}

// Both polarisations of a position, averaged.
struct Pair {
    Rates parallel[2], crossed[2];  // p, s
    bool has[2] = {}, has_crossed[2] = {};

    explicit Pair(size_t pixels)
        : parallel{Rates(pixels), Rates(pixels)}, crossed{Rates(pixels), Rates(pixels)} {}

    void add_reading(const LobeReading& reading, const std::vector<double>& polynomial,
                     const std::vector<double>& lamp) {
        const size_t i = reading.s_polarised ? 1 : 0;
        add(reading, polynomial, lamp, reading.crossed ? &crossed[i] : &parallel[i]);
        (reading.crossed ? has_crossed : has)[i] = true;
    }

    void finish_both() {
        for (size_t i = 0; i < 2; ++i) {
            finish(&parallel[i]);
            finish(&crossed[i]);
        }
    }

    // The flux, crossed light included where it was read.
    Rates flux(bool s) const {
        const size_t i = s ? 1 : 0;
        Rates sum = parallel[i];
        if (!has_crossed[i]) return sum;
        for (size_t j = 0; j < sum.value.size(); ++j) {
            sum.value[j] += crossed[i].value[j];
            sum.variance[j] += crossed[i].variance[j];
            sum.readings[j] = std::min(sum.readings[j], crossed[i].readings[j]);
        }
        return sum;
    }
};

// From the straight-through readings along the polariser; a visit's s and p count together.
LampDrift lamp_drift(const std::vector<LobeReading>& readings, const std::vector<double>& nm,
                     const std::vector<double>& polynomial, size_t* visits) {
    struct Visit {
        Pair rates;
        double time_s = 0;
        int count = 0;
    };
    const std::vector<double> steady(nm.size(), 1);
    std::map<uint32_t, Visit> all;
    Pair mean(nm.size());
    for (const LobeReading& reading : readings) {
        if (reading.incidence_deg != straight || reading.crossed) continue;
        Visit& visit = all.try_emplace(reading.visit, Visit{Pair(nm.size()), 0, 0}).first->second;
        visit.rates.add_reading(reading, polynomial, steady);
        visit.time_s += reading.step.time_s;
        ++visit.count;
        mean.add_reading(reading, polynomial, steady);
    }
    mean.finish_both();
    *visits = all.size();
    std::vector<BeamRatio> ratios;
    for (auto& [number, visit] : all) {
        visit.rates.finish_both();
        BeamRatio ratio{visit.time_s / visit.count, std::vector<double>(nm.size(), 1),
                        std::vector<double>(nm.size(), 0)};
        for (size_t j = 0; j < nm.size(); ++j) {
            double sum = 0;
            for (size_t i = 0; i < 2; ++i) {
                const Rates &now = visit.rates.parallel[i], &all_time = mean.parallel[i];
                if (now.readings[j] == 0 || !(now.variance[j] > 0) ||
                    !is_lit(all_time.value[j], all_time.variance[j])) {
                    continue;
                }
                const double weight = all_time.value[j] * all_time.value[j] / now.variance[j];
                sum += weight * now.value[j] / all_time.value[j];
                ratio.weight[j] += weight;
            }
            if (ratio.weight[j] > 0) ratio.ratio[j] = sum / ratio.weight[j];
        }
        ratios.push_back(std::move(ratio));
    }
    return LampDrift(nm, std::move(ratios));
}

struct Ratio {
    bool usable = false;
    double value = 0, sigma = 0;
};

Ratio ratio_in_bin(const Rates& rates, const Rates& beam, const std::vector<double>& nm,
                   double centre, const ReductionOptions& options) {
    std::vector<double> weights(nm.size(), 0);
    for (size_t j = 0; j < nm.size(); ++j) {
        const double signal = beam.value[j];
        const bool lit = beam.readings[j] > 0 && is_lit(signal, beam.variance[j]);
        // Not the inverse of the reading's own variance: that of few counts goes with the counts,
        // and would count low readings for more.
        if (lit && rates.readings[j] > 0) weights[j] = signal * signal;
    }
    const BinShares shares = bin_shares(nm, weights, centre, options.step_nm);
    Ratio result;
    result.usable = !shares.pixel.empty();
    double variance = 0;
    for (size_t i = 0; i < shares.pixel.size(); ++i) {
        const size_t j = shares.pixel[i];
        const double ratio = rates.value[j] / beam.value[j];
        result.value += shares.share[i] * ratio;
        variance += shares.share[i] * shares.share[i] *
                    (rates.variance[j] + ratio * ratio * beam.variance[j]) /
                    (beam.value[j] * beam.value[j]);
    }
    result.sigma = std::max(std::hypot(std::sqrt(variance), options.relative_floor * result.value),
                            least_sigma);
    return result;
}

}  // namespace

LobeScan reduce_lobe_readings(const std::vector<LobeReading>& readings,
                              const SpectrometerInfo& spectrometer, const ReductionOptions& options,
                              double detector_solid_angle_sr, double detector_half_angle_deg,
                              std::vector<std::string>* warnings) {
    const std::vector<double>& nm = spectrometer.wavelength_nm;
    const std::vector<double>& polynomial = spectrometer.nonlinearity;
    for (const LobeReading& reading : readings) check(reading, nm.size());
    size_t visits = 0;
    const LampDrift lamp = lamp_drift(readings, nm, polynomial, &visits);
    std::map<Position, Pair> pairs;
    for (const LobeReading& reading : readings) {
        const bool beam = reading.incidence_deg == straight;
        const Position position{reading.incidence_deg, beam ? 0 : reading.offset_deg};
        pairs.try_emplace(position, nm.size())
            .first->second.add_reading(reading, polynomial, lamp.at(reading.step.time_s));
    }
    struct Fluxes {
        Rates s, p;
    };
    std::map<Position, Fluxes> positions;
    for (auto& [position, pair] : pairs) {
        if (!pair.has[0] || !pair.has[1]) {
            user_error("the lobe scan has no reading along {} {}, expected both s and p",
                       pair.has[1] ? "p" : "s", position_name(position));
        }
        pair.finish_both();
        positions.emplace(position, Fluxes{pair.flux(true), pair.flux(false)});
    }
    const auto beam = positions.find({straight, 0});
    if (beam == positions.end()) {
        user_error(
            "the lobe scan has no straight-through reading, to which reflectances are "
            "ratios");
    }
    LobeScan scan;
    scan.detector_solid_angle_sr = detector_solid_angle_sr;
    scan.detector_half_angle_deg = detector_half_angle_deg;
    scan.header.emplace_back(
        "straight_through",
        fmt::format("{} {}, between which the lamp changed by {:.2g} % at most (interpolated)",
                    visits, visits == 1 ? "reading" : "readings", 100 * lamp.largest_change()));
    scan.header.emplace_back(
        "sigma_relative_floor",
        fmt::format("{} (of each reflectance, in sigma_s and sigma_p: what azimuths and linearity "
                    "leave)",
                    format_double(options.relative_floor)));
    std::map<Position, int> left_out;
    for (const double centre : bin_centres(options)) {
        for (const auto& [position, flux] : positions) {
            if (position.incidence_deg == straight) continue;
            const Ratio s = ratio_in_bin(flux.s, beam->second.s, nm, centre, options);
            const Ratio p = ratio_in_bin(flux.p, beam->second.p, nm, centre, options);
            if (!s.usable || !p.usable) {
                ++left_out[position];
                continue;
            }
            LobeScanRow row;
            row.wavelength_nm = centre;
            row.angle_deg = position.incidence_deg;
            row.offset_deg = position.offset_deg;
            row.reflectance_s = s.value;
            row.reflectance_p = p.value;
            row.sigma_s = s.sigma;
            row.sigma_p = p.sigma;
            scan.rows.push_back(row);
        }
    }
    for (const auto& [position, count] : left_out) {
        warnings->push_back(fmt::format(
            "{}: {} {} left out: no pixel is usable there and in the straight beam (dark or "
            "saturated)",
            position_name(position), count, count == 1 ? "bin" : "bins"));
    }
    if (scan.rows.empty()) {
        throw Error(Cause::answer_is_no,
                    fmt::format("no reflectance follows from the lobe readings: {}",
                                warnings->empty() ? "there is none with a sample"
                                                  : fmt::format("{}", fmt::join(*warnings, "; "))));
    }
    scan.check();
    return scan;
}

}  // namespace drude
