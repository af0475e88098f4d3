// Where to start the fit of a dispersion formula.
#pragma once

#include <vector>

#include "fitter/dispersion_model.h"
#include "fitter/dispersion_residuals.h"

namespace drude {

// Parameters of random start number `number` (from 0): nonlinear ones uniform in their ranges, the
// others by linear least squares on `targets` (half their range where there are none), all within
// their bounds. A pure function of its arguments.
std::vector<double> dispersion_start(const DispersionModel& model,
                                     const std::vector<PermittivityTarget>& targets, int number);

// Refines every random start on `targets` and returns at most `count` solutions, best first and
// distinct in chi-square; without targets the random starts themselves, all of them.
std::vector<std::vector<double>> search_dispersion(const DispersionModel& model,
                                                   const std::vector<PermittivityTarget>& targets,
                                                   size_t count, int threads);

}  // namespace drude
