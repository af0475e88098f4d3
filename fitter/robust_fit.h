// Fits that a few bad rows do not pull away.
#pragma once

#include "fitter/fit.h"

namespace drude {

// "none", "huber", "cauchy", "tukey", and "auto": none, or tukey where robust_choice() says so.
const std::vector<std::string>& robust_names();

// Where a loss begins to bend, in standard deviations of a residual: 1.345, 2.385 and 4.685, at
// which each keeps 95 % of the efficiency of least squares on normal data (Holland & Welsch,
// Communications in Statistics A 6, 813 (1977), for single residuals). The Psi and Delta of one row
// share one loss of the length of their pair; of pairs the three keep 93 to 94 %. 0 for "none".
double robust_constant(const std::string& name);

// fit_measurement() with a loss: iteratively reweighted least squares with Ceres' loss functions,
// which ends where the sum of losses is stationary, for any model. The redescending cauchy and
// tukey start from the solution of huber, whose loss is convex in the residual, and at each
// wavelength that is fitted by itself also from those that leave one angle out: huber alone does
// not withstand a bad row at the angle that carries most of what is known.
//
// Standard deviations are those of the Jacobian weighted at the solution, (J' W J)^-1. The sandwich
// of M-estimation would need the scatter of the residuals, which a handful of angles does not give,
// while the weights are smooth in it; on normal data the result is between 0.5 % too small (huber,
// tan^2 Psi) and 10 % too large (cauchy, pairs). The result's chi2 is the sum of the losses, which
// is smaller than chi-square, so that a reduced one below 1 says little.
//
// Throws Error (user) for an unknown loss and where there is none to be had: the estimator
// inversion does not minimise, the model auto compares chi-squares, and `unweighted` data have no
// standard deviation that "far" could be measured in.
FitResult fit_robust(const Measurement& measurement, const FitOptions& options);

}  // namespace drude
