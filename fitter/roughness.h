// Roughness as a layer of its own.
#pragma once

#include "materials/material.h"

namespace drude {

// A layer of Bruggeman's mixture of `below` and void (roughness_void of effective_medium.h),
// `thickness_nm` thick.
FilmLayer roughness_layer(const OpticalConstants& below, double thickness_nm);

}  // namespace drude
