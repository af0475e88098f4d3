// n and k at one wavelength.
#pragma once

#include <vector>

#include "fitter/fit_result.h"
#include "fitter/point_data.h"

namespace drude {

enum class Estimator { psi_delta, rho2, inversion };

// n is kept above zero, where the reflectance is 1 whatever else and nothing can be read from it.
inline constexpr double smallest_n = 1e-6;
// A surface this far from the vacuum is a perfect mirror for every instrument; data that no bare
// surface explains can drive a fit there, and such a point is refused.
inline constexpr double largest_index = 1000;

// Never throws for data that hold too little: the result then says why.
FittedPoint fit_point(const WavelengthData& data, Estimator estimator);

// The same by least squares from one start alone, which is moved into n from 1e-3 and k from 1e-6,
// 100 at most. For studies of convergence: fit_point() needs no start. Throws std::logic_error for
// the estimator inversion, which takes none.
FittedPoint fit_point_from(const WavelengthData& data, Estimator estimator, Index start);

// Refuses a fit of data that hold nothing, whatever number fits them best: where the standard
// deviations of n and k together exceed the length of n + ik `not_known_at_all` times, and, where
// Delta takes part, where Psi = 45 and Delta = 180 degrees explain the data within their noise, as
// they do for every surface near normal incidence. Below that factor the data may still bound n and
// k from one side, as tan^2 Psi of silver bounds k, which a standard deviation does not show. Only
// for standard deviations that are those of the data.
inline constexpr double not_known_at_all = 100;
void refuse_if_unknown(const WavelengthData& data, Estimator estimator, FittedPoint* point);

// Whether a standard deviation is above a tenth of n or k in a fit of tan^2 Psi alone. Its
// chi-square follows the logarithms of n and k along a bent valley: where these scatter by r, an
// estimate that is low by x standard deviations states them too small, and is off by
// (exp(x r) - 1)/r of those it states, 5 for x = 4 and r = 0.1. Psi and Delta together are linear
// enough in n and k for their standard deviations to hold there.
bool understates_errors(const FittedPoint& point, Estimator estimator);

// Why data that hold nothing are refused.
inline constexpr const char* normal_incidence_reason =
    "within their noise the data are Psi = 45 and Delta = 180 degrees, as of every surface near "
    "normal incidence: they hold nothing of n and k";

// The two reasons by themselves. Whether Psi = 45 and Delta = 180 degrees explain all of the data;
// always false for tan^2 Psi alone.
bool hold_nothing(const std::vector<WavelengthData>& groups, Estimator estimator);
void refuse_if_vague(FittedPoint* point);

}  // namespace drude
