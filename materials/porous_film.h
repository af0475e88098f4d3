// A material with pores, as a film of anodised metal is.
#pragma once

#include <vector>

#include "materials/optical_constants.h"

namespace drude {

// n and k of `dense` with the share `porosity` in [0, 1] of vacuum (Bruggeman, effective_medium.h)
// at the given wavelengths, ascending in nm; of kind "calculated" and without a name. Wavelengths
// outside the table of `dense`: Error (user), as OpticalConstants::at.
OpticalConstants porous_constants(const OpticalConstants& dense, double porosity,
                                  const std::vector<double>& wavelengths_nm);

}  // namespace drude
