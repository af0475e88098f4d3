#include "device/signal/harmonic_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "base/error.h"
#include "base/numbers.h"
#include "device/signal/block_solver.h"
#include "materials/scalar.h"

namespace drude {

namespace {

constexpr double degree = pi / 180;
// Mean intensity over its standard deviation below which a pixel is taken for dark.
constexpr double least_signal = 5;

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

}  // namespace

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

// Fills lane l of the block with the readings of pixel j and returns whether one was saturated;
// `mask` gets 1 for those.
bool load_pixel(const Scan& scan, const std::vector<double>& polynomial,
                const std::vector<DesignRow>& design, double s1, double s2, size_t j, int l,
                Block* block, std::string* mask) {
    bool saturated = false;
    for (size_t k = 0; k < scan.steps.size(); ++k) {
        const ScanStep& step = scan.steps[k];
        const LinearCounts linear = linear_counts(step.counts[j] - scan.dark[j], polynomial);
        const double source = 1 / (1 - s1 * design[k][cos_2p] - s2 * design[k][sin_2p]);
        const double slope = linear.slope * source;
        block->y[k * lanes + l] = linear.value * source;
        block->variance[k * lanes + l] = step.variance[j] * slope * slope;
        (*mask)[k] = step.saturated[j] ? '\1' : '\0';
        saturated = saturated || step.saturated[j];
    }
    return saturated;
}

struct Sums {
    double count = 0, harmonic = 0, drift = 0, residual = 0;
};

// Keeps what lane l says of pixel j, where it is no dark pixel.
void store_pixel(const BlockFit& fit, int l, int columns, double dark_variance, size_t j,
                 ScanFit* result, Sums* sums) {
    const double intensity = fit.coefficient[0][l];
    const double noise = std::sqrt(fit.var_intensity[l] + dark_variance);
    if (!(intensity > 0 && intensity > least_signal * noise)) return;
    const double alpha = fit.coefficient[cos_2p][l] / intensity;
    const double beta = fit.coefficient[sin_2p][l] / intensity;
    if (!std::isfinite(alpha + beta + fit.var_alpha[l] + fit.var_beta[l])) return;
    result->valid[j] = 1;
    result->alpha[j] = alpha;
    result->beta[j] = beta;
    result->var_alpha[j] = fit.var_alpha[l];
    result->cov_alpha_beta[j] = fit.cov[l];
    result->var_beta[j] = fit.var_beta[l];
    result->intensity[j] = intensity;
    // A dark that is too high takes as much from every step, which is the constant's column.
    const double dark = std::sqrt(dark_variance) / intensity;
    result->dark_alpha[j] = alpha * dark;
    result->dark_beta[j] = beta * dark;
    sums->count += 1;
    sums->drift += fit.drift[l];
    sums->residual += fit.residual[l];
    if (columns > cos_4p) {
        const double c = fit.coefficient[cos_4p][l] / intensity;
        const double s = fit.coefficient[sin_4p][l] / intensity;
        sums->harmonic += c * c + s * s - fit.var_harmonic[l];
    }
}

double jitter_deg(const AzimuthEvidence& evidence, const LeastSquares& factor) {
    double square = 0, freedom = 0, weight = 0;
    for (size_t k = 0; k < evidence.pull.size(); ++k) {
        const double left = 1 - factor.leverage[k];
        if (!(evidence.weight[k] > 0)) continue;
        square += evidence.pull[k] * evidence.pull[k] / evidence.weight[k];
        freedom += left;
        weight += evidence.weight[k] * left;
    }
    return weight > 0 ? std::sqrt(std::max(0.0, square - freedom) / weight) / degree : 0;
}

}  // namespace

