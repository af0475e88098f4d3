// Point by point, or a formula over all wavelengths.
#pragma once

#include "fitter/fit.h"

namespace drude {

// The dispersion "auto" of fit_measurement(), for the models bulk and overlayer: the smallest
// formula of "compact" where the Bayesian information criterion of n and k point by point is
// more than ladder_bic_gain above its own, and its reduced chi-square exceeds 1 (or that of the
// points, where it shows that standard deviations are stated too large) by no more than three
// times its scatter; otherwise point by point. `unweighted` the criterion alone decides, and
// point by point is taken where it has none: as many parameters as data. Both fits are in the
// result's `ladder`, with what spoke against the formula. Throws what the fit point by point
// throws.
FitResult fit_dispersion_if_it_holds(const Measurement& measurement, const FitOptions& options);

}  // namespace drude
