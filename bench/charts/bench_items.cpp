#include "bench/charts/bench_items.h"

namespace drude {

const std::vector<BenchItem>& bench_items() {
    static const std::vector<BenchItem> all = {transport_item(), wavelength_item(), sampling_item(),
                                               fresnel_item(),   microfacet_item(), fit_item(),
                                               capture_item(),   defaults_item()};
    return all;
}

}  // namespace drude
