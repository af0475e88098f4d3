#include "bench/charts/bench_items.h"

namespace drude {

const std::vector<BenchItem>& bench_items() {
    static const std::vector<BenchItem> all = {fresnel_item(), microfacet_item(), fit_item(),
                                               capture_item()};
    return all;
}

}  // namespace drude
