// Point by point, or a formula over all wavelengths.
#pragma once

#include "fitter/fit.h"

namespace drude {

// The dispersion "auto" of fit_measurement(), for the models bulk and overlayer: the smallest
// formula of "compact" where the Bayesian information criterion of n and k point by point is more
// than ladder_bic_gain above its own, and its reduced chi-square is 1 within three times its
// scatter; otherwise point by point. Both are in the result's `ladder`, with what spoke against the
// formula. Throws what the fit point by point throws.
FitResult fit_dispersion_if_it_holds(const Measurement& measurement, const FitOptions& options);

}  // namespace drude
