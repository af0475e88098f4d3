#include "fitter/import_spectraray.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "base/error.h"
#include "fitter/import_text.h"

namespace drude {

namespace {

// The words after "; WAVELENGTH" (also written ";WAVELENGTH"), or nothing for another line.
std::vector<Word> header_angles(std::string_view line, bool* is_header) {
    std::vector<Word> words = split_blanks(line);
    *is_header = false;
    if (words.empty() || words[0].text[0] != ';') return {};
    if (words[0].text == ";") {
        words.erase(words.begin());
    } else {
        words[0].text.remove_prefix(1);
    }
    if (words.empty()) return {};
    if (lower_case(words[0].text).substr(0, 10) != "wavelength") return {};
    *is_header = true;
    words.erase(words.begin());
    return words;
}

std::vector<double> parse_angles(const std::vector<Word>& words, const Place& line) {
    std::vector<double> columns;
    for (const Word& word : words) columns.push_back(parse_number(word, line));
    if (columns.empty()) {
        user_error_at(line, "found no angle of incidence after the label, expected each one twice");
    }
    const bool same = std::all_of(columns.begin(), columns.end(),
                                  [&](double angle) { return angle == columns.front(); });
    if (columns.size() == 16 && same) {
        user_error_at(line,
                      "found 16 columns at {} degrees, a Mueller matrix; expected Psi and Delta: "
                      "export those",
                      columns.front());
    }
    std::vector<double> angles;
    for (size_t i = 0; i < columns.size(); i += 2) {
        const Place place{line.file, line.line, words[i].column};
        if (i + 1 == columns.size()) {
            user_error_at(place, "found the angle {} once, expected it twice (Psi, Delta)",
                          columns[i]);
        }
        if (columns[i] != columns[i + 1]) {
            user_error_at(place,
                          "found the angles {} and {} for one pair of columns, expected the same "
                          "angle for Psi and Delta",
                          columns[i], columns[i + 1]);
        }
        if (std::find(angles.begin(), angles.end(), columns[i]) != angles.end()) {
            user_error_at(place, "found the angle {} for two pairs of columns", columns[i]);
        }
        angles.push_back(columns[i]);
    }
    return angles;
}

}  // namespace

bool is_spectraray_psi_delta(const std::string& text) {
    bool is_header = false;
    for (const TextLine& line : lines_of(std::string_view(text).substr(0, 4096))) {
        if (split_blanks(line.text).empty()) continue;
        header_angles(line.text, &is_header);
        break;
    }
    return is_header;
}

Measurement parse_spectraray(const std::string& text, const std::string& file) {
    Measurement measurement;
    measurement.file = file;
    measurement.header = {{"imported_from", "SpectraRay ASCII"}};
    std::vector<double> angles;
    std::map<double, int> line_of_wavelength;
    for (const auto& [line, number] : lines_of(text)) {
        const Place place{file, number, 0};
        const std::vector<Word> words = split_blanks(line);
        if (words.empty()) continue;
        if (angles.empty()) {
            bool is_header = false;
            const std::vector<Word> labels = header_angles(line, &is_header);
            if (!is_header) {
                user_error_at(place, "found '{}', expected '; WAVELENGTH' and the angles",
                              shown(line));
            }
            angles = parse_angles(labels, place);
            continue;
        }
        if (words[0].text[0] == ';') continue;
        if (words.size() != 1 + 2 * angles.size()) {
            user_error_at(place,
                          "found {} fields, expected {}: the wavelength, then Psi and Delta for {} "
                          "angle{}",
                          words.size(), 1 + 2 * angles.size(), angles.size(),
                          angles.size() == 1 ? "" : "s");
        }
        const double wavelength = parse_number(words[0], place);
        const auto [earlier, is_new] = line_of_wavelength.emplace(wavelength, number);
        if (!is_new) {
            user_error_at(place, "found {} nm twice, on line {} and on line {}", wavelength,
                          earlier->second, number);
        }
        for (size_t i = 0; i < angles.size(); ++i) {
            MeasurementRow row;
            row.wavelength_nm = wavelength;
            row.angle_deg = angles[i];
            row.psi_deg = parse_number(words[1 + 2 * i], place);
            row.delta_deg = parse_number(words[2 + 2 * i], place);
            row.line = number;
            measurement.rows.push_back(row);
        }
    }
    if (angles.empty()) user_error("{}: found no '; WAVELENGTH' line", file);
    measurement.check();
    return measurement;
}

}  // namespace drude
