// n and k at one wavelength.
#pragma once

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

}  // namespace drude
