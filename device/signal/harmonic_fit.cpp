#include "device/signal/harmonic_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "base/error.h"
#include "base/numbers.h"

namespace drude {

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr int lanes = 8;  // pixels that are worked on side by side
constexpr int cos_2p = 1, sin_2p = 2, cos_4p = 3, sin_4p = 4;
// Mean intensity over its standard deviation below which a pixel is taken for dark.
constexpr double least_signal = 5;

using Lane = double[lanes];

struct Steps {
    std::vector<DesignRow> design;  // 1, cos 2P, sin 2P[, cos 4P, sin 4P], then the time
    std::vector<double> time;       // -1/2 to 1/2
    int columns = 3;                // without that of the time
    bool drift = false;
};

int distinct_azimuths(const std::vector<double>& radians, const std::vector<double>& weights) {
    std::vector<double> folded;
    for (size_t k = 0; k < radians.size(); ++k) {
        if (weights[k] > 0) folded.push_back(radians[k] - pi * std::floor(radians[k] / pi));
    }
    std::sort(folded.begin(), folded.end());
    // Mounts repeat to some hundredths of a degree: nearer than 0.2 is the same azimuth again.
    constexpr double same = 0.2 * degree;
    int count = 0;
    double last = -1;
    for (const double azimuth : folded) {
        if (count > 0 && azimuth - last < same) continue;
        if (count > 0 && azimuth > folded.front() + pi - same) continue;
        ++count;
        last = azimuth;
    }
    return count;
}

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

// Factorisations of one set of steps: without and, where a drift is fitted, with the time.
struct Factors {
    bool usable = false;
    std::vector<double> weights;
    LeastSquares plain, timed;
};

Factors make_factors(const Steps& steps, const std::vector<double>& radians,
                     std::vector<double> weights) {
    Factors factors;
    factors.weights = std::move(weights);
    factors.usable = distinct_azimuths(radians, factors.weights) >= steps.columns &&
                     factorise(steps.design, factors.weights, steps.columns, &factors.plain);
    if (factors.usable && steps.drift) {
        factors.usable =
            factorise(steps.design, factors.weights, steps.columns + 1, &factors.timed);
    }
    return factors;
}

// The readings of some pixels: linear, without the source's polarisation.
struct Block {
    std::vector<double> y, variance;  // [step][lane]
};

struct BlockFit {
    Lane coefficient[5];
    Lane drift, residual;  // residual: mean square over its expectation
    Lane var_intensity, var_alpha, cov, var_beta, var_harmonic;
};

// The step's own share of what the residuals of all pixels say of its azimuth.
struct AzimuthEvidence {
    std::vector<double> pull, weight;
};

class BlockSolver {
  public:
    BlockSolver(const Steps& steps, size_t rows)
        : steps_(steps),
          drift_column_(rows * lanes),
          column_(rows * lanes),
          y_(rows * lanes),
          v_(rows * lanes) {}

    // `evidence` gets what lanes [0, used) say; nullptr: nothing.
    void solve(const Factors& factors, const Block& block, int used, BlockFit* fit,
               AzimuthEvidence* evidence) {
        const size_t rows = steps_.design.size();
        const int m = steps_.columns;
        y_ = block.y;
        v_ = block.variance;
        Lane first_drift = {};
        if (steps_.drift) remove_drift(factors, first_drift);
        // Coefficients without the time's column, then the part of that column that the others do
        // not hold: x = <u, y> and c = B y - (B T) x.
        Lane projected[5] = {}, length = {}, amount = {};
        multiply(factors.plain, m, y_, fit->coefficient);
        if (steps_.drift) {
            multiply(factors.plain, m, drift_column_, projected);
            column_ = drift_column_;
            for (size_t k = 0; k < rows; ++k) {
                for (int l = 0; l < lanes; ++l) {
                    double& t = column_[k * lanes + l];
                    for (int i = 0; i < m; ++i) t -= steps_.design[k][i] * projected[i][l];
                    length[l] += factors.weights[k] * t * t;
                }
            }
            for (size_t k = 0; k < rows; ++k) {
                for (int l = 0; l < lanes; ++l) {
                    amount[l] += factors.weights[k] * column_[k * lanes + l] * y_[k * lanes + l];
                }
            }
            for (int l = 0; l < lanes; ++l) {
                amount[l] = length[l] > 0 ? amount[l] / length[l] : 0;
                for (int i = 0; i < m; ++i) fit->coefficient[i][l] -= projected[i][l] * amount[l];
                const double x = amount[l] / fit->coefficient[0][l];
                fit->drift[l] = (1 + first_drift[l]) * (1 + x) - 1;
            }
        }
        propagate(factors, projected, length, fit);
        residuals(factors, length, amount, used, fit, evidence);
    }

