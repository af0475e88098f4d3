#include "device/signal/scan_readings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/numbers.h"

namespace drude {

std::string scan_name(const Scan& scan) {
    if (scan.incidence_deg == 90) {
        return fmt::format("straight through, analyser at {}{}", format_double(scan.analyser_deg),
                           scan.retarder_in ? ", with the retarder" : "");
    }
    return fmt::format("at {} degrees, analyser at {}{}", format_double(scan.incidence_deg),
                       format_double(scan.analyser_deg),
                       scan.retarder_in ? ", with the retarder" : "");
}

LinearCounts linear_counts(double counts_less_dark, const std::vector<double>& polynomial) {
    if (polynomial.empty()) return {counts_less_dark, 1};
    double value = 0, slope = 0;
    for (size_t i = polynomial.size(); i-- > 0;) {
        slope = slope * counts_less_dark + value;
        value = value * counts_less_dark + polynomial[i];
    }
    if (!(value > 0)) return {std::numeric_limits<double>::quiet_NaN(), 0};
    return {counts_less_dark / value, (value - counts_less_dark * slope) / (value * value)};
}

namespace {

// linear_counts() of a lane each.
void linearise(const std::vector<double>& polynomial, double* y, double* variance) {
    if (polynomial.empty()) return;
    Lane value = {}, slope = {};
    for (size_t i = polynomial.size(); i-- > 0;) {
        for (int l = 0; l < lanes; ++l) {
            slope[l] = slope[l] * y[l] + value[l];
            value[l] = value[l] * y[l] + polynomial[i];
        }
    }
    for (int l = 0; l < lanes; ++l) {
        const double positive = value[l] > 0 ? value[l] : std::numeric_limits<double>::quiet_NaN();
        const double derivative = (positive - y[l] * slope[l]) / (positive * positive);
        y[l] /= positive;
        variance[l] *= derivative * derivative;
    }
}

}  // namespace

void check_sizes(const Scan& scan, const SpectrometerInfo& spectrometer) {
    const size_t pixels = spectrometer.wavelength_nm.size();
    const auto check = [&](size_t found, const char* what) {
        if (found != pixels) {
            user_error("the scan {} has {} of {} pixels, expected {} as the spectrometer has",
                       scan_name(scan), what, found, pixels);
        }
    };
    check(scan.dark.size(), "a dark");
    check(scan.dark_variance.size(), "variances of the dark");
    for (const ScanStep& step : scan.steps) {
        check(step.counts.size(), "a step");
        check(step.variance.size(), "a step with variances");
        check(step.saturated.size(), "a step with saturation flags");
        if (!std::isfinite(step.polariser_deg) || !std::isfinite(step.time_s)) {
            user_error("the scan {} has a step at {} degrees and {} s, expected finite numbers",
                       scan_name(scan), format_double(step.polariser_deg),
                       format_double(step.time_s));
        }
    }
}

Steps make_steps(const Scan& scan, const std::vector<double>& radians,
                 const ReductionOptions& options) {
    Steps steps;
    steps.columns = options.harmonic_4 ? 5 : 3;
    const size_t count = scan.steps.size();
    double first = std::numeric_limits<double>::infinity(), last = -first;
    for (const ScanStep& step : scan.steps) {
        first = std::min(first, step.time_s);
        last = std::max(last, step.time_s);
    }
    steps.drift = options.drift && last > first;
    steps.time.assign(count, 0);
    steps.design.resize(count);
    for (size_t k = 0; k < count; ++k) {
        if (last > first) {
            steps.time[k] = (scan.steps[k].time_s - first) / (last - first) - 0.5;
        }
        const double p = radians[k];
        DesignRow& row = steps.design[k];
        row = {1, std::cos(2 * p), std::sin(2 * p), std::cos(4 * p), std::sin(4 * p), 0};
        row[steps.columns] = steps.time[k];
    }
    return steps;
}

std::vector<double> step_weights(const Scan& scan, size_t first_pixel, size_t last_pixel) {
    const size_t count = scan.steps.size();
    std::vector<double> relative(count, 0);
    for (size_t j = first_pixel; j < last_pixel; ++j) {
        double mean = 0;
        for (const ScanStep& step : scan.steps) mean += step.variance[j];
        mean /= static_cast<double>(count);
        if (!(mean > 0 && std::isfinite(mean))) continue;
        for (size_t k = 0; k < count; ++k) relative[k] += scan.steps[k].variance[j] / mean;
    }
    double sum = 0;
    for (const double r : relative) sum += r;
    std::vector<double> weights(count, 1);
    if (!(sum > 0)) return weights;
    const double mean = sum / static_cast<double>(count);
    for (size_t k = 0; k < count; ++k) {
        weights[k] = std::clamp(mean / std::max(relative[k], 1e-300), 0.25, 4.0);
    }
    return weights;
}

bool load_block(const Scan& scan, const std::vector<double>& polynomial, const Calibration& bench,
                const std::vector<double>& nm, const std::vector<DesignRow>& design, size_t j,
                int used, Block* block) {
    size_t pixel[lanes];
    Lane dark, s1, s2;
    for (int l = 0; l < lanes; ++l) {
        pixel[l] = j + static_cast<size_t>(std::min(l, used - 1));
        dark[l] = scan.dark[pixel[l]];
        s1[l] = bench.source_s1.at(nm[pixel[l]], 0);
        s2[l] = bench.source_s2.at(nm[pixel[l]], 0);
    }
    int saturated = 0;
    for (size_t k = 0; k < scan.steps.size(); ++k) {
        const ScanStep& step = scan.steps[k];
        const double c = design[k][cos_2p], s = design[k][sin_2p];
        double* y = &block->y[k * lanes];
        double* v = &block->variance[k * lanes];
        for (int l = 0; l < lanes; ++l) {
            y[l] = step.counts[pixel[l]] - dark[l];
            v[l] = step.variance[pixel[l]];
            saturated |= step.saturated[pixel[l]];
        }
        linearise(polynomial, y, v);
        for (int l = 0; l < lanes; ++l) {
            const double source = 1 / (1 - s1[l] * c - s2[l] * s);
            y[l] *= source;
            v[l] *= source * source;
        }
    }
    return saturated != 0;
}

}  // namespace drude
