#include "report/web.h"

#include <stdexcept>

namespace drude {

namespace {

std::string named(const std::vector<EmbeddedTable>& files, std::string_view name) {
    for (const EmbeddedTable& file : files) {
        if (file.name == name) return std::string(file.text);
    }
    throw std::logic_error("no web file " + std::string(name));
}

}  // namespace

std::string web_style(std::string_view name) {
    return named(embedded_styles(), name);
}

std::string web_script(std::string_view name) {
    return named(embedded_scripts(), name);
}

}  // namespace drude
