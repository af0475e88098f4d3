// The decisions on what of the data counts, and how: parts of decisions().
#pragma once

#include "base/model_decision.h"
#include "fitter/fit.h"

namespace drude {

ModelDecision angle_decision(const Measurement& measurement, const FitOptions& options,
                             const FitResult& fit);
ModelDecision estimator_decision(const Measurement& measurement, const FitOptions& options,
                                 const FitResult& fit);
ModelDecision robust_decision(const Measurement& measurement, const FitOptions& options,
                              const FitResult& fit);

}  // namespace drude
