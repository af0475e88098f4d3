#include "device/signal/block_solver.h"

#include <algorithm>
#include <cmath>

#include "materials/scalar.h"

namespace drude {

namespace {

void multiply(const LeastSquares& factor, int columns, const std::vector<double>& y, Lane* result) {
    for (int i = 0; i < columns; ++i) {
        Lane sum = {};
        const double* inverse = &factor.inverse[i * factor.rows];
        for (size_t k = 0; k < factor.rows; ++k) {
            for (int l = 0; l < lanes; ++l) sum[l] += inverse[k] * y[k * lanes + l];
        }
        std::copy(sum, sum + lanes, result[i]);
    }
}

// By how much the noise of the 2P harmonic, in its worst direction, is above that which as many
// even steps give: what the model lacks grows as noise does.
double noise_growth(const LeastSquares& factor, const std::vector<double>& weights) {
    const double* cosine = &factor.inverse[cos_2p * factor.rows];
    const double* sine = &factor.inverse[sin_2p * factor.rows];
    double aa = 0, ab = 0, bb = 0, count = 0;
    for (size_t k = 0; k < factor.rows; ++k) {
        if (!(weights[k] > 0)) continue;
        aa += cosine[k] * cosine[k];
        ab += cosine[k] * sine[k];
        bb += sine[k] * sine[k];
        count += 1;
    }
    return std::sqrt(((aa + bb) / 2 + std::hypot((aa - bb) / 2, ab)) * count / 2);
}

// A gap of a third of the azimuths comes to 3.4 with the 4P harmonic, one of half of them to 16.
constexpr double most_growth = 4;

}  // namespace

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
    if (factors.usable) {
        factors.usable = noise_growth(steps.drift ? factors.timed : factors.plain,
                                      factors.weights) <= most_growth;
    }
    return factors;
}

BlockSolver::BlockSolver(const Steps& steps)
    : steps_(steps),
      drift_column_(steps.design.size() * lanes),
      column_(drift_column_),
      y_(drift_column_),
      v_(drift_column_) {}

void BlockSolver::solve(const Factors& factors, const Block& block, int used, BlockFit* fit,
                        AzimuthEvidence* evidence) {
    const size_t rows = steps_.design.size();
    const int m = steps_.columns;
    y_ = block.y;
    v_ = block.variance;
    // What has no weight may be anything, but it has to be a number.
    for (size_t k = 0; k < rows; ++k) {
        if (factors.weights[k] > 0) continue;
        std::fill_n(&y_[k * lanes], lanes, 0.0);
        std::fill_n(&v_[k * lanes], lanes, 0.0);
    }
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

// The lamp multiplies, so its column is the time times the signal. A first fit with the time
// alone gives nearly all of the drift, which is divided out, and the signal's shape; what is
// left of the drift then stands in a column that is right but for products of small numbers.
void BlockSolver::remove_drift(const Factors& factors, Lane& drift) {
    const size_t rows = steps_.design.size();
    const int m = steps_.columns;
    Lane c[most_columns] = {};
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

void BlockSolver::propagate(const Factors& factors, const Lane* projected, const Lane& length,
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

void BlockSolver::residuals(const Factors& factors, const Lane& length, const Lane& amount,
                            int used, BlockFit* fit, AzimuthEvidence* evidence) const {
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

}  // namespace drude
