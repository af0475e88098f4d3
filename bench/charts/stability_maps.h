// The stability maps of the program, by room. `resolution` is the number of cells along an axis
// that has no steps of its own; every map takes in its corners whatever the resolution.
#pragma once

#include <vector>

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
std::vector<StabilityMap> bulk_fit_maps(int resolution, int seeds);
// Of few thicknesses, noises and wavelengths where not `all`: a fit takes about a second.
std::vector<StabilityMap> film_fit_maps(int resolution, int seeds, bool all);
std::vector<StabilityMap> capture_maps(int resolution, int seeds);

}  // namespace drude
