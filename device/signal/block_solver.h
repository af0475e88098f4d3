// The least-squares fit of a scan's steps for some pixels side by side.
#pragma once

#include <vector>

#include "device/signal/small_least_squares.h"

namespace drude {

constexpr int lanes = 8;  // pixels that are worked on side by side
constexpr int cos_2p = 1, sin_2p = 2, cos_4p = 3, sin_4p = 4;

using Lane = double[lanes];

struct Steps {
    std::vector<DesignRow> design;  // 1, cos 2P, sin 2P[, cos 4P, sin 4P], then the time
    std::vector<double> time;       // -1/2 to 1/2
    int columns = 3;                // without that of the time
    bool drift = false;
};

// How many azimuths there are modulo 180 degrees among the steps whose weight is above 0.
int distinct_azimuths(const std::vector<double>& radians, const std::vector<double>& weights);

// Factorisations of one set of steps: without and, where a drift is fitted, with the time.
struct Factors {
    bool usable = false;
    std::vector<double> weights;
    LeastSquares plain, timed;
};

// `usable` is false where the steps do not hold all columns, or so badly (azimuths that leave a
// gap) that noise in the 2P harmonic is over four times that of as many even steps.
Factors make_factors(const Steps& steps, const std::vector<double>& radians,
                     std::vector<double> weights);

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
    // `steps` must outlive it.
    explicit BlockSolver(const Steps& steps);

    // Coefficients, their covariances from the readings' own variances, and residuals. `evidence`
    // gets what lanes [0, used) say; nullptr: nothing.
    void solve(const Factors& factors, const Block& block, int used, BlockFit* fit,
               AzimuthEvidence* evidence);

  private:
    void remove_drift(const Factors& factors, Lane& drift);
    void propagate(const Factors& factors, const Lane* projected, const Lane& length,
                   BlockFit* fit) const;
    void residuals(const Factors& factors, const Lane& length, const Lane& amount, int used,
                   BlockFit* fit, AzimuthEvidence* evidence) const;

    const Steps& steps_;
    // The drift's column, and what of it the other columns do not hold; readings and variances.
    std::vector<double> drift_column_, column_, y_, v_;
};

}  // namespace drude
