#include "bench/charts/stability.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/numbers.h"
#include "bench/charts/csv.h"
#include "report/heat_map.h"

namespace drude {

namespace {

std::string value_of(const MapAxis& axis, size_t i) {
    return axis.names.empty() ? fmt::format("{:.6g}", axis.at[i]) : axis.names[i];
}

}  // namespace

MapVerdict judge(const StabilityMap& map) {
    if (map.cells.size() != map.x.at.size() * map.y.at.size()) {
        throw std::invalid_argument("judge: cells and grid differ in " + map.id);
    }
    MapVerdict verdict;
    for (size_t iy = 0; iy < map.y.at.size(); ++iy) {
        for (size_t ix = 0; ix < map.x.at.size(); ++ix) {
            const MapCell& cell = map.cell(ix, iy);
            const double error =
                std::isnan(cell.error) ? std::numeric_limits<double>::infinity() : cell.error;
            if (cell.inside) {
                if (cell.refused) ++verdict.refused_inside;
            } else if (!cell.refused && error > map.bound) {
                ++verdict.silent_outside;
            }
            if (cell.inside && !cell.refused &&
                (error > verdict.worst_inside || verdict.worst_at.empty())) {
                verdict.worst_inside = error;
                verdict.worst_at = fmt::format("{} {}, {} {}", map.x.label, value_of(map.x, ix),
                                               map.y.label, value_of(map.y, iy));
            }
        }
    }
    return verdict;
}

std::string map_svg(const StabilityMap& map) {
    HeatMap drawing;
    drawing.title = map.title;
    drawing.description = map.caption;
    drawing.id = map.id;
    drawing.x = map.x.label;
    drawing.y = map.y.label;
    drawing.at_x = map.x.at;
    drawing.at_y = map.y.at;
    drawing.names_x = map.x.names;
    drawing.names_y = map.y.names;
    drawing.value = map.error;
    drawing.bound = map.bound;
    bool refused = false, outside = false;
    for (const MapCell& cell : map.cells) {
        drawing.cells.push_back({cell.error, cell.refused, cell.inside});
        refused |= cell.refused;
        outside |= !cell.inside;
    }
    if (refused) drawing.hatched = "said to have no answer";
    if (outside) drawing.outside = "end of the domain";
    return heat_map(drawing);
}

std::string map_csv(const StabilityMap& map) {
    std::string text = csv_line({"map", map.x.label, map.y.label, "error", "refused", "inside"});
    for (size_t iy = 0; iy < map.y.at.size(); ++iy) {
        for (size_t ix = 0; ix < map.x.at.size(); ++ix) {
            const MapCell& cell = map.cell(ix, iy);
            text += csv_line({map.id, format_double(map.x.at[ix]), format_double(map.y.at[iy]),
                              format_double(cell.error), cell.refused ? "1" : "0",
                              cell.inside ? "1" : "0"});
        }
    }
    return text;
}

}  // namespace drude
