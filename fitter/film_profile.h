// chi-square of a film with one of its parameters held.
#pragma once

#include <optional>
#include <string>

#include "fitter/film_model.h"
#include "fitter/fit_result.h"
#include "fitter/profile_interval.h"

namespace drude {

struct FilmBound {
    double lower = 0, upper = 0;  // in the parameter's unit
};

// `name`: "thickness" (nm), "porosity" or "angle offset" (degrees), as FitResult::common has it.
FilmBound film_bound(const std::string& name, double largest_thickness_nm);

// Smallest over those of `fit.common` that are not held; `known_porosity` where the porosity is not
// among them, and no offset where that is not. Each call starts from where the last one ended. Not
// to be called from two threads at once; `problem` and `fit` must outlive the function.
HeldChi2 held_film_chi2(const FilmProblem& problem, const FitResult& fit, const std::string& name,
                        double largest_thickness_nm, std::optional<double> known_porosity);

}  // namespace drude
