// chi-square of a film with one of its parameters held.
#pragma once

#include <string>

#include "fitter/film_solver.h"
#include "fitter/fit_result.h"
#include "fitter/profile_interval.h"

namespace drude {

struct FilmBound {
    double lower = 0, upper = 0;  // in the parameter's unit
};

// `name`: one of film_parameters(), as FitResult::common has it.
FilmBound film_bound(const std::string& name, const FilmRange& range);

// Smallest over those of `fit.common` that are not held; the rest as the options have it. Each call
// starts from where the last one ended. Not to be called from two threads at once; `problem` must
// outlive the function.
HeldChi2 held_film_chi2(const FilmProblem& problem, const FitResult& fit, const std::string& name,
                        const FitOptions& options);

}  // namespace drude
