// Which angles of incidence carry what is known of n and k, and how few would do.
#pragma once

#include <vector>

#include "fitter/fit.h"

namespace drude {

struct AngleSet {
    std::vector<double> angles_deg;
    // Median over the wavelengths of sqrt(sigma_n^2 + sigma_k^2) of a fit point by point, infinite
    // where they determine no n and k; of a film the standard deviation of its thickness in nm, NaN
    // where no fit converges.
    double sigma = 0;
};

struct AngleChoice {
    AngleSet all;
    std::vector<AngleSet> without;  // each angle left out, in the order of `all`; none of one angle
    std::vector<AngleSet> best;     // of 1, 2, ... angles the best set; empty for films
    // The fewest whose sigma is at most enough_sigma times that of all; of films the fewest that
    // are left where one angle after another goes, first the one whose absence costs least.
    AngleSet needed;
};

// Every angle is a row more at every wavelength: what cannot be had with half the precision is
// needed, what can is precision bought with time at the instrument.
inline constexpr double enough_sigma = 2;

// Bare and overlaid surfaces, point by point or by a formula: from the information matrices
// (Fisher 1925) of every row at the fitted n and k, which add up over the angles. A formula shares
// its parameters among the wavelengths: its own standard deviations (sigma_of_fit()) are smaller.
// `unweighted` the scatter of the residuals gives the scale, as in the fit. For more than 12
// angles the best sets are built by adding the angle that gains most. Films: by fits that leave
// angles out, from where `fit` ended, less than two for every angle.
// `measurement` and `options` are those that `fit` came from.
AngleChoice angle_choice(const Measurement& measurement, const FitOptions& options,
                         const FitResult& fit);

// sigma of all angles, without the rest of angle_choice(); of films that of the fit.
double sigma_of_all_angles(const Measurement& measurement, const FitOptions& options,
                           const FitResult& fit);

// What the fit itself states: the median of sqrt(sigma_n^2 + sigma_k^2) over its wavelengths, of a
// film the standard deviation of its thickness in nm. NaN or infinite where it states none.
double sigma_of_fit(const FitResult& fit);

// The rows at these angles alone. Throws Error (user) for an angle that the measurement lacks and
// for an empty list.
Measurement at_angles(const Measurement& measurement, const std::vector<double>& angles_deg);

}  // namespace drude
