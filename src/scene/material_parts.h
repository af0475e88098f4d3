// What several materials have in common.
#pragma once

#include <string>

#include "scene/builders.h"

namespace drude {

// alpha of `prefix` + "roughness" (uroughness, vroughness, "bool remaproughness"): two numbers in
// pbrt, one here. A roughness that depends on direction gives a message and its geometric mean.
// Error (user) outside [0, 10], or where alpha comes to more than 4.
double read_alpha(ParameterList& list, const std::string& prefix, BuildContext& context);

// The refractive index of a clear medium, a number or a spectrum; 1.5 where the parameter is
// absent, as in pbrt-v4. Error (user) outside [0.1, 10].
DenseSpectrum read_eta(ParameterList& list, const std::string& name, BuildContext& context);

}  // namespace drude
