// Thickness and porosity of a film on a known substrate, from all wavelengths together.
#pragma once

#include "fitter/fit.h"

namespace drude {

// The model "film" of fit_measurement(), which checks the options beforehand. Started by
// search_film(), the best starts refined by least squares, the lowest minimum taken. Throws Error
// (answer_is_no) where the data do not determine the thickness.
FitResult fit_film(const Measurement& measurement, const FitOptions& options);

}  // namespace drude
