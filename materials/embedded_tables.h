// The text of every table under materials/tables, compiled into the program.
#pragma once

#include <string_view>
#include <vector>

namespace drude {

struct EmbeddedTable {
    std::string_view name;  // the file's name without extension
    std::string_view text;
};

const std::vector<EmbeddedTable>& embedded_tables();

}  // namespace drude
