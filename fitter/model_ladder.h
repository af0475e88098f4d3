// The smallest model that the data need: a ladder of models, climbed only where it pays.
#pragma once

#include <string>

#include "fitter/fit.h"

namespace drude {

// A rung is taken only where the Bayesian information criterion falls by more than this.
inline constexpr double ladder_bic_gain = 10;
// What is said of a rung whose criterion falls by no more.
std::string small_gain(double gain);

// chi-square + M ln N with known standard deviations; N ln(chi-square/N) + M ln N where
// `unweighted`, M parameters and N data (Schwarz, Annals of Statistics 6, 461 (1978)). NaN where
// `unweighted` with no more data than parameters.
double bayesian_criterion(double chi2, int data, int parameters, bool unweighted);
double bayesian_criterion(const FitResult& fit, bool unweighted);

// The model "auto" of fit_measurement(): bulk; below `overlayers`, where they are given; a film of
// unknown thickness, where a substrate is given; an offset of the angles of incidence on the best
// of them, from three angles on; and a spread of the film's thickness. A rung is
// taken where the criterion falls by more than ladder_bic_gain and the reduced chi-square falls, or
// exceeds 1 by no more than three times its scatter; `unweighted` the criterion alone decides. With
// standard deviations stated too large the criterion falls less, and smaller models are taken.
// Every rung is in the result's `ladder`, with what spoke against it. Throws what the first rung
// throws where no rung fits.
FitResult fit_ladder(const Measurement& measurement, const FitOptions& options);

}  // namespace drude