  private:
    static void multiply(const LeastSquares& factor, int columns, const std::vector<double>& y,
                         Lane* result) {
        for (int i = 0; i < columns; ++i) {
            Lane sum = {};
            const double* inverse = &factor.inverse[i * factor.rows];
            for (size_t k = 0; k < factor.rows; ++k) {
                for (int l = 0; l < lanes; ++l) sum[l] += inverse[k] * y[k * lanes + l];
            }
            std::copy(sum, sum + lanes, result[i]);
        }
    }

    // The lamp multiplies, so its column is the time times the signal. A first fit with the time
    // alone gives nearly all of the drift, which is divided out, and the signal's shape; what is
    // left of the drift then stands in a column that is right but for products of small numbers.
    void remove_drift(const Factors& factors, Lane& drift) {
        const size_t rows = steps_.design.size();
        const int m = steps_.columns;
        Lane c[most_columns];
        multiply(factors.timed, m + 1, y_, c);
        Lane inverse;
        for (int l = 0; l < lanes; ++l) {
            inverse[l] = 1 / c[0][l];
            drift[l] = std::clamp(c[m][l] * inverse[l], -0.9, 0.9);
            if (!std::isfinite(drift[l])) drift[l] = 0;
        }
        for (size_t k = 0; k < rows; ++k) {
            const double t = steps_.time[k];
            const DesignRow& row = steps_.design[k];
            for (int l = 0; l < lanes; ++l) {
                double shape = 0;
                for (int i = 0; i < m; ++i) shape += row[i] * c[i][l];
                drift_column_[k * lanes + l] = t * shape * inverse[l];
                const double lamp = 1 / (1 + drift[l] * t);
                y_[k * lanes + l] *= lamp;
                v_[k * lanes + l] *= lamp * lamp;
            }
        }
    }

    void propagate(const Factors& factors, const Lane* projected, const Lane& length,
                   BlockFit* fit) const {
        const size_t rows = steps_.design.size();
        const int m = steps_.columns;
        const double* b0 = &factors.plain.inverse[0];
        const double* b1 = b0 + cos_2p * rows;
        const double* b2 = b0 + sin_2p * rows;
        const double* b3 = m > cos_4p ? b0 + cos_4p * rows : nullptr;
        const double* b4 = m > cos_4p ? b0 + sin_4p * rows : nullptr;
        Lane alpha, beta, scale, vi = {}, aa = {}, ab = {}, bb = {}, hh = {}, over;
        for (int l = 0; l < lanes; ++l) {
            scale[l] = 1 / fit->coefficient[0][l];
            alpha[l] = fit->coefficient[cos_2p][l] * scale[l];
            beta[l] = fit->coefficient[sin_2p][l] * scale[l];
            over[l] = length[l] > 0 ? 1 / length[l] : 0;
        }
        for (size_t k = 0; k < rows; ++k) {
            for (int l = 0; l < lanes; ++l) {
                const double u =
                    steps_.drift ? factors.weights[k] * column_[k * lanes + l] * over[l] : 0.0;
                const double i0 = b0[k] - projected[0][l] * u;
                const double a = (b1[k] - projected[cos_2p][l] * u) - alpha[l] * i0;
                const double b = (b2[k] - projected[sin_2p][l] * u) - beta[l] * i0;
                const double v = v_[k * lanes + l];
                vi[l] += i0 * i0 * v;
                aa[l] += a * a * v;
                ab[l] += a * b * v;
                bb[l] += b * b * v;
                if (b3) hh[l] += (b3[k] * b3[k] + b4[k] * b4[k]) * v;
            }
        }
        for (int l = 0; l < lanes; ++l) {
            const double s2 = scale[l] * scale[l];
            fit->var_intensity[l] = vi[l];
            fit->var_alpha[l] = aa[l] * s2;
            fit->cov[l] = ab[l] * s2;
            fit->var_beta[l] = bb[l] * s2;
            fit->var_harmonic[l] = hh[l] * s2;
        }
    }

