// What a fitted model predicts where a measurement was taken.
#pragma once

#include "fitter/fit.h"

namespace drude {

// Psi and Delta of the fitted model: the rows of `measurement` at the wavelengths that the fit
// determined, in their order, each with its stated angle, its standard deviations and its line;
// the light arrives at the stated angle plus a fitted angle offset. Delta in [0, 360). Layers and
// substrate are the fit's.
Measurement model_curve(const FitResult& fit, const Measurement& measurement);

// `options` narrowed to the model that was taken, so that fit_measurement() fits that one again:
// "auto" becomes the rung that the ladder ended on.
FitOptions options_taken(const FitOptions& options, const FitResult& fit);

}  // namespace drude
