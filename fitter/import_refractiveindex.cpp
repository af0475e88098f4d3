#include "fitter/import_refractiveindex.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "fitter/constants_rows.h"
#include "fitter/import_text.h"
#include "fitter/refractiveindex_formula.h"

namespace drude {

namespace {

// Where a formula may be tabulated, nm: wider than the database (0.01 nm to 2 mm).
constexpr double shortest_nm = 1e-3, longest_nm = 1e8;

struct Sample {
    double wavelength_nm = 0, value = 0;
    int line = 0;
};
using Curve = std::vector<Sample>;

struct Entries {
    std::vector<ConstantsRow> nk;
    Curve n, k;
    bool from_formula = false;
};

std::vector<std::string> known_types() {
    std::vector<std::string> types = {"tabulated nk", "tabulated n", "tabulated k"};
    for (int i = first_refractiveindex_formula; i <= last_refractiveindex_formula; ++i) {
        types.push_back(fmt::format("formula {}", i));
    }
    return types;
}

Place place_of(const YAML::Node& node, const std::string& file) {
    const YAML::Mark mark = node.Mark();
    if (mark.is_null()) return {file, 0, 0};
    return {file, mark.line + 1, mark.column + 1};
}

// The scalar of a key of an entry.
YAML::Node wanted(const YAML::Node& entry, const char* key, const std::string& file) {
    const YAML::Node value = entry[key];
    if (!value || !value.IsScalar()) {
        user_error_at(place_of(entry, file), "found no '{}' with text, expected one in this entry",
                      key);
    }
    return value;
}

// The line that the first line of a scalar's text stands on: a block ("|") has it below its mark.
int first_line(const YAML::Node& scalar, const std::vector<TextLine>& lines) {
    const int line = scalar.Mark().line + 1;
    if (line < 1 || static_cast<size_t>(line) > lines.size()) return 0;
    const std::string_view text = lines[static_cast<size_t>(line) - 1].text;
    const auto column = static_cast<size_t>(std::max(scalar.Mark().column, 0));
    const bool block = column < text.size() && (text[column] == '|' || text[column] == '>');
    return block ? line + 1 : line;
}

std::vector<double> numbers_in(const YAML::Node& scalar, const std::string& file) {
    Place place = place_of(scalar, file);
    std::vector<double> numbers;
    for (const Word& word : split_blanks(scalar.Scalar())) {
        const auto value = number_in(word.text);
        if (!value) {
            user_error_at(place, "found '{}', expected finite numbers between blanks",
                          shown(word.text));
        }
        numbers.push_back(*value);
    }
    return numbers;
}

void read_table(const YAML::Node& data, const std::string& type, const std::string& file,
                const std::vector<TextLine>& lines, Entries& entries) {
    const size_t columns = type == "tabulated nk" ? 3 : 2;
    const int first = first_line(data, lines);
    for (const TextLine& line : lines_of(data.Scalar())) {
        const std::vector<Word> words = split_blanks(line.text);
        // Columns are those of the text inside the block, not of the file: left out.
        const Place place{file, first > 0 ? first + line.number - 1 : 0, 0};
        if (words.empty()) continue;
        if (words.size() != columns) {
            user_error_at(place, "found {} numbers, expected {}: wavelength and {}", words.size(),
                          columns, type.substr(10));
        }
        const auto word = [&](size_t i) { return Word{words[i].text, 0}; };
        const double nm = parse_wavelength_nm(word(0), place, SpectralUnit::micrometre);
        const double value = parse_number(word(1), place);
        if (columns == 3) {
            entries.nk.push_back({nm, value, parse_number(word(2), place), 0, 0, place.line});
        } else {
            (type == "tabulated n" ? entries.n : entries.k).push_back({nm, value, place.line});
        }
    }
}

void read_formula(const YAML::Node& entry, int formula, const std::string& file, Entries& entries) {
    const YAML::Node text = wanted(entry, "coefficients", file);
    const std::vector<double> coefficients = numbers_in(text, file);
    const Place place = place_of(text, file);
    if (coefficients.empty() || coefficients.size() > most_coefficients(formula)) {
        user_error_at(place, "found {} coefficients, expected 1 to {} for formula {}",
                      coefficients.size(), most_coefficients(formula), formula);
    }
    const char* key = entry["wavelength_range"] ? "wavelength_range" : "range";
    const YAML::Node range = wanted(entry, key, file);
    const std::vector<double> ends = numbers_in(range, file);
    if (ends.size() != 2 || !(ends[0] * 1000 >= shortest_nm) || !(ends[1] >= ends[0]) ||
        !(ends[1] * 1000 <= longest_nm)) {
        user_error_at(place_of(range, file),
                      "found '{}', expected the first and the last wavelength in micrometres, from "
                      "{} to {}",
                      shown(range.Scalar()), shortest_nm / 1000, longest_nm / 1000);
    }
    const double first = ends[0] * 1000, last = ends[1] * 1000;
    for (double nm = first;; nm = std::min(last, std::max(std::floor(nm) + 1, nm * 1.001))) {
        const double n = refractiveindex_formula(formula, coefficients, nm / 1000);
        if (!std::isfinite(n) || n <= 0) {
            user_error_at(place,
                          "found no real n at {} nm: formula {} gives {}; expected one in the "
                          "whole range of {} to {} micrometres",
                          nm, formula, n, ends[0], ends[1]);
        }
        entries.n.push_back({nm, n, place.line});
        if (nm >= last) break;
    }
    entries.from_formula = true;
}

void sort_curve(Curve& curve) {
    std::stable_sort(curve.begin(), curve.end(), [](const Sample& a, const Sample& b) {
        return a.wavelength_nm < b.wavelength_nm;
    });
}

// Linear between samples; the curve is sorted and holds the wavelength in its range.
double interpolate(const Curve& curve, double nm) {
    const auto above = std::lower_bound(
        curve.begin(), curve.end(), nm,
        [](const Sample& sample, double wavelength) { return sample.wavelength_nm < wavelength; });
    if (above->wavelength_nm == nm || above == curve.begin()) return above->value;
    const Sample &b = *above, &a = *(above - 1);
    return std::lerp(a.value, b.value,
                     (nm - a.wavelength_nm) / (b.wavelength_nm - a.wavelength_nm));
}

// n and k from entries of their own, where both are known.
std::vector<ConstantsRow> joined(Curve n, Curve k, const std::string& file,
                                 std::vector<std::string>& warnings) {
    if (n.empty()) {
        user_error("{}: found k without n, expected both or n: no metal can be made of k alone",
                   file);
    }
    std::vector<ConstantsRow> rows;
    if (k.empty()) {
        warnings.push_back("the file holds no k; taken for 0, a transparent material");
        for (const Sample& sample : n) {
            rows.push_back({sample.wavelength_nm, sample.value, 0, 0, 0, sample.line});
        }
        return rows;
    }
    sort_curve(n);
    sort_curve(k);
    const double first = std::max(n.front().wavelength_nm, k.front().wavelength_nm);
    const double last = std::min(n.back().wavelength_nm, k.back().wavelength_nm);
    if (first > last) {
        user_error("{}: found n from {} to {} nm and k from {} to {} nm, expected both somewhere",
                   file, n.front().wavelength_nm, n.back().wavelength_nm, k.front().wavelength_nm,
                   k.back().wavelength_nm);
    }
    Curve all = n;
    all.insert(all.end(), k.begin(), k.end());
    sort_curve(all);
    for (size_t i = 0; i < all.size(); ++i) {
        const double nm = all[i].wavelength_nm;
        if (nm < first || nm > last || (i > 0 && all[i - 1].wavelength_nm == nm)) continue;
        rows.push_back({nm, interpolate(n, nm), interpolate(k, nm), 0, 0, all[i].line});
    }
    return rows;
}

// The text of REFERENCES without the markup of web pages.
std::string plain_text(const YAML::Node& node) {
    if (!node || !node.IsScalar()) return {};
    std::string result;
    bool tag = false, blank = false;
    for (const char c : utf8(node.Scalar())) {
        if (c == '<') tag = true;
        const bool is_blank = c == ' ' || c == '\n' || c == '\r' || c == '\t' || tag;
        if (c == '>' && tag) {
            tag = false;
        } else if (is_blank) {
            blank = blank || !tag;
        } else {
            if (blank && !result.empty()) result += ' ';
            blank = false;
            result += c;
        }
    }
    return result;
}

Entries read_entries(const YAML::Node& data, const std::string& file,
                     const std::vector<TextLine>& lines) {
    const std::vector<std::string> types = known_types();
    Entries entries;
    for (const YAML::Node& entry : data) {
        const Place place = place_of(entry, file);
        if (!entry.IsMap()) user_error_at(place, "found no entry with a type below DATA");
        const YAML::Node type_node = wanted(entry, "type", file);
        const std::string type = type_node.Scalar();
        const auto known = std::find(types.begin(), types.end(), type);
        if (known == types.end()) {
            user_error_at(place_of(type_node, file), "found the type '{}'{}, expected {}",
                          shown(type), did_you_mean(type, types), fmt::join(types, ", "));
        }
        const bool has_n = type != "tabulated k", has_k = type == "tabulated nk" || !has_n;
        if ((has_n && (!entries.n.empty() || !entries.nk.empty())) ||
            (has_k && (!entries.k.empty() || !entries.nk.empty()))) {
            user_error_at(place,
                          "found a second entry of {}, expected one: cut the file to the one that "
                          "is wanted",
                          has_n ? "n" : "k");
        }
        if (type.substr(0, 9) == "tabulated") {
            read_table(wanted(entry, "data", file), type, file, lines, entries);
        } else {
            const auto number = static_cast<int>(known - types.begin()) - 3;
            read_formula(entry, first_refractiveindex_formula + number, file, entries);
        }
    }
    return entries;
}

}  // namespace

bool is_refractiveindex_info(const std::string& text) {
    bool data = false;
    for (const TextLine& line : lines_of(text)) {
        const std::vector<Word> words = split_blanks(line.text);
        if (!words.empty() && words[0].text == "DATA:" && words[0].column == 1) data = true;
        if (data && (line.text.find("type: tabulated") != line.text.npos ||
                     line.text.find("type: formula") != line.text.npos)) {
            return true;
        }
    }
    return false;
}

Material parse_refractiveindex_info(const std::string& text, const std::string& file) {
    Material material;
    OpticalConstants& constants = material.substrate;
    auto& warnings = material.provenance.warnings;
    const std::vector<TextLine> lines = lines_of(text);
    try {
        const YAML::Node root = YAML::Load(text);
        if (!root.IsMap() || !root["DATA"] || !root["DATA"].IsSequence()) {
            user_error("{}: found no list under 'DATA:', expected one with tables or formulae",
                       file);
        }
        constants.citation = plain_text(root["REFERENCES"]);
        Entries entries = read_entries(root["DATA"], file, lines);
        constants.kind = entries.from_formula ? "calculated" : "measured";
        if (entries.nk.empty() && !(entries.n.empty() && entries.k.empty())) {
            entries.nk = joined(std::move(entries.n), std::move(entries.k), file, warnings);
        }
        fill_constants(std::move(entries.nk), file, constants, warnings);
    } catch (const YAML::Exception& error) {
        const Place place{file, error.mark.is_null() ? 0 : error.mark.line + 1,
                          error.mark.is_null() ? 0 : error.mark.column + 1};
        user_error_at(place, "found text that is no YAML of the database ({})", shown(error.msg));
    }
    return material;
}

}  // namespace drude
