// What a rough vertex costs a path.
#pragma once

#include <cstdint>

#include "materials/microfacet.h"

namespace drude {

// Nanoseconds of processor time of one direction sampled and one evaluated, for directions and
// random numbers drawn from `seed` beforehand.
double vertex_ns(const Microfacets<float>& microfacets, uint64_t seed);

}  // namespace drude
