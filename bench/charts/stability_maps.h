// The stability maps of the program, by room. `resolution` is the number of cells along an axis
// that has no steps of its own; every map takes in its corners whatever the resolution.
#pragma once

#include <vector>

#include "bench/charts/bench_item.h"
#include "bench/charts/stability.h"

namespace drude {

std::vector<StabilityMap> fresnel_maps(int resolution);
std::vector<StabilityMap> film_maps(int resolution);
// Of thick films, which take seconds each, only with `all`.
std::vector<StabilityMap> film_table_maps(bool all);

BenchItem fresnel_stability_item();
BenchItem film_stability_item();

}  // namespace drude
