#include "fitter/import_spectraray.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "base/error.h"
#include "base/numbers.h"

namespace drude {

namespace {

struct Word {
    std::string_view text;
    int column;
};

std::vector<Word> split(std::string_view line) {
    constexpr std::string_view white = " \t\r";
    std::vector<Word> words;
    size_t begin = line.find_first_not_of(white);
    while (begin != std::string_view::npos) {
        const size_t end = std::min(line.find_first_of(white, begin), line.size());
        words.push_back({line.substr(begin, end - begin), static_cast<int>(begin + 1)});
        begin = line.find_first_not_of(white, end);
    }
    return words;
}

// What was found, short and printable, for messages about files in any encoding.
std::string shown(std::string_view text) {
    std::string result;
    for (const char c : text.substr(0, 40)) result += c >= 32 && c < 127 ? c : '?';
    return text.size() > 40 ? result + "..." : result;
}

double parse_field(const Word& word, const Place& line) {
    std::string text(word.text);
    // A comma can only be the decimal one here: blanks separate the fields.
    if (std::count(text.begin(), text.end(), ',') == 1 && text.find('.') == std::string::npos) {
        text[text.find(',')] = '.';
    }
    const auto value = parse_double(text);
    if (!value || !std::isfinite(*value)) {
        user_error_at({line.file, line.line, word.column}, "found '{}', expected a finite number",
                      shown(word.text));
    }
    return *value;
}

std::string_view without_byte_order_mark(std::string_view text) {
    if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
    return text;
}

// The words after "; WAVELENGTH" (also written ";WAVELENGTH"), or nothing for another line.
std::vector<Word> header_angles(std::string_view line, bool* is_header) {
    std::vector<Word> words = split(line);
    *is_header = false;
    if (words.empty() || words[0].text[0] != ';') return {};
    if (words[0].text == ";") {
        words.erase(words.begin());
    } else {
        words[0].text.remove_prefix(1);
    }
    if (words.empty()) return {};
    std::string label(words[0].text);
    for (char& c : label) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    if (label.substr(0, 10) != "WAVELENGTH") return {};
    *is_header = true;
    words.erase(words.begin());
    return words;
}

std::vector<double> parse_angles(const std::vector<Word>& words, const Place& line) {
    std::vector<double> columns;
    for (const Word& word : words) columns.push_back(parse_field(word, line));
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
    std::string_view rest = without_byte_order_mark(text);
    const size_t begin = rest.find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos) return false;
    rest.remove_prefix(begin);
    bool is_header = false;
    header_angles(rest.substr(0, std::min(rest.find('\n'), rest.size())), &is_header);
    return is_header;
}

Measurement parse_spectraray(const std::string& text, const std::string& file) {
    Measurement measurement;
    measurement.file = file;
    measurement.header = {{"imported_from", "SpectraRay ASCII"}};
    std::vector<double> angles;
    std::map<double, int> line_of_wavelength;
    std::string_view rest = without_byte_order_mark(text);
    for (int number = 1; !rest.empty(); ++number) {
        const size_t end = std::min(rest.find('\n'), rest.size());
        const std::string_view line = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        const Place place{file, number, 0};
        const std::vector<Word> words = split(line);
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
        const double wavelength = parse_field(words[0], place);
        const auto [earlier, is_new] = line_of_wavelength.emplace(wavelength, number);
        if (!is_new) {
            user_error_at(place, "found {} nm twice, on line {} and on line {}", wavelength,
                          earlier->second, number);
        }
        for (size_t i = 0; i < angles.size(); ++i) {
            MeasurementRow row;
            row.wavelength_nm = wavelength;
            row.angle_deg = angles[i];
            row.psi_deg = parse_field(words[1 + 2 * i], place);
            row.delta_deg = parse_field(words[2 + 2 * i], place);
            row.line = number;
            measurement.rows.push_back(row);
        }
    }
    if (angles.empty()) user_error("{}: found no '; WAVELENGTH' line", file);
    measurement.check();
    return measurement;
}

}  // namespace drude
