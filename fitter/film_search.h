// Where to start the fit of a film: chi-square has a minimum for every fringe that fits between
// the data, 22 to 31 of them from 1 to 5 micrometres, and least squares finds the nearest.
#pragma once

#include <vector>

#include "fitter/film_model.h"

namespace drude {

struct FilmStart {
    double thickness_nm = 0, porosity = 0;
    double chi2 = 0;  // of the wavelengths that the search looked at
};

// Thicknesses in nm at which cos 2Psi oscillates most, strongest first and three at most. The
// fringes of a film are periodic in x = sqrt(n^2 - sin^2)/lambda with the frequency 2d; on the
// plain axis 1/lambda dispersion shifts them by some per cent, out of the basin. Data less a
// parabola in x, Hann's window, and the Fourier integral over the unevenly spaced x themselves, so
// that the fringes of thick films are not smoothed away; the power is summed over the angles.
// Empty where no more than `fewest_fringes` would lie in the data at `largest_nm`.
std::vector<double> fringe_thicknesses(const FilmProblem& problem, double porosity,
                                       double largest_nm);
inline constexpr double fewest_fringes = 2;

// At most `count` starts, best first and each at another interference order. For every one of
// `porosities`: the neighbourhoods of fringe_thicknesses() and the thin films that show no two
// fringes, in steps that no minimum fits between. The same on any number of threads.
std::vector<FilmStart> search_film(const FilmProblem& problem,
                                   const std::vector<double>& porosities, double largest_nm,
                                   size_t count, int threads);

}  // namespace drude
