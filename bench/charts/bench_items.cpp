#include "bench/charts/bench_items.h"

namespace drude {

const std::vector<BenchItem>& bench_items() {
    static const std::vector<BenchItem> all = {
        transport_item(),         wavelength_item(),        sampling_item(),
        fresnel_item(),           microfacet_item(),        fit_item(),
        capture_item(),           fresnel_stability_item(), film_stability_item(),
        lobe_stability_item(),    frame_stability_item(),   mirror_stability_item(),
        light_stability_item(),   table_stability_item(),   fit_stability_item(),
        capture_stability_item(), defaults_item(),
    };
    return all;
}

}  // namespace drude
