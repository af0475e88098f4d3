#include "fitter/import.h"

#include <algorithm>
#include <array>

#include "base/error.h"
#include "base/files.h"
#include "fitter/import_accurion.h"
#include "fitter/import_filmsense.h"
#include "fitter/import_horiba.h"
#include "fitter/import_spectraray.h"
#include "fitter/import_table.h"
#include "fitter/import_text.h"
#include "fitter/import_woollam.h"

namespace drude {

namespace {

bool is_csv(const std::string& text) {
    for (const TextLine& line : lines_of(std::string_view(text).substr(0, 65536))) {
        const std::vector<Word> words = split_blanks(line.text);
        if (words.empty() || words[0].text[0] == '#') continue;
        // The table of optical constants begins the same way (import_constants.h).
        return line.text.find("wavelength_nm") != line.text.npos &&
               line.text.find(',') != line.text.npos &&
               lower_case(line.text).find(",n,k") == std::string::npos;
    }
    return false;
}

bool is_wvase(const std::string& text) {
    return is_woollam(text) && !is_complete_ease(text);
}
bool is_completeease(const std::string& text) {
    return is_woollam(text) && is_complete_ease(text);
}

struct Format {
    const char* name;
    bool (*starts)(const std::string& text);
    Measurement (*parse)(const std::string& text, const std::string& file);
};

// In the order in which they are asked: the ones with a mark of their own first.
constexpr std::array<Format, 8> formats = {
    {{"spectraray", is_spectraray_psi_delta, parse_spectraray},
     {"filmsense", is_film_sense, parse_film_sense},
     {"completeease", is_completeease, parse_woollam},
     {"wvase", is_wvase, parse_woollam},
     {"accurion", is_accurion, parse_accurion},
     {"csv", is_csv, parse_measurement},
     {"horiba", is_horiba, parse_horiba},
     {"table", is_named_table, parse_named_table}}};

[[noreturn]] void none_of_them(const std::string& text, const std::string& file) {
    const std::string_view start = std::string_view(text).substr(0, 2);
    const bool empty = text.find_first_not_of(" \t\r\n") == std::string::npos;
    if (start == "\xFF\xFE" || start == "\xFE\xFF") {
        user_error("{}: found text in UTF-16, expected UTF-8 or Latin-1: save it as UTF-8", file);
    }
    user_error(
        "{}: {}; expected a measurement of Psi and Delta: a table with the names wavelength_nm,"
        "angle_deg,psi_deg,delta_deg (csv) or the like (table), or an export of SpectraRay, "
        "CompleteEASE, WVASE, Accurion, Horiba (.spe) or Film Sense; a table without names is read "
        "with --format table",
        file, empty ? "found an empty file" : "found none of the formats known");
}

}  // namespace

const std::vector<std::string>& measurement_formats() {
    static const std::vector<std::string> names = {"auto",         "csv",       "spectraray",
                                                   "completeease", "wvase",     "accurion",
                                                   "horiba",       "filmsense", "table"};
    return names;
}

std::string recognise_measurement(const std::string& text) {
    const auto found = std::find_if(formats.begin(), formats.end(),
                                    [&](const Format& format) { return format.starts(text); });
    return found == formats.end() ? "" : found->name;
}

Measurement parse_measurement_as(const std::string& text, const std::string& file,
                                 const std::string& format) {
    const auto& known = measurement_formats();
    if (std::find(known.begin(), known.end(), format) == known.end()) {
        user_error("found the format '{}'{}, expected {}", format, did_you_mean(format, known),
                   fmt::join(known, ", "));
    }
    const std::string name = format == "auto" ? recognise_measurement(text) : format;
    const auto found = std::find_if(formats.begin(), formats.end(),
                                    [&](const Format& one) { return one.name == name; });
    if (found == formats.end()) none_of_them(text, file);
    return found->parse(text, file);
}

Measurement import_measurement(const std::string& path, const std::string& format) {
    return parse_measurement_as(read_file(path), path, format);
}

std::vector<std::string> import_warnings(const Measurement& measurement) {
    std::vector<std::string> warnings;
    for (const auto& [key, value] : measurement.header) {
        if (key == "warning") warnings.push_back(value);
    }
    return warnings;
}

}  // namespace drude
