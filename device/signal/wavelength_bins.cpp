#include "device/signal/wavelength_bins.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/numbers.h"

namespace drude {

namespace {

// Azimuth errors d_k of the steps move the readings by I'(P_k) d_k and the coefficients by the
// pseudo-inverse times that: all wavelengths of one shape together.
Covariance jitter_covariance(const ScanFit& fit, double alpha, double beta) {
    const LeastSquares& factor = fit.factor;
    const double *b0 = &factor.inverse[0], *b1 = b0 + factor.rows, *b2 = b1 + factor.rows;
    Covariance sum;
    for (size_t k = 0; k < factor.rows; ++k) {
        const double p = 2 * fit.polariser_rad[k];
        const double slope = 2 * (beta * std::cos(p) - alpha * std::sin(p));
        const double a = (b1[k] - alpha * b0[k]) * slope, b = (b2[k] - beta * b0[k]) * slope;
        sum.aa += a * a;
        sum.ab += a * b;
        sum.bb += b * b;
    }
    return sum;
}

void scale(Covariance* covariance, double factor) {
    covariance->aa *= factor;
    covariance->ab *= factor;
    covariance->bb *= factor;
}

}  // namespace

BinShares bin_shares(const std::vector<double>& wavelength_nm, const std::vector<double>& weights,
                     double centre_nm, double step_nm) {
    BinShares result;
    const auto first =
        std::lower_bound(wavelength_nm.begin(), wavelength_nm.end(), centre_nm - step_nm / 2) -
        wavelength_nm.begin();
    double s0 = 0, s1 = 0, s2 = 0;
    for (auto j = static_cast<size_t>(first);
         j < wavelength_nm.size() && wavelength_nm[j] < centre_nm + step_nm / 2; ++j) {
        if (!(weights[j] > 0)) continue;
        const double x = wavelength_nm[j] - centre_nm;
        result.pixel.push_back(j);
        result.share.push_back(weights[j]);
        s0 += weights[j];
        s1 += weights[j] * x;
        s2 += weights[j] * x * x;
    }
    const double mean = s1 / s0, spread = s2 / s0 - mean * mean;
    // Reading the line outside its middle half costs noise; a bin that is cut off keeps its mean.
    const bool line = result.pixel.size() >= 4 && mean * mean < 0.25 * spread;
    for (size_t i = 0; i < result.pixel.size(); ++i) {
        const double x = wavelength_nm[result.pixel[i]] - centre_nm;
        result.share[i] *= line ? (1 - mean * (x - mean) / spread) / s0 : 1 / s0;
    }
    return result;
}

std::vector<double> bin_centres(const ReductionOptions& options) {
    const double first = options.first_nm, last = options.last_nm, step = options.step_nm;
    if (!(first > 0 && last >= first && step > 0 && std::isfinite(last)) ||
        (last - first) / step > 1e5) {
        user_error(
            "found bins from {} to {} nm by {} nm, expected a positive range and a step of which "
            "at most 100000 fit into it",
            format_double(first), format_double(last), format_double(step));
    }
    const auto count = static_cast<int>(std::floor((last - first) / step + 1e-9)) + 1;
    std::vector<double> centres;
    for (int i = 0; i < count; ++i) centres.push_back(first + i * step);
    return centres;
}

std::vector<BinnedFit> bin_fit(const ScanFit& fit, const SpectrometerInfo& spectrometer,
                               const Calibration& calibration, const ReductionOptions& options) {
    const std::vector<double>& nm = spectrometer.wavelength_nm;
    std::vector<double> weights(nm.size(), 0);
    for (size_t j = 0; j < nm.size(); ++j) {
        // Noise of 1e-9 is below anything that is measured; it keeps weights finite without noise.
        if (fit.valid[j]) weights[j] = 1 / (fit.var_alpha[j] + fit.var_beta[j] + 1e-18);
    }
    std::vector<BinnedFit> bins;
    for (const double centre : bin_centres(options)) {
        const BinShares shares = bin_shares(nm, weights, centre, options.step_nm);
        BinnedFit bin;
        bin.usable = !shares.pixel.empty();
        double dark_alpha = 0, dark_beta = 0;
        for (size_t i = 0; i < shares.pixel.size(); ++i) {
            const size_t j = shares.pixel[i];
            const double w = shares.share[i];
            bin.alpha += w * fit.alpha[j];
            bin.beta += w * fit.beta[j];
            bin.noise.aa += w * w * fit.var_alpha[j];
            bin.noise.ab += w * w * fit.cov_alpha_beta[j];
            bin.noise.bb += w * w * fit.var_beta[j];
            dark_alpha += w * w * fit.dark_alpha[j] * fit.dark_alpha[j];
            dark_beta += w * w * fit.dark_beta[j] * fit.dark_beta[j];
        }
        // Of one bin's pixels alpha and beta are alike, so their darks act as one number would.
        bin.dark_alpha = std::copysign(std::sqrt(dark_alpha), bin.alpha);
        bin.dark_beta = std::copysign(std::sqrt(dark_beta), bin.beta);
        if (bin.usable) bin.jitter = jitter_covariance(fit, bin.alpha, bin.beta);
        const double depth = calibration.modulation_depth.at(centre, 1);
        bin.alpha /= depth;
        bin.beta /= depth;
        bin.dark_alpha /= depth;
        bin.dark_beta /= depth;
        scale(&bin.noise, 1 / (depth * depth));
        scale(&bin.jitter, 1 / (depth * depth));
        bins.push_back(bin);
    }
    return bins;
}

}  // namespace drude
