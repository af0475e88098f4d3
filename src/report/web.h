// Styles and scripts of pages (src/report/web), compiled into the program.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "materials/embedded_tables.h"

namespace drude {

// src/report/web/*.css and *.js
const std::vector<EmbeddedTable>& embedded_styles();
const std::vector<EmbeddedTable>& embedded_scripts();

// The text of src/report/web/NAME.css or NAME.js; std::logic_error where there is none.
std::string web_style(std::string_view name);
std::string web_script(std::string_view name);

}  // namespace drude
