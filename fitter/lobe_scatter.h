// How far a fitted beta scatters where the readings at one position of the detector err together.
#pragma once

#include "fitter/lobe_fit.h"

namespace drude {

// The standard deviation of `fitted.beta` from the residuals themselves, summed over each position
// of the detector before they are squared: an azimuth that a mount missed, or a lamp that changed,
// is common to all wavelengths there, and the noise of each reading alone, which
// FittedLobe::sigma_beta is made of, knows nothing of it. (Liang & Zeger, Biometrika 73, 13, 1986,
// eq. 6, with G/(G - 1) for G positions.)
//
// Where the readings err independently it scatters about sigma_beta by 1/sqrt(2 G) of itself. Take
// the larger of the two. Throws as fit_lobes() for a scan or a metal that do not check; Error
// (answer_is_no) for fewer than two positions.
double scatter_of_beta(const LobeScan& scan, const Material& metal, const FittedLobe& fitted);

}  // namespace drude
