// Which angles of incidence carry what is known of n and k, and how few would do.
#pragma once

#include <vector>

#include "fitter/fit.h"

namespace drude {

struct AngleSet {
    std::vector<double> angles_deg;
    // Median over the wavelengths of sqrt(sigma_n^2 + sigma_k^2), infinite where they determine no
    // n and k; of a film the standard deviation of its thickness in nm, NaN where no fit converges.
    double sigma = 0;
};

struct AngleChoice {
    AngleSet all;
    std::vector<AngleSet> without;  // each angle left out, in the order of `all`; none of one angle
    std::vector<AngleSet> best;     // of 1, 2, ... angles the best set; empty for films
    AngleSet needed;  // the fewest whose sigma is at most enough_sigma times that of all
};

// Every angle is a row more at every wavelength: what cannot be had with half the precision is
// needed, what can is precision bought with time at the instrument.
inline constexpr double enough_sigma = 2;

// Bare and overlaid surfaces, point by point or by a formula: from the information matrices
// (Fisher 1925) of every row at the fitted n and k, which add up over the angles. For more than 12
// angles the best sets are built by adding the angle that gains most. Films: by fits that leave one
// angle out, from where `fit` ended.
// `measurement` and `options` are those that `fit` came from.
AngleChoice angle_choice(const Measurement& measurement, const FitOptions& options,
                         const FitResult& fit);

// The rows at these angles alone. Throws Error (user) for an angle that the measurement lacks and
// for an empty list.
Measurement at_angles(const Measurement& measurement, const std::vector<double>& angles_deg);

}  // namespace drude
