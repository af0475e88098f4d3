// Many equally sized pictures on one sheet, with captions.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "image/colour_map.h"
#include "image/picture.h"

namespace drude {

struct Sheet {
    std::string title;                         // "" for none
    std::vector<std::string> row_captions;     // one a row, written to the left
    std::vector<std::string> column_captions;  // one a column, written above
    // cells[row][column]; all of one size, a missing one (0 x 0) leaves its place empty.
    std::vector<std::vector<Picture>> cells;
    std::map<size_t, ColourBar> bars;  // to the right of the row of that index
};

// Dark text on a white ground; the lettering grows with the pictures. Long row captions break at
// blanks. Throws std::logic_error where the shapes do not agree or no cell holds a picture.
Picture compose_sheet(const Sheet& sheet);

}  // namespace drude
