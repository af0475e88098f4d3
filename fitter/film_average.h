// The nodes over which a fit averages a film's reflectance.
#pragma once

#include "fitter/film_model.h"
#include "fitter/fit.h"
#include "materials/film_average.h"

namespace drude {

// Standard deviation of a Gaussian of that full width at half maximum.
double gaussian_sigma(double full_width);

// Over a Gaussian slit of `bandwidth_nm` (full width at half maximum, > 0) about every wavelength
// of the problem, with the constants of each node, fine enough for `film.largest_thickness_nm`.
void set_bands(const FilmModel& film, double bandwidth_nm, FilmProblem* problem);

// Nodes of a Gaussian over the thickness, for spreads up to largest_spread().
void set_spread_nodes(FilmProblem* problem);

// In nm: beyond it the fringes of the shortest wavelength are e^-18 of what they were, and those of
// twice that wavelength 1 %.
double largest_spread(const FilmProblem& problem);

}  // namespace drude
