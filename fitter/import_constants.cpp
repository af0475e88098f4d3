#include "fitter/import_constants.h"

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "base/text_table.h"
#include "fitter/constants_rows.h"
#include "fitter/import_dielectric.h"
#include "fitter/import_refractiveindex.h"
#include "fitter/import_text.h"

namespace drude {

namespace {

const std::vector<std::string>& nk_columns() {
    static const std::vector<std::string> names = {"wavelength_nm", "n", "k", "sigma_n", "sigma_k"};
    return names;
}

bool is_nk_table(const std::string& text) {
    for (const TextLine& line : lines_of(std::string_view(text).substr(0, 65536))) {
        const std::vector<Word> fields = split_fields(line.text, ',');
        if (fields[0].text.empty() || fields[0].text[0] == '#') continue;
        return fields.size() >= 3 && fields[0].text == "wavelength_nm" && fields[1].text == "n" &&
               fields[2].text == "k";
    }
    return false;
}

Material parse_nk_table(const std::string& text, const std::string& file) {
    const TextTable table = parse_text_table(text, file);
    const auto& known = nk_columns();
    for (const std::string& name : table.columns) {
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            user_error("{}: found the column '{}'{}, expected {}", file, shown(name),
                       did_you_mean(name, known), fmt::join(known, ","));
        }
    }
    std::vector<int> at;
    for (const std::string& name : known) at.push_back(table.column(name));
    for (size_t i = 0; i < 3; ++i) {
        if (at[i] < 0) user_error("{}: found no column '{}'", file, known[i]);
    }
    if ((at[3] < 0) != (at[4] < 0)) {
        user_error("{}: found only one of sigma_n and sigma_k, expected both or none", file);
    }
    std::vector<ConstantsRow> rows;
    for (const TableRow& values : table.rows) {
        const auto field = [&](size_t i) {
            return at[i] < 0 ? 0 : values.values[static_cast<size_t>(at[i])];
        };
        rows.push_back({field(0), field(1), field(2), field(3), field(4), values.line});
    }
    Material material;
    OpticalConstants& constants = material.substrate;
    constants.name = table.header_value("name");
    constants.material = table.header_value("material");
    constants.kind = table.header_value("kind");
    constants.citation = table.header_value("citation");
    fill_constants(std::move(rows), file, constants, material.provenance.warnings);
    return material;
}

}  // namespace

const std::vector<std::string>& constants_formats() {
    static const std::vector<std::string> names = {"refractiveindex", "spectraray-dielectric",
                                                   "nk"};
    return names;
}

std::string recognise_constants(const std::string& text) {
    if (is_nk_table(text)) return "nk";
    if (is_spectraray_dielectric(text)) return "spectraray-dielectric";
    if (is_refractiveindex_info(text)) return "refractiveindex";
    return "";
}

Material parse_constants_as(const std::string& text, const std::string& file,
                            const std::string& format) {
    Material material;
    if (format == "refractiveindex") {
        material = parse_refractiveindex_info(text, file);
    } else if (format == "spectraray-dielectric") {
        material = parse_spectraray_dielectric(text, file);
    } else if (format == "nk") {
        material = parse_nk_table(text, file);
    } else {
        user_error("found the format '{}'{}, expected {}", format,
                   did_you_mean(format, constants_formats()), fmt::join(constants_formats(), ", "));
    }
    OpticalConstants& constants = material.substrate;
    if (constants.name.empty()) constants.name = std::filesystem::path(file).stem().string();
    if (constants.name.empty()) constants.name = "imported";
    material.name = constants.name;
    material.check();
    return material;
}

}  // namespace drude
