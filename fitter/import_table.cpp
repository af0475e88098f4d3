#include "fitter/import_table.h"

#include <algorithm>
#include <array>
#include <optional>

#include "fitter/import_text.h"

namespace drude {

namespace {

enum Column : size_t { spectral, angle, psi, delta, sigma_psi, sigma_delta, depol, column_count };
constexpr std::array<const char*, column_count> column_names = {
    "wavelength", "angle", "psi", "delta", "sigma psi", "sigma delta", "depolarization"};
constexpr int absent = -1;

bool is_comment(std::string_view line) {
    const std::vector<Word> words = split_blanks(line);
    return words.empty() || words[0].text[0] == '#' || words[0].text[0] == '%' ||
           words[0].text.substr(0, 2) == "//";
}

char separator_of(std::string_view line) {
    for (const char c : {';', '\t', ','}) {
        if (line.find(c) != line.npos) return c;
    }
    return ' ';
}

std::vector<Word> fields_of(std::string_view line, char separator) {
    std::vector<Word> fields =
        separator == ' ' ? split_blanks(line) : split_fields(line, separator);
    for (Word& field : fields) {
        const auto quoted = [&](char c) {
            return field.text.size() >= 2 && field.text.front() == c && field.text.back() == c;
        };
        if (quoted('"') || quoted('\'')) {
            field.text = field.text.substr(1, field.text.size() - 2);
            ++field.column;
        }
    }
    // A separator at the end of the line makes no field.
    while (fields.size() > 1 && fields.back().text.empty()) fields.pop_back();
    return fields;
}

// Greek letters by name, as people write them in spreadsheets.
std::string spelled_out(std::string text) {
    const std::array<std::pair<const char*, const char*>, 9> letters = {{{"\xCE\xA8", "psi"},
                                                                         {"\xCF\x88", "psi"},
                                                                         {"\xCE\x94", "delta"},
                                                                         {"\xCE\xB4", "delta"},
                                                                         {"\xE2\x88\x86", "delta"},
                                                                         {"\xCE\xBB", "lambda"},
                                                                         {"\xCE\xB8", "theta"},
                                                                         {"\xCF\x83", "sigma"},
                                                                         {"\xC2\xB0", "deg"}}};
    for (const auto& [letter, name] : letters) {
        for (size_t at = text.find(letter); at != text.npos; at = text.find(letter, at)) {
            text.replace(at, std::string_view(letter).size(), name);
        }
    }
    return text;
}

// A name of a column: what it is, and the unit that it carries.
struct Name {
    std::optional<Column> column;
    std::optional<SpectralUnit> unit;
    bool percent = false;
};

Name understand(std::string_view field) {
    Name result;
    std::string text = lower_case(spelled_out(utf8(field)));
    result.percent = text.find('%') != text.npos;
    std::string unit, name;
    if (const size_t open = text.find_first_of("(["); open != text.npos) {
        const size_t close = text.find_first_of(")]", open);
        unit = text.substr(open + 1, close == text.npos ? close : close - open - 1);
        text.resize(open);
    }
    // The last part behind a blank, "_" or "/" is a unit where it reads as one.
    const size_t last = text.find_last_of(" _/");
    if (unit.empty() && last != text.npos && last > 0 && text.substr(last - 1) != "1/cm" &&
        spectral_unit(text.substr(last + 1))) {
        unit = text.substr(last + 1);
        text.resize(last);
    }
    for (const char c : text) {
        if (c >= 'a' && c <= 'z') name += c;
    }
    for (const char* degree : {"degrees", "deg"}) {
        const size_t length = std::string_view(degree).size();
        if (name.size() > length && name.substr(name.size() - length) == degree) {
            name.resize(name.size() - length);
        }
    }
    const auto is = [&](std::initializer_list<const char*> names) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    const auto is_sigma_of = [&](const std::string& of) {
        for (const char* word : {"sigma", "std", "err", "error", "sig", "stddev", "sd"}) {
            if (name == word + of || name == of + word) return true;
        }
        return name == "d" + of;
    };
    result.unit = spectral_unit(unit);
    if (is({"wavelength", "lambda", "wl", "wavelengths"})) {
        result.column = spectral;
    } else if (is({"energy", "photonenergy"})) {
        result.column = spectral;
        if (!result.unit) result.unit = SpectralUnit::electronvolt;
    } else if (const auto bare = spectral_unit(text); bare && text != "a") {
        result.column = spectral;
        result.unit = bare;
    } else if (is({"angle", "aoi", "theta", "angleofincidence", "incidenceangle", "phi"})) {
        result.column = angle;
    } else if (name == "psi") {
        result.column = psi;
    } else if (name == "delta") {
        result.column = delta;
    } else if (is_sigma_of("psi")) {
        result.column = sigma_psi;
    } else if (is_sigma_of("delta")) {
        result.column = sigma_delta;
    } else if (is({"depolarization", "depolarisation", "depol", "dpol"})) {
        result.column = depol;
    }
    return result;
}

struct Header {
    std::array<int, column_count> at;
    SpectralUnit unit = SpectralUnit::nm;
    bool percent = false;
    size_t fields = 0;
    std::vector<std::string> unknown;

