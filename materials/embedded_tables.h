// Text files compiled into the program, so that it needs no data folder.
#pragma once

#include <string_view>
#include <vector>

namespace drude {

struct EmbeddedTable {
    std::string_view name;  // the file's name without extension
    std::string_view text;
};

// materials/tables/*.csv
const std::vector<EmbeddedTable>& embedded_tables();
// scenes/*.pbrt; linked with the renderer.
const std::vector<EmbeddedTable>& embedded_scenes();

}  // namespace drude