    void residuals(const Factors& factors, const Lane& length, const Lane& amount, int used,
                   BlockFit* fit, AzimuthEvidence* evidence) const {
        const size_t rows = steps_.design.size();
        Lane square = {}, expected = {};
        for (size_t k = 0; k < rows; ++k) {
            const DesignRow& row = steps_.design[k];
            const double w = factors.weights[k];
            for (int l = 0; l < lanes; ++l) {
                const double t = steps_.drift ? column_[k * lanes + l] : 0.0;
                double model = 0;
                for (int i = 0; i < steps_.columns; ++i) {
                    model += row[i] * fit->coefficient[i][l];
                }
                if (steps_.drift) model += amount[l] * drift_column_[k * lanes + l];
                const double r = y_[k * lanes + l] - model;
                const double v = v_[k * lanes + l];
                const double share =
                    factors.plain.leverage[k] + (length[l] > 0 ? w * t * t / length[l] : 0);
                square[l] += w * r * r;
                expected[l] += w * std::max(0.0, 1 - share) * v;
                if (!evidence || l >= used) continue;
                const double c0 = fit->coefficient[0][l];
                const double slope = 2 * (fit->coefficient[sin_2p][l] * row[cos_2p] -
                                          fit->coefficient[cos_2p][l] * row[sin_2p]);
                const double floor = std::max(v, 1e-14 * c0 * c0);
                if (!(c0 > 0 && std::isfinite(r))) continue;
                evidence->pull[k] += r * slope / floor;
                evidence->weight[k] += slope * slope / floor;
            }
        }
        for (int l = 0; l < lanes; ++l) {
            fit->residual[l] = expected[l] > 0 ? square[l] / expected[l] : 0;
        }
    }

    const Steps& steps_;
    // The drift's column, and what of it the other columns do not hold.
    std::vector<double> drift_column_, column_, y_, v_;
};

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
                Block* block, std::vector<uint8_t>* mask) {
    bool saturated = false;
    for (size_t k = 0; k < scan.steps.size(); ++k) {
        const ScanStep& step = scan.steps[k];
        const LinearCounts linear = linear_counts(step.counts[j] - scan.dark[j], polynomial);
        const double source = 1 / (1 - s1 * design[k][cos_2p] - s2 * design[k][sin_2p]);
        const double slope = linear.slope * source;
        block->y[k * lanes + l] = linear.value * source;
        block->variance[k * lanes + l] = step.variance[j] * slope * slope;
        (*mask)[k] = step.saturated[j];
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

    BlockSolver solver(steps, rows);
    AzimuthEvidence evidence{std::vector<double>(rows, 0), std::vector<double>(rows, 0)};
    Block block{std::vector<double>(rows * lanes, 0), std::vector<double>(rows * lanes, 0)};
    Block single = block;
    std::vector<uint8_t> mask(rows);
    std::map<std::vector<uint8_t>, Factors> masked;
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
        result.quality.saturated += static_cast<int>(std::count(mask.begin(), mask.end(), 1));
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
