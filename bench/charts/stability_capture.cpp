// Capture where cos Delta saturates: Psi and Delta of scans with noise, one cycle and two.
//
// The reduction's own last step, combine_scans(), on coefficients alpha and beta of a scan with
// normal errors; the error is the distance of Delta from the truth in the standard deviations that
// the reduction states.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/counter_random.h"
#include "bench/charts/bench_items.h"
#include "bench/charts/map_grid.h"
#include "bench/charts/stability_maps.h"
#include "device/signal/psi_delta.h"
#include "materials/scalar.h"

namespace drude {

namespace {

// One scan at an analyser of 45 degrees (psi_delta.h).
BinScan scan_of(double psi, double delta, double noise, bool retarder, uint64_t seed) {
    const double t = std::tan(psi), size = 1 + t * t;
    const double shifted = delta + (retarder ? pi / 2 : 0);
    const auto deviates = normal_pair(seed, 0, retarder ? 2 : 1);
    BinScan scan;
    scan.fit.usable = true;
    scan.fit.alpha = (t * t - 1) / size + noise * deviates[0];
    scan.fit.beta = 2 * t * std::cos(shifted) / size + noise * deviates[1];
    scan.fit.noise = {noise * noise, 0, noise * noise};
    scan.analyser_rad = pi / 4;
    scan.retarder_in = retarder;
    return scan;
}

MapCell capture_cell(double psi_deg, double delta_deg, double noise, bool two_cycles, int seeds) {
    MapCell cell;
    int refused = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
        const double psi = psi_deg * degree, delta = delta_deg * degree;
        std::vector<BinScan> scans{scan_of(psi, delta, noise, false, static_cast<uint64_t>(seed))};
        RetarderState retarder;
        if (two_cycles) {
            scans.push_back(scan_of(psi, delta, noise, true, static_cast<uint64_t>(seed)));
            scans.back().dark = scans.back().stop = 1;
            retarder = {true, pi / 2, 1};
        }
        const PsiDelta found = combine_scans(scans, retarder, {});
        // The reduction leaves the first two out and warns of all three, with their number.
        if (found.state == PsiDeltaState::impossible || found.state == PsiDeltaState::half_wave ||
            found.faint) {
            ++refused;
            continue;
        }
        const double off = std::abs(std::remainder(found.delta - delta, 2 * pi));
        keep_worst(off / std::sqrt(found.noise.bb), &cell.error);
        keep_worst(std::abs(found.psi - psi) / std::sqrt(found.noise.aa), &cell.error);
    }
    // Inside nothing may be said, outside what stands without a warning counts.
    const double t = std::tan(psi_deg * degree), lack = 2 * std::min(1.0, t * t) / (1 + t * t);
    cell.inside = lack > 10 * noise;
    cell.refused = cell.inside ? refused > 0 : refused == seeds;
    return cell;
}

StabilityMap capture_map(const std::string& id, double psi_deg, bool two_cycles, int resolution,
                         int seeds) {
    StabilityMap map;
    map.id = id;
    map.title =
        fmt::format("Delta next to 180 degrees, {}", two_cycles ? "two cycles" : "one cycle");
    map.error = "standard deviations from the truth";
    map.bound = two_cycles ? 6 : 10;
    map.domain = "noise below a tenth of what |alpha| = cos 2Psi lacks of 1";
    map.outside =
        "a warning with the number of rows: left out where no sample gives them, or Psi so near 0 "
        "or "
        "90 degrees that noise reaches it";
    map.caption = fmt::format(
        "Psi and Delta of scans with errors of alpha and beta, Psi = {} degrees; the worst of {} "
        "seeds, in the standard deviations that the reduction states.{}",
        psi_deg, seeds,
        two_cycles
            ? ""
            : " One cycle gives cos Delta alone: next to 180 degrees five standard deviations "
              "of it are ten of Delta.");
    map.x = {"180 - Delta (degrees)", log_steps(1e-4, 90, resolution)};
    map.y = {"noise of alpha and beta", log_steps(1e-6, 0.1, std::max(6, resolution / 2))};
    fill_map(&map, [&](double x, double y) {
        return capture_cell(psi_deg, 180 - x, y, two_cycles, seeds);
    });
    return map;
}

}  // namespace

std::vector<StabilityMap> capture_maps(int resolution, int seeds) {
    return {capture_map("capture-one-cycle", 40, false, resolution, seeds),
            capture_map("capture-two-cycles", 40, true, resolution, seeds),
            capture_map("capture-small-psi", 3, true, resolution, seeds)};
}

BenchItem capture_stability_item() {
    return {"stability-capture", "Stability: capture where cos Delta saturates",
            "Psi and Delta of noisy scans next to Delta = 180 degrees",
            [](const BenchOptions& options) {
                BenchResult result;
                result.maps = options.quick ? capture_maps(12, 50) : capture_maps(40, 400);
                return result;
            }};
}

}  // namespace drude
