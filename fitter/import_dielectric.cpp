#include "fitter/import_dielectric.h"

#include <cmath>
#include <complex>
#include <optional>

#include "fitter/constants_rows.h"
#include "fitter/import_text.h"

namespace drude {

namespace {

std::string key_of(std::string_view line) {
    return lower_case(utf8(line));
}

SpectralUnit unit_in(const std::string& line, const Place& place) {
    const std::string value = line.substr(line.find('=') + 1);
    const size_t comma = value.find(',');
    const std::string axis = utf8(value.substr(0, comma));
    const std::string columns = comma == value.npos ? "" : utf8(value.substr(comma + 1));
    if (!columns.empty() && columns != "e1e2") {
        user_error_at(place, "found the columns '{}', expected E1E2 (Re and Im of epsilon)",
                      shown(columns));
    }
    if (axis == "wavelength") return SpectralUnit::nm;
    if (const auto unit = spectral_unit(axis)) return *unit;
    user_error_at(place, "found the units '{}', expected Wavelength (nm) or eV", shown(value));
}

// The root of epsilon in the first quadrant. Im below 0 counts as noise around 0: the sign is kept
// in k, where fill_constants sees and names it.
ConstantsRow from_epsilon(double nm, double e1, double e2, const Place& place) {
    const std::complex<double> root = std::sqrt(std::complex<double>(e1, std::abs(e2)));
    ConstantsRow row;
    row.wavelength_nm = nm;
    row.n = root.real();
    row.k = std::copysign(root.imag(), e2);
    row.line = place.line;
    if (!(row.n > 0)) {
        user_error_at(place,
                      "found epsilon = {} + {}i, which gives n = 0; expected an absorber (Im above "
                      "0) or Re above 0",
                      e1, e2);
    }
    if (e2 < 0 && e1 < 0) {
        user_error_at(place,
                      "found epsilon = {} + {}i, a metal that amplifies; expected Im of at least 0",
                      e1, e2);
    }
    return row;
}

}  // namespace

bool is_spectraray_dielectric(const std::string& text) {
    bool units = false, array = false;
    for (const TextLine& line : lines_of(text)) {
        if (line.text.empty() || (line.text[0] | 0x20) < 'b' || (line.text[0] | 0x20) > 'u')
            continue;
        const std::string key = key_of(line.text.substr(0, 80));
        units = units || key.substr(0, 6) == "units=";
        array = array || key == "begin of array";
    }
    return units && array;
}

Material parse_spectraray_dielectric(const std::string& text, const std::string& file) {
    enum class Part { head, array, end } part = Part::head;
    std::optional<SpectralUnit> unit;
    std::vector<ConstantsRow> rows;
    for (const TextLine& line : lines_of(text)) {
        const std::vector<Word> words = split_blanks(line.text);
        const Place place{file, line.number, 0};
        if (words.empty() || part == Part::end) continue;
        const std::string key = key_of(line.text);
        if (part == Part::head) {
            if (key.substr(0, 6) == "units=") unit = unit_in(key, place);
            if (key != "begin of array") continue;
            if (!unit) {
                user_error_at(place,
                              "found an array, expected 'Units=Wavelength,E1E2' or "
                              "'Units=eV,E1E2' above it");
            }
            part = Part::array;
        } else if (key == "end of array") {
            part = Part::end;
        } else {
            if (words.size() < 3) {
                user_error_at(place, "found {} fields, expected three: {}, Re and Im of epsilon",
                              words.size(),
                              *unit == SpectralUnit::electronvolt ? "eV" : "wavelength");
            }
            const double nm = parse_wavelength_nm(words[0], place, *unit);
            rows.push_back(from_epsilon(nm, parse_number(words[1], place),
                                        parse_number(words[2], place), place));
        }
    }
    if (part == Part::head) user_error("{}: found no line 'Begin of array'", file);
    if (part == Part::array)
        user_error("{}: found no line 'End of array': is the file whole?", file);
    Material material;
    material.substrate.kind = "measured";
    fill_constants(std::move(rows), file, material.substrate, material.provenance.warnings);
    return material;
}

}  // namespace drude
