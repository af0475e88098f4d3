// A grid of values as coloured cells, SVG in the manner of svg_plot().
#pragma once

#include <string>
#include <vector>

namespace drude {

struct HeatCell {
    double value = 0;      // logarithmic colour; <= 0 takes the lowest, NaN and infinities magenta
    bool hatched = false;  // no value: the cell is left empty but for a hatching
    bool inside = true;    // the border between inside and outside is drawn
};

struct HeatMap {
    std::string title, description, id = "map";
    std::string x, y;                // labels of the axes
    std::vector<double> at_x, at_y;  // one a column and a row; the first row stands at the bottom
    std::vector<std::string> names_x, names_y;  // in place of the values; none or one each
    std::vector<HeatCell> cells;                // at_x.size() * at_y.size(), row by row
    std::string value;                          // label of the colour bar
    double bound = 0;                           // marked on the bar; none where not > 0
    std::string hatched, outside;               // of the legend
    int width = 560, height = 360;
};

// Throws std::invalid_argument where the number of cells is not that of the grid or a side of the
// grid is empty.
std::string heat_map(const HeatMap& map);

}  // namespace drude
