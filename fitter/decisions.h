// Every automatic decision of a fit, with its reason, cost and error.
#pragma once

#include <vector>

#include "base/model_decision.h"
#include "fitter/fit.h"
#include "fitter/substrate_choice.h"

namespace drude {

// What fit_measurement() chose, or would choose where "auto" is asked for, decision by decision:
// model, point by point or a formula, angles, estimator, robust loss, substrate, search. Every rule
// is the fit's own (model_ladder.h, dispersion_choice.h, angle_choice.h, robust_choice.h,
// substrate_choice.h). Costs are parameters and data; errors are standard deviations and reduced
// chi-squares of this measurement. Fits what it compares with: takes as long as some fits.
//
// `measurement` and `options` are those that `fit` came from; `substrates` other_substrates() of
// them. Throws as fit_measurement().
std::vector<ModelDecision> decisions(const Measurement& measurement, const FitOptions& options,
                                     const FitResult& fit,
                                     const std::vector<SubstrateAlternative>& substrates);

}  // namespace drude
