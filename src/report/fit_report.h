// All there is to say about one fit, for whoever prints, draws or tabulates it.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/model_decision.h"
#include "fitter/bootstrap.h"
#include "fitter/common_error.h"
#include "fitter/literature.h"
#include "fitter/profile.h"
#include "fitter/substrate_choice.h"
#include "materials/measurement.h"

namespace drude {

struct FitReport {
    std::string name;         // of the material
    Measurement measurement;  // as it was weighed
    // Among the standard deviations of `measurement`; empty where none was stated.
    std::vector<CommonError> common_errors;
    FitOptions options;
    FitResult fit;
    std::optional<LiteratureComparison> literature;
    std::vector<SubstrateAlternative> substrates;  // of a film
    std::optional<BootstrapResult> bootstrap;
    std::optional<ProfileResult> profile;
    std::vector<ModelDecision> decisions;  // where they are to be explained
    Provenance provenance;
};

// What the constants at `fit.points` are of: "pseudo n and k of a bare surface".
std::string what_was_fitted(const FitResult& fit);

// A self-contained HTML document: figures, parameters, ladder, literature, warnings.
std::string fit_page(const FitReport& report);

}  // namespace drude
