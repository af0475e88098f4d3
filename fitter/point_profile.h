// chi-square of one wavelength with n or k held.
#pragma once

#include <cstddef>
#include <vector>

#include "fitter/point_fit.h"
#include "fitter/profile_interval.h"

namespace drude {

// Smallest over the other one, started from where the last call ended, from `point` at first; not
// to be called from two threads at once. `estimator`: psi_delta or rho2.
HeldChi2 held_index_chi2(const WavelengthData& data, Estimator estimator, const FittedPoint& point,
                         bool hold_k);

// Smallest also over an angle offset from `offset_low` to `offset_high` (radians), for which the
// other wavelengths pay `others`, known at the Chebyshev points of that range.
HeldChi2 held_index_chi2(const WavelengthData& data, Estimator estimator, const FittedPoint& point,
                         bool hold_k, const std::vector<double>& others, double offset_low,
                         double offset_high);

// Number `i` of `count` Chebyshev points of the second kind in [low, high], `count` at least 2.
double chebyshev_point(size_t i, size_t count, double low, double high);

// The polynomial through `values` at the Chebyshev points, by the barycentric formula (Berrut &
// Trefethen, SIAM Review 46, 501 (2004), eq. 5.4).
double chebyshev_value(const std::vector<double>& values, double low, double high, double at);

}  // namespace drude
