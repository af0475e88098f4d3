// How far every row of a measurement is from a fitted model.
#pragma once

#include <limits>
#include <vector>

#include "fitter/fit.h"

namespace drude {

// In units of the row's standard deviations, as the fit minimises them (residuals.h). Of the
// estimator rho2 `psi` is the residual of tan^2 Psi and `delta` is 0. NaN for rows outside the
// fitted range and at wavelengths that the fit left out.
struct RowResidual {
    double psi = std::numeric_limits<double>::quiet_NaN();
    double delta = std::numeric_limits<double>::quiet_NaN();
    double squared() const { return psi * psi + delta * delta; }
};

// One for every row of `measurement`, in its order. `options.weights` take no part.
std::vector<RowResidual> row_residuals(const FitResult& fit, const Measurement& measurement,
                                       const FitOptions& options);

}  // namespace drude
