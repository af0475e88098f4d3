// From a fit to the material record that a renderer reads.
#pragma once

#include <string>

#include "fitter/fit_result.h"
#include "materials/material.h"
#include "materials/measurement.h"

namespace drude {

// The identifiable points as optical constants of kind "fitted" with their standard deviations,
// under the fit's layers; for a fitted film the known substrate under that film. A smooth surface
// (beta = 0). `name`: of the record; where it is empty, the measurement's header
// "sample", else its file name without extension. `provenance` is kept, with the fit's warnings
// added. Throws Error (answer_is_no) where no point is identifiable.
Material fitted_material(const FitResult& fit, const Measurement& measurement,
                         const std::string& name, Provenance provenance);

}  // namespace drude