ScanFit fit_scan(const Scan& scan, const SpectrometerInfo& spectrometer,
                 const Calibration& calibration, const ReductionOptions& options,
                 std::vector<std::string>* warnings) {
    check_sizes(scan, spectrometer);
    const std::vector<double>& nm = spectrometer.wavelength_nm;
    const size_t pixels = nm.size(), rows = scan.steps.size();
    ScanFit result;
    result.valid.assign(pixels, 0);
    for (std::vector<double>* column :
         {&result.alpha, &result.beta, &result.var_alpha, &result.cov_alpha_beta, &result.var_beta,
          &result.dark_alpha, &result.dark_beta, &result.intensity}) {
        column->assign(pixels, 0);
    }
    for (const ScanStep& step : scan.steps) {
        result.polariser_rad.push_back((step.polariser_deg - calibration.polariser_offset_deg) *
                                       degree);
    }
    Steps steps = make_steps(scan, result.polariser_rad, options);
    const auto first = static_cast<size_t>(
        std::lower_bound(nm.begin(), nm.end(), options.first_nm - options.step_nm / 2) -
        nm.begin());
    const auto last = static_cast<size_t>(
        std::upper_bound(nm.begin(), nm.end(), options.last_nm + options.step_nm / 2) - nm.begin());
    const std::vector<double> weights = step_weights(scan, first, last);
    const int distinct = distinct_azimuths(result.polariser_rad, weights);
    if (distinct < steps.columns) {
        user_error(
            "the scan {} has {} distinct azimuths of the polariser (modulo 180 degrees), expected "
            "{} or more{}",
            scan_name(scan), distinct, steps.columns,
            options.harmonic_4 ? "; without the 4P harmonic 3 would do" : "");
    }
    Factors shared = make_factors(steps, result.polariser_rad, weights);
    if (!shared.usable && steps.drift) {
        warnings->push_back(fmt::format(
            "scan {}: no drift of the lamp is fitted, its {} steps do not hold one beside the "
            "signal",
            scan_name(scan), rows));
        steps.drift = false;
        shared = make_factors(steps, result.polariser_rad, weights);
    }
    if (!shared.usable) {
        user_error(
            "the scan {} has azimuths of the polariser from which the signal does not "
            "follow; spread the steps evenly",
            scan_name(scan));
    }

    BlockSolver solver(steps);
    AzimuthEvidence evidence{std::vector<double>(rows, 0), std::vector<double>(rows, 0)};
    Block block{std::vector<double>(rows * lanes, 0), std::vector<double>(rows * lanes, 0)};
    Block single = block;
    std::string mask(rows, '\0');  // of saturated steps
    std::map<std::string, Factors> masked;
    size_t members[lanes] = {};
    int used = 0;
    Sums sums;
    const auto flush = [&] {
        if (used == 0) return;
        BlockFit fit = {};
        solver.solve(shared, block, used, &fit, &evidence);
        for (int l = 0; l < used; ++l) {
            store_pixel(fit, l, steps.columns, scan.dark_variance[members[l]], members[l], &result,
                        &sums);
        }
        used = 0;
    };
    for (size_t j = first; j < last; ++j) {
        const double s1 = calibration.source_s1.at(nm[j], 0);
        const double s2 = calibration.source_s2.at(nm[j], 0);
        if (!load_pixel(scan, spectrometer.nonlinearity, steps.design, s1, s2, j, used, &block,
                        &mask)) {
            members[used++] = j;
            if (used == lanes) flush();
            continue;
        }
        // Neighbours are saturated at the same steps as a rule, so there are few masks.
        auto found = masked.find(mask);
        if (found == masked.end()) {
            std::vector<double> left = weights;
            for (size_t k = 0; k < rows; ++k) {
                if (mask[k]) left[k] = 0;
            }
            found = masked.emplace(mask, make_factors(steps, result.polariser_rad, left)).first;
        }
        result.quality.saturated += static_cast<int>(std::count(mask.begin(), mask.end(), '\1'));
        if (!found->second.usable) continue;
        for (size_t k = 0; k < rows; ++k) {
            // A saturated reading has no weight, but it has to be a number.
            const bool out = mask[k] != 0;
            std::fill_n(&single.y[k * lanes], lanes, out ? 0 : block.y[k * lanes + used]);
            std::fill_n(&single.variance[k * lanes], lanes,
                        out ? 0 : block.variance[k * lanes + used]);
        }
        BlockFit fit = {};
        solver.solve(found->second, single, 1, &fit, nullptr);
        store_pixel(fit, 0, steps.columns, scan.dark_variance[j], j, &result, &sums);
    }
    flush();

    result.quality.incidence_deg = scan.incidence_deg;
    result.quality.analyser_deg = scan.analyser_deg;
    result.quality.retarder_in = scan.retarder_in;
    if (sums.count > 0) {
        result.quality.harmonic_4 = std::sqrt(std::max(0.0, sums.harmonic / sums.count));
        result.quality.drift = sums.drift / sums.count;
        result.quality.residual_over_noise = std::sqrt(sums.residual / sums.count);
        result.quality.step_jitter_deg = jitter_deg(evidence, shared.plain);
    }
    result.factor = std::move(steps.drift ? shared.timed : shared.plain);
    return result;
}

}  // namespace drude
