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

}  // namespace drude
