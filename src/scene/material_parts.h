// What several materials have in common.
#pragma once

#include <optional>
#include <string>

#include "scene/builders.h"

namespace drude {

// `prefix` + "roughness" (uroughness, vroughness, "bool remaproughness"): two numbers in pbrt, one
// here. A roughness that depends on direction gives a message and its geometric mean; of two
// textures, or a texture and a number, the first texture stands in for both. Error (user) where a
// number lies outside [0, 10]; what a texture gives is held there when it is drawn.
struct RoughnessFound {
    double alpha = 0;  // pbrt's; typical of a texture
    std::optional<Roughness> textured;
};
RoughnessFound read_roughness(ParameterList& list, const std::string& prefix,
                              BuildContext& context);
// The same where it cannot change over a surface: a texture gives a message.
double read_alpha(ParameterList& list, const std::string& prefix, BuildContext& context);

// The refractive index of a clear medium, a number or a spectrum; 1.5 where the parameter is
// absent, as in pbrt-v4. Error (user) outside [0.1, 10].
DenseSpectrum read_eta(ParameterList& list, const std::string& name, BuildContext& context);

}  // namespace drude
