#include "device/signal/harmonic_fit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "base/error.h"
#include "base/numbers.h"
#include "device/signal/block_solver.h"
#include "device/signal/scan_readings.h"
#include "materials/scalar.h"

namespace drude {

namespace {

// Mean intensity over its standard deviation below which a pixel is taken for dark.
constexpr double least_signal = 5;

// The steps at which pixel j is saturated, as bytes.
std::string saturation_mask(const Scan& scan, size_t j) {
    std::string mask(scan.steps.size(), '\0');
    for (size_t k = 0; k < mask.size(); ++k) mask[k] = scan.steps[k].saturated[j] ? '\1' : '\0';
    return mask;
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
    std::map<std::string, Factors> masked;
    Sums sums;
    for (size_t j = first; j < last; j += lanes) {
        const int used = static_cast<int>(std::min<size_t>(lanes, last - j));
        const auto keep = [&](const BlockFit& fit, int l) {
            store_pixel(fit, l, steps.columns, scan.dark_variance[j + l], j + l, &result, &sums);
        };
        BlockFit fit = {};
        if (!load_block(scan, spectrometer.nonlinearity, calibration, nm, steps.design, j, used,
                        &block)) {
            solver.solve(shared, block, used, &fit, &evidence);
            for (int l = 0; l < used; ++l) keep(fit, l);
            continue;
        }
        // Neighbours are saturated at the same steps as a rule: a block is solved once for each of
        // its few masks.
        std::string solved;
        bool usable = false;
        for (int l = 0; l < used; ++l) {
            const std::string mask = saturation_mask(scan, j + l);
            result.quality.saturated +=
                static_cast<int>(std::count(mask.begin(), mask.end(), '\1'));
            if (mask != solved) {
                auto found = masked.find(mask);
                if (found == masked.end()) {
                    std::vector<double> left = weights;
                    for (size_t k = 0; k < rows; ++k) left[k] = mask[k] ? 0 : left[k];
                    found = masked
                                .emplace(mask,
                                         make_factors(steps, result.polariser_rad, std::move(left)))
                                .first;
                }
                usable = found->second.usable;
                if (usable) solver.solve(found->second, block, used, &fit, nullptr);
                solved = mask;
            }
            if (usable) keep(fit, l);
        }
    }

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
