#include "device/signal/lobe_reduction.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "base/numbers.h"
#include "device/signal/harmonic_fit.h"
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
    if (!(reading.incidence_deg > 0 && reading.incidence_deg <= straight)) {
        user_error(
            "found a lobe reading at {} degrees of incidence, expected one above 0 and "
            "below 90, or 90 for the straight beam",
            format_double(reading.incidence_deg));
    }
}

void add(const LobeReading& reading, const std::vector<double>& polynomial, Rates* rates) {
    for (size_t j = 0; j < rates->value.size(); ++j) {
        if (reading.step.saturated[j]) continue;
        const LinearCounts linear =
            linear_counts(reading.step.counts[j] - reading.dark[j], polynomial);
        if (!std::isfinite(linear.value)) continue;
        const double scale = linear.slope / reading.integration_s;
        rates->value[j] += linear.value / reading.integration_s;
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

struct Ratio {
    bool usable = false;
    double value = 0, sigma = 0;
};

Ratio ratio_in_bin(const Rates& rates, const Rates& beam, const std::vector<double>& nm,
                   double centre, double step) {
    std::vector<double> weights(nm.size(), 0);
    for (size_t j = 0; j < nm.size(); ++j) {
        const double signal = beam.value[j];
        const bool lit = beam.readings[j] > 0 && signal > 0 &&
                         signal > least_signal * std::sqrt(beam.variance[j]);
        // Not the inverse of the reading's own variance: that of few counts goes with the counts,
        // and would count low readings for more.
        if (lit && rates.readings[j] > 0) weights[j] = signal * signal;
    }
    const BinShares shares = bin_shares(nm, weights, centre, step);
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
    result.sigma = std::max(std::sqrt(variance), least_sigma);
    return result;
}

}  // namespace

LobeScan reduce_lobe_readings(const std::vector<LobeReading>& readings,
                              const SpectrometerInfo& spectrometer, const ReductionOptions& options,
                              double detector_solid_angle_sr, double detector_half_angle_deg,
                              std::vector<std::string>* warnings) {
    const std::vector<double>& nm = spectrometer.wavelength_nm;
    struct Pair {
        Rates s, p;
        bool has_s = false, has_p = false;
    };
    std::map<Position, Pair> positions;
    for (const LobeReading& reading : readings) {
        check(reading, nm.size());
        const bool beam = reading.incidence_deg == straight;
        const auto place =
            positions.try_emplace({reading.incidence_deg, beam ? 0 : reading.offset_deg},
                                  Pair{Rates(nm.size()), Rates(nm.size()), false, false});
        Pair& pair = place.first->second;
        add(reading, spectrometer.nonlinearity, reading.s_polarised ? &pair.s : &pair.p);
        (reading.s_polarised ? pair.has_s : pair.has_p) = true;
    }
    for (auto& [position, pair] : positions) {
        if (!pair.has_s || !pair.has_p) {
            user_error("the lobe scan has no reading along {} {}, expected both s and p",
                       pair.has_s ? "p" : "s", position_name(position));
        }
        finish(&pair.s);
        finish(&pair.p);
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
    std::map<Position, int> left_out;
    for (const double centre : bin_centres(options)) {
        for (const auto& [position, pair] : positions) {
            if (position.incidence_deg == straight) continue;
            const Ratio s = ratio_in_bin(pair.s, beam->second.s, nm, centre, options.step_nm);
            const Ratio p = ratio_in_bin(pair.p, beam->second.p, nm, centre, options.step_nm);
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
