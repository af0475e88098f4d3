// One function an item of `drude bench`; each stands in a file of its own and is listed in
// bench_items.cpp.
#pragma once

#include "bench/charts/bench_item.h"

namespace drude {

BenchItem transport_item();
BenchItem wavelength_item();
BenchItem sampling_item();
BenchItem fresnel_item();
BenchItem microfacet_item();
BenchItem fit_item();
BenchItem capture_item();
BenchItem defaults_item();

// Stability where methods fail.
BenchItem fresnel_stability_item();
BenchItem film_stability_item();
BenchItem lobe_stability_item();
BenchItem frame_stability_item();
BenchItem mirror_stability_item();
BenchItem light_stability_item();
BenchItem table_stability_item();
BenchItem fit_stability_item();
BenchItem capture_stability_item();

}  // namespace drude
