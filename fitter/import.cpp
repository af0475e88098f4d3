#include "fitter/import.h"

#include <algorithm>

#include "base/error.h"
#include "base/files.h"
#include "fitter/import_spectraray.h"

namespace drude {

namespace {

// The first line that is neither blank nor a "#" comment.
std::string_view first_line_of_content(std::string_view text) {
    if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
    while (!text.empty()) {
        const size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const size_t begin = line.find_first_not_of(" \t\r");
        if (begin == std::string_view::npos || line[begin] == '#') continue;
        return line.substr(begin);
    }
    return {};
}

}  // namespace

const std::vector<std::string>& measurement_formats() {
    static const std::vector<std::string> names = {"auto", "csv", "spectraray"};
    return names;
}

std::string recognise_measurement(const std::string& text) {
    if (is_spectraray_psi_delta(text)) return "spectraray";
    const std::string_view line = first_line_of_content(text);
    if (line.find("wavelength_nm") != std::string_view::npos &&
        line.find(',') != std::string_view::npos) {
        return "csv";
    }
    return "";
}

Measurement parse_measurement_as(const std::string& text, const std::string& file,
                                 const std::string& format) {
    const auto& known = measurement_formats();
    if (std::find(known.begin(), known.end(), format) == known.end()) {
        user_error("found the format '{}'{}, expected {}", format, did_you_mean(format, known),
                   fmt::join(known, ", "));
    }
    const std::string found = format == "auto" ? recognise_measurement(text) : format;
    if (found == "csv") return parse_measurement(text, file);
    if (found == "spectraray") return parse_spectraray(text, file);
    const bool empty = text.find_first_not_of(" \t\r\n") == std::string::npos;
    user_error(
        "{}: {}; expected a measurement of Psi and Delta: a table with the columns "
        "wavelength_nm,angle_deg,psi_deg,delta_deg (csv), or an export that starts with "
        "'; WAVELENGTH' (spectraray)",
        file, empty ? "found an empty file" : "found none of the formats known");
}

Measurement import_measurement(const std::string& path, const std::string& format) {
    return parse_measurement_as(read_file(path), path, format);
}

}  // namespace drude
