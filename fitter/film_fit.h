// Thickness and porosity of a film on a known substrate, from all wavelengths together.
#pragma once

#include "fitter/film_model.h"
#include "fitter/fit.h"

namespace drude {

// Beyond, the film is next to nothing.
inline constexpr double largest_porosity = 0.95;

// The data of the options' range, with the known constants at their wavelengths.
FilmProblem make_film_problem(const Measurement& measurement, const FitOptions& options);

// The model "film" of fit_measurement(), which checks the options beforehand. Started by
// search_film(), the best starts refined by least squares, the lowest minimum taken. Throws Error
// (answer_is_no) where the data do not determine the thickness.
FitResult fit_film(const Measurement& measurement, const FitOptions& options);

}  // namespace drude
