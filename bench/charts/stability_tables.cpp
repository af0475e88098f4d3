// Wavelengths outside the tables of n and k: what is held there is said, never taken for data.
#include <algorithm>
#include <cmath>

#include "bench/charts/map_grid.h"
#include "bench/charts/stability_maps.h"
#include "base/error.h"
#include "materials/optical_constants.h"

namespace drude {

namespace {

// By search from the front, apart from OpticalConstants::at.
double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) {
    for (size_t i = 1; i < x.size(); ++i) {
        if (at <= x[i]) return y[i - 1] + (y[i] - y[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1]);
    }
    return y.back();
}

MapCell table_cell(OpticalConstants constants, RangePolicy policy, double nm) {
    constants.policy = policy;
    MapCell cell;
    cell.inside = constants.covers(nm, nm);
    try {
        const Index found = constants.at(nm);
        // Every command prints it.
        cell.refused = !constants.range_warning(nm, nm).empty();
        cell.error = cell.inside ? std::hypot(found.n - interpolated(constants.wavelength_nm,
                                                                     constants.n, nm),
                                              found.k - interpolated(constants.wavelength_nm,
                                                                     constants.k, nm))
                                 : HUGE_VAL;  // nobody knows
    } catch (const Error&) {
        cell.refused = true;
    }
    return cell;
}

}  // namespace

std::vector<StabilityMap> table_maps(int resolution) {
    std::vector<StabilityMap> maps;
    for (const RangePolicy policy : {RangePolicy::clamp, RangePolicy::error}) {
        const bool clamps = policy == RangePolicy::clamp;
        StabilityMap map;
        map.id = clamps ? "tables-clamp" : "tables-error";
        map.title = clamps ? "Beyond the tables, end values held" : "Beyond the tables, refused";
        map.error = "error of n + ik against linear interpolation";
        map.bound = 1e-9;
        map.domain = "the table's own wavelengths";
        map.outside = clamps ? "one warning that names the range and the value that is held"
                             : "an error that names the range";
        map.caption = "Every published set of the program.";
        map.x = {"wavelength (nm)", log_steps(20, 2e5, resolution)};
        map.y = {"published set, by number", {}};
        for (size_t i = 0; i < published_sets().size(); ++i) {
            map.y.at.push_back(static_cast<double>(i + 1));
        }
        fill_map(&map, [&](double x, double y) {
            return table_cell(published_sets()[static_cast<size_t>(y) - 1], policy, x);
        });
        maps.push_back(std::move(map));
    }
    return maps;
}

BenchItem table_stability_item() {
    return {"stability-tables", "Stability: wavelengths outside the tables",
            "what is said where the published sets end", [](const BenchOptions& options) {
                BenchResult result;
                result.maps = table_maps(options.quick ? 24 : 60);
                return result;
            }};
}

}  // namespace drude
