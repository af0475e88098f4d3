// Stability where methods fail: the error of the fast path over the parameters where things break.
#pragma once

#include <string>
#include <vector>

namespace drude {

struct MapAxis {
    std::string label;                    // with its unit
    std::vector<double> at;               // ascending; the cells' parameters
    std::vector<std::string> names = {};  // of kinds that are only numbered in `at`; else empty
};

// What happened in one cell.
struct MapCell {
    double error = 0;      // of the fast path against the reference, in the map's unit
    bool refused = false;  // the program said that it has no answer, instead of giving a number
    bool inside = true;    // of the stated domain
};

struct StabilityMap {
    std::string id, title;
    std::string error;    // "largest error of a Mueller entry"
    double bound = 0;     // no cell inside the domain exceeds it
    std::string domain;   // in words: "beta from 1e-4 to 1, all angles"
    std::string outside;  // in words: what the program does there
    std::string caption;
    MapAxis x, y;
    std::vector<MapCell> cells;  // row by row: y is the slow index

    const MapCell& cell(size_t ix, size_t iy) const { return cells[iy * x.at.size() + ix]; }
};

struct MapVerdict {
    double worst_inside = 0;    // NaN counts as infinite
    size_t refused_inside = 0;  // must be 0: inside there is an answer
    size_t silent_outside = 0;  // worse than the bound, not refused, outside the domain: must be 0
    std::string worst_at;       // "theta 89.9, beta 1e-3"
    bool holds(const StabilityMap& map) const {
        return worst_inside <= map.bound && refused_inside == 0 && silent_outside == 0;
    }
};

MapVerdict judge(const StabilityMap& map);

// Cells in colour by the logarithm of their error, the bound marked on the bar, the domain's edge
// drawn, refused cells hatched.
std::string map_svg(const StabilityMap& map);

// Columns map, x, y, error, refused, inside; round-trip precision.
std::string map_csv(const StabilityMap& map);

}  // namespace drude
