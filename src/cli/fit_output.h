// What `drude fit` prints of a fit of optical constants.
#pragma once

#include <string>

#include "fitter/fit_result.h"
#include "materials/measurement.h"

namespace drude {

// One JSON document on stdout. `output`: the material file that was written, or empty.
void print_fit_json(const FitResult& fit, const Measurement& measurement, const Material& material,
                    const std::string& output);

// The same for people: a table where no file was written, then the summary. `unweighted`:
// chi-square is in square degrees.
void print_fit_text(const FitResult& fit, const Material& material, const std::string& output,
                    bool unweighted);

}  // namespace drude