    bool has(Column column) const { return at[column] != absent; }
    bool complete() const { return has(spectral) && has(angle) && has(psi) && has(delta); }
};

Header read_names(const std::vector<Word>& fields, const Place& place, bool throws) {
    Header header;
    header.at.fill(absent);
    header.fields = fields.size();
    for (size_t i = 0; i < fields.size(); ++i) {
        const Name name = understand(fields[i].text);
        if (!name.column) {
            header.unknown.push_back(utf8(fields[i].text));
            continue;
        }
        if (throws && header.has(*name.column)) {
            user_error_at({place.file, place.line, fields[i].column},
                          "found a second column of {}: '{}'", column_names[*name.column],
                          shown(fields[i].text));
        }
        header.at[*name.column] = static_cast<int>(i);
        if (*name.column == spectral && name.unit) header.unit = *name.unit;
        if (*name.column == depol) header.percent = name.percent;
    }
    return header;
}

Header unnamed(const std::vector<Word>& fields, const Place& place) {
    if (fields.size() != 4 && fields.size() != 6 && fields.size() != 7) {
        user_error_at(place,
                      "found {} numbers and no names of columns, expected wavelength in nm, angle, "
                      "Psi, Delta[, sigma of Psi, sigma of Delta[, depolarization]]",
                      fields.size());
    }
    Header header;
    header.fields = fields.size();
    for (size_t i = 0; i < column_count; ++i) {
        header.at[i] = i < fields.size() ? static_cast<int>(i) : absent;
    }
    return header;
}

void check_names(const Header& header, const Place& place) {
    for (const Column column : {spectral, angle, psi, delta}) {
        if (header.has(column)) continue;
        user_error_at(place, "found no column '{}', expected wavelength, angle, psi and delta",
                      column_names[column]);
    }
    if (header.has(sigma_psi) != header.has(sigma_delta)) {
        user_error_at(place, "found only one of sigma psi and sigma delta, expected both or none");
    }
}

// A line below the names with no number in it.
bool are_units(const std::vector<Word>& fields) {
    return std::none_of(fields.begin(), fields.end(), [](const Word& field) {
        return number_in(field.text) || lower_case(field.text) == "nan" ||
               lower_case(field.text) == "inf";
    });
}

void take_units(const std::vector<Word>& fields, Header& header) {
    const auto field = [&](Column column) -> std::string_view {
        const auto at = static_cast<size_t>(header.at[column]);
        return header.has(column) && at < fields.size() ? fields[at].text : std::string_view{};
    };
    if (const auto unit = spectral_unit(field(spectral))) header.unit = *unit;
    if (field(depol) == "%") header.percent = true;
}

MeasurementRow read_row(const std::vector<Word>& fields, const Header& header, const Place& place) {
    if (fields.size() != header.fields) {
        user_error_at(place, "found {} fields, expected {}", fields.size(), header.fields);
    }
    const auto field = [&](Column column) {
        return fields[static_cast<size_t>(header.at[column])];
    };
    MeasurementRow row;
    row.wavelength_nm = parse_wavelength_nm(field(spectral), place, header.unit);
    row.angle_deg = parse_number(field(angle), place);
    row.psi_deg = parse_number(field(psi), place);
    row.delta_deg = parse_number(field(delta), place);
    if (header.has(sigma_psi) && header.has(sigma_delta)) {
        row.sigma_psi_deg = parse_number(field(sigma_psi), place);
        row.sigma_delta_deg = parse_number(field(sigma_delta), place);
    }
    if (header.has(depol)) {
        row.depolarization = parse_scaled(field(depol), place, header.percent ? -2 : 0);
        if (row.depolarization < 0 || row.depolarization > 1) {
            user_error_at({place.file, place.line, field(depol).column},
                          "found the depolarization '{}', expected 0 to {}",
                          shown(field(depol).text), header.percent ? "100 %" : "1");
        }
    }
    row.line = place.line;
    return row;
}

}  // namespace

bool is_named_table(const std::string& text) {
    for (const TextLine& line : lines_of(std::string_view(text).substr(0, 65536))) {
        if (is_comment(line.text)) continue;
        return read_names(fields_of(line.text, separator_of(line.text)), {}, false).complete();
    }
    return false;
}

Measurement parse_named_table(const std::string& text, const std::string& file) {
    Measurement measurement;
    measurement.file = file;
    measurement.header = {{"imported_from", "table"}};
    std::optional<Header> header;
    char separator = ' ';
    bool below_names = false;
    for (const TextLine& line : lines_of(text)) {
        if (is_comment(line.text)) continue;
        const Place place{file, line.number, 0};
        if (!header) separator = separator_of(line.text);
        const std::vector<Word> fields = fields_of(line.text, separator);
        if (!header && number_in(fields[0].text)) {
            header = unnamed(fields, place);
        } else if (!header) {
            header = read_names(fields, place, true);
            check_names(*header, place);
            below_names = true;
            continue;
        } else if (below_names && are_units(fields)) {
            take_units(fields, *header);
            below_names = false;
            continue;
        }
        below_names = false;
        measurement.rows.push_back(read_row(fields, *header, place));
    }
    if (!header) user_error("{}: found an empty file, expected a table with names", file);
    if (!header->unknown.empty()) {
        add_warning(measurement, fmt::format("columns that mean nothing here were left out: {}",
                                             fmt::join(header->unknown, ", ")));
    }
    measurement.check();
    return measurement;
}

}  // namespace drude
