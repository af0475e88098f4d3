// Least squares over the parameters of a film, from a given start.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "fitter/film_model.h"
#include "fitter/film_search.h"
#include "fitter/fit.h"

namespace drude {

// In the order of FilmParameters: thickness, porosity, angle offset, thickness spread, roughness.
inline constexpr size_t film_parameter_count = 5;
using FilmValues = std::array<double, film_parameter_count>;  // nm, radians
using FreeFilmParameters = std::array<bool, film_parameter_count>;

struct FilmParameterInfo {
    const char* name;
    const char* unit;
    double scale;  // from FilmValues to `unit`
};
const std::array<FilmParameterInfo, film_parameter_count>& film_parameters();

struct FilmRange {
    FilmValues lower, upper;
};

struct FilmSolution {
    FilmValues values = {0, 0, 0, 0, 0};
    double chi2 = std::numeric_limits<double>::infinity();
    bool converged = false;
};

// The data of the options' range with the known constants at their wavelengths: a film that is
// even, smooth and seen through a narrow slit, as the search for starts takes it; and with all that
// the options let be averaged, for films up to their largest thickness.
FilmProblem make_coherent_film_problem(const Measurement& measurement, const FitOptions& options);
FilmProblem make_film_problem(const Measurement& measurement, const FitOptions& options);

FreeFilmParameters free_film_parameters(const FitOptions& options);
// Where each parameter is sought.
FilmRange film_range(const FilmProblem& problem, const FitOptions& options);
// `start` with what the options say of the rest.
FilmValues film_start(const FilmStart& start, const FilmProblem& problem,
                      const FitOptions& options);

// The minimum reached from `start`; what is not free keeps its value. Spread and roughness are
// taken as 0 where the problem has none.
FilmSolution solve_film(const FilmProblem& problem, const FilmValues& start,
                        const FreeFilmParameters& free, const FilmRange& range);

// Row-major residuals x free parameters, in the units of FilmValues; empty where nothing is
// reflected.
std::vector<double> film_jacobian(const FilmProblem& problem, const FilmSolution& solution,
                                  const FreeFilmParameters& free, std::vector<double>* residuals);

}  // namespace drude
