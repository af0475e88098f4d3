#include "fitter/film_profile.h"

#include <cmath>
#include <stdexcept>

namespace drude {

namespace {

size_t number_of(const std::string& name) {
    for (size_t j = 0; j < film_parameter_count; ++j) {
        if (name == film_parameters()[j].name) return j;
    }
    throw std::logic_error("no parameter of a film: " + name);
}

}  // namespace

FilmBound film_bound(const std::string& name, const FilmRange& range) {
    const size_t j = number_of(name);
    const double scale = film_parameters()[j].scale;
    return {range.lower[j] * scale, range.upper[j] * scale};
}

HeldChi2 held_film_chi2(const FilmProblem& problem, const FitResult& fit, const std::string& name,
                        const FitOptions& options) {
    const size_t held = number_of(name);
    FilmValues values = film_start({0, options.film.porosity.value_or(0), 0}, problem, options);
    FreeFilmParameters free = {};
    for (const FittedParameter& p : fit.common) {
        if (!p.identifiable) continue;
        const size_t j = number_of(p.name);
        values[j] = p.value / film_parameters()[j].scale;
        free[j] = j != held;
    }
    const FilmRange range = film_range(problem, options);
    return [&problem, range, values, free, held](double value) mutable {
        values[held] = value / film_parameters()[held].scale;
        const FilmSolution solution = solve_film(problem, values, free, range);
        if (std::isfinite(solution.chi2)) values = solution.values;
        return solution.chi2;
    };
}

}  // namespace drude
