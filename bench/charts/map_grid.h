// The axes of stability maps, and their cells filled side by side.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "base/executor.h"
#include "bench/charts/stability.h"

namespace drude {

// `count` >= 2 values from `first` to `last`, both > 0, in equal ratios.
inline std::vector<double> log_steps(double first, double last, int count) {
    std::vector<double> steps(static_cast<size_t>(count));
    for (int i = 0; i < count; ++i)
        steps[i] = first * std::pow(last / first, 1.0 * i / (count - 1));
    return steps;
}

// `count` >= 2 values from `first` to `last` in equal steps.
inline std::vector<double> even_steps(double first, double last, int count) {
    std::vector<double> steps(static_cast<size_t>(count));
    for (int i = 0; i < count; ++i) steps[i] = first + (last - first) * i / (count - 1);
    return steps;
}

// Every cell of the map from its parameters. `cell` may be called from several threads at once, so
// that what is random in it has to follow from x and y.
inline void fill_map(StabilityMap* map, const std::function<MapCell(double x, double y)>& cell) {
    const size_t columns = map->x.at.size();
    map->cells.resize(columns * map->y.at.size());
    parallel_for(map->cells.size(), 0, [&](size_t i) {
        map->cells[i] = cell(map->x.at[i % columns], map->y.at[i / columns]);
    });
}

// The largest, where NaN counts as infinite: std::max would drop it.
inline void keep_worst(double error, double* worst) {
    if (!(error <= *worst)) *worst = std::isnan(error) ? HUGE_VAL : error;
}

}  // namespace drude
