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

// A pixel is at the bin's centre where it is as near as this, in half steps.
constexpr double at_centre = 1e-3;
// Of the value's variance over that of the mean, with equal pixels: a parabola over even pixels has
// 9/4, over three of them 3; pixels that stand on one side or leave the middle free have more.
constexpr double most_variance = 3.5;

// Shares by which a polynomial fitted to values at x has its value at 0. False where the points do
// not hold it, or its variance is above that bound.
bool polynomial_shares(const std::vector<double>& x, const std::vector<double>& weight, int degree,
                       std::vector<double>* share) {
    const int n = degree + 1;
    if (x.size() < static_cast<size_t>(n)) return false;
    double moments[9] = {}, at_zero[3] = {1, 0, 0}, sum = 0;
    for (size_t i = 0; i < x.size(); ++i) {
        const double power[3] = {1, x[i], x[i] * x[i]};
        for (int a = 0; a < n; ++a) {
            for (int b = 0; b < n; ++b) moments[a * n + b] += weight[i] * power[a] * power[b];
        }
        sum += weight[i];
    }
    if (!solve_normal_equations(n, moments, at_zero)) return false;
    share->resize(x.size());
    double variance = 0;
    for (size_t i = 0; i < x.size(); ++i) {
        const double factor =
            at_zero[0] + (n > 1 ? at_zero[1] * x[i] : 0) + (n > 2 ? at_zero[2] * x[i] * x[i] : 0);
        (*share)[i] = weight[i] * factor;
        variance += weight[i] * factor * factor;
    }
    return variance * sum <= most_variance;
}

// Pixels of a bin: numbers, places in half steps from its centre, weights.
struct BinPixels {
    std::vector<size_t> pixel;
    std::vector<double> x, weight;

    void add(size_t j, double at, double w) {
        pixel.push_back(j);
        x.push_back(at);
        weight.push_back(w);
    }
};

// Those that lie as far from the centre as there are some on both sides, one `spacing` more or
// less; none where a side has none. So what the parabola leaves out, which is odd about the centre
// before all else, averages out whatever was lost.
BinPixels around_centre(const BinPixels& all, double spacing) {
    BinPixels kept;
    if (all.x.empty() || all.x.front() > at_centre || all.x.back() < -at_centre) return kept;
    const double reach = std::max(0.0, std::min(-all.x.front(), all.x.back()));
    for (size_t i = 0; i < all.x.size(); ++i) {
        if (std::abs(all.x[i]) > reach + spacing * (1 + at_centre)) continue;
        kept.add(all.pixel[i], all.x[i], all.weight[i]);
    }
    return kept;
}

void scale(Covariance* covariance, double factor) {
    covariance->aa *= factor;
    covariance->ab *= factor;
    covariance->bb *= factor;
}

}  // namespace

BinShares bin_shares(const std::vector<double>& wavelength_nm, const std::vector<double>& weights,
                     double centre_nm, double step_nm) {
    const auto first =
        std::lower_bound(wavelength_nm.begin(), wavelength_nm.end(), centre_nm - step_nm / 2) -
        wavelength_nm.begin();
    auto j = static_cast<size_t>(first);
    const double half = step_nm / 2;
    size_t pixels = 0;
    BinPixels all;
    for (; j < wavelength_nm.size() && wavelength_nm[j] < centre_nm + half; ++j, ++pixels) {
        if (weights[j] > 0) all.add(j, (wavelength_nm[j] - centre_nm) / half, weights[j]);
    }
    const auto begin = static_cast<size_t>(first);
    const double spacing = pixels < 2 ? 0
                                      : (wavelength_nm[j - 1] - wavelength_nm[begin]) / half /
                                            static_cast<double>(pixels - 1);
    BinPixels used = around_centre(all, spacing);
    // What a bin is wide enough for is a matter of its pixels, not of those that are left.
    const int degree = pixels >= 5 ? 2 : 1;
    BinShares result;
    if (polynomial_shares(used.x, used.weight, degree, &result.share) ||
        // Weights that fall steeply count one side only.
        polynomial_shares(used.x, std::vector<double>(used.x.size(), 1), degree, &result.share)) {
        result.pixel = std::move(used.pixel);
        return result;
    }
    result.share.clear();
    for (size_t i = 0; i < all.x.size(); ++i) {
        if (std::abs(all.x[i]) > at_centre || !result.pixel.empty()) continue;
        result.pixel.push_back(all.pixel[i]);
        result.share.push_back(1);
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
