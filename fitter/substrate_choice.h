// How far the thickness of a film depends on which published substrate it is fitted on.
#pragma once

#include <string>
#include <vector>

#include "fitter/fit.h"

namespace drude {

struct SubstrateAlternative {
    std::string name;                  // of the other set
    double first_nm = 0, last_nm = 0;  // the wavelengths of both of the following
    FittedParameter thickness;         // on the other set
    FittedParameter same_range;        // on the set of the fit, at these wavelengths
};

// For every other published set of the substrate's material that covers half of the fitted
// wavelengths at least: the film fitted on it, from the thickness that `fit` found, over the
// wavelengths that it covers. Empty where `fit` is no film or the substrate has no other set; sets
// on which nothing converges are left out.
std::vector<SubstrateAlternative> other_substrates(const Measurement& measurement,
                                                   const FitOptions& options, const FitResult& fit);

}  // namespace drude
