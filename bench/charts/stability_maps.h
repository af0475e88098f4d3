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
std::vector<StabilityMap> lobe_maps(int resolution, int samples);
std::vector<StabilityMap> frame_maps(int resolution);
std::vector<StabilityMap> mirror_maps(int resolution, int samples);
std::vector<StabilityMap> light_maps(const std::vector<double>& widths, int resolution,
                                     int samples);
std::vector<StabilityMap> table_maps(int resolution);

BenchItem fresnel_stability_item();
BenchItem film_stability_item();
BenchItem lobe_stability_item();
BenchItem frame_stability_item();
BenchItem mirror_stability_item();
BenchItem light_stability_item();
BenchItem table_stability_item();

}  // namespace drude
