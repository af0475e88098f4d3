#include "fitter/import_woollam.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "fitter/import_text.h"

namespace drude {

namespace {

constexpr double degrees = 180 / std::numbers::pi;
// As far as a head may reach; a title, VASEmethod, Original, Dynamic and the unit need five.
constexpr size_t longest_head = 12;

enum class RowType { psi_delta, depolarization, intensity, unknown };

RowType row_type(std::string_view word) {
    const std::string name = lower_case(word);
    const auto is = [&](std::initializer_list<const char*> names) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    if (is({"e"})) return RowType::psi_delta;
    if (is({"dpole", "dpolre"})) return RowType::depolarization;
    if (is({"ur", "ut", "r", "t", "pr", "sr", "pt", "st", "rp", "rs", "tp", "ts", "dpolt", "dpolur",
            "dpolut"})) {
        return RowType::intensity;
    }
    return RowType::unknown;
}

// Four fields, wavelength and angle among them, behind an "E" or another known row type or not.
bool is_data(const std::vector<Word>& words) {
    if (words.empty()) return false;
    const bool plain = number_in(words[0].text).has_value();
    if (!plain && row_type(words[0].text) == RowType::unknown) return false;
    const size_t first = plain ? 0 : 1;
    if (words.size() < first + 4) return false;
    return std::all_of(words.begin() + static_cast<std::ptrdiff_t>(first),
                       words.begin() + static_cast<std::ptrdiff_t>(first) + 2,
                       [](const Word& word) { return number_in(word.text).has_value(); });
}

struct Head {
    std::string title, method, original;
    bool dynamic = false, trig = false, has_unit_line = false;
    SpectralUnit unit = SpectralUnit::nm;
    std::string unit_text;
    int unit_line = 0;
    size_t lines = 0;  // of the head
};

// "VASEmethod[...]" and "Original[...]": what stands in the brackets.
std::optional<std::string> bracketed(std::string_view line, std::string_view label) {
    if (lower_case(line.substr(0, label.size())) != label) return std::nullopt;
    line.remove_prefix(label.size());
    return utf8(line.substr(0, line.find_last_of(']')));
}

// The unit of a line that holds nothing but it, TRIG, and the names of the columns in their order.
std::optional<SpectralUnit> unit_of_line(const std::vector<Word>& words) {
    constexpr std::array<const char*, 3> names = {"aoi", "psi", "delta"};
    size_t named = 0;
    for (size_t i = 1; i < words.size(); ++i) {
        const std::string word = lower_case(words[i].text);
        if (word == "trig") continue;
        if (named < names.size() && word != names[named]) return std::nullopt;
        ++named;
    }
    return spectral_unit(words[0].text);
}

Head read_head(const std::vector<TextLine>& lines) {
    Head head;
    // The first line of data ends the head; up to VASEmethod everything is title, even numbers.
    size_t after_method = 0;
    for (size_t i = 0; i < std::min(lines.size(), longest_head); ++i) {
        if (bracketed(lines[i].text, "vasemethod[")) after_method = i + 1;
    }
    for (size_t i = 0; i < std::min(lines.size(), longest_head); ++i) {
        const std::vector<Word> words = split_blanks(lines[i].text);
        if (i >= after_method && is_data(words)) break;
        head.lines = i + 1;
        if (words.empty()) continue;
        if (const auto method = bracketed(lines[i].text, "vasemethod[")) {
            head.method = *method;
        } else if (const auto original = bracketed(lines[i].text, "original[")) {
            head.original = *original;
        } else if (i >= after_method && lower_case(words[0].text) == "dynamic") {
            head.dynamic = true;
        } else if (i < after_method && head.title.empty()) {
            head.title = utf8(lines[i].text);
        } else {
            // The last such line before the data; an earlier one was the title.
            if (head.unit_line > 0 && head.title.empty()) head.title = head.unit_text;
            const auto unit = unit_of_line(words);
            head.has_unit_line = unit.has_value();
            head.unit = unit.value_or(SpectralUnit::nm);
            head.unit_line = lines[i].number;
            head.unit_text = utf8(lines[i].text);
            head.trig = std::any_of(words.begin(), words.end(), [](const Word& word) {
                return lower_case(word.text) == "trig";
            });
        }
    }
    return head;
}

std::vector<TextLine> start_of(const std::string& text) {
    std::vector<TextLine> lines = lines_of(std::string_view(text).substr(0, 16384));
    if (lines.size() > longest_head + 1) lines.resize(longest_head + 1);
    return lines;
}

struct Depolarization {
    double percent = 0;
    int line = 0;
    bool used = false;
};
using Point = std::pair<double, double>;  // wavelength in nm, angle in degrees

struct Reader {
    Measurement measurement;
    Head head;
    std::map<Point, Depolarization> depolarization;
    size_t intensities = 0;
    std::optional<double> time;

    void add_psi_delta(const std::vector<Word>& words, const Place& place);
    void add_depolarization(const std::vector<Word>& words, const Place& place);
    void join_depolarization();
};

// tan Psi and cos Delta with their standard deviations, in place of Psi and Delta in degrees.
void undo_trig(MeasurementRow& row, const Place& place) {
    const double tan_psi = row.psi_deg, cos_delta = row.delta_deg;
    if (!(tan_psi >= 0)) {
        user_error_at(place, "found tan Psi = {}, expected a number of at least 0", tan_psi);
    }
    if (!(std::abs(cos_delta) <= 1)) {
        user_error_at(place, "found cos Delta = {}, expected a number from -1 to 1", cos_delta);
    }
    const double psi = std::atan(tan_psi), delta = std::acos(cos_delta);
    row.psi_deg = psi * degrees;
    row.delta_deg = delta * degrees;
    row.sigma_psi_deg *= std::cos(psi) * std::cos(psi) * degrees;
    // d Delta = d cos / sin; where the sine vanishes the second order takes over.
    const double sigma = row.sigma_delta_deg;
    if (sigma > 0) {
        row.sigma_delta_deg =
            std::min(sigma / std::max(std::sin(delta), sigma), std::sqrt(2 * sigma)) * degrees;
    }
}

void Reader::add_psi_delta(const std::vector<Word>& words, const Place& place) {
    std::vector<Word> fields = words;
    if (head.dynamic && (fields.size() == 5 || fields.size() >= 7)) {
        const double now = parse_number(fields.back(), place);
        if (time && *time != now) {
            user_error_at({place.file, place.line, fields.back().column},
                          "found the time {} after {} minutes, a series in time; expected one time "
                          "slice: export one of them, or cut the file after line {}",
                          now, *time, place.line - 1);
        }
        time = now;
        fields.pop_back();
        if (fields.size() == 7) fields.pop_back();  // between the deviations and the time
    }
    if (fields.size() != 4 && fields.size() != 6) {
        user_error_at(place,
                      "found {} numbers, expected the wavelength, the angle of incidence, Psi and "
                      "Delta, then two standard deviations or nothing{}",
                      fields.size(), head.dynamic ? ", then the time" : "");
    }
    MeasurementRow row;
    row.wavelength_nm = parse_wavelength_nm(fields[0], place, head.unit);
    row.angle_deg = parse_number(fields[1], place);
    row.psi_deg = parse_number(fields[2], place);
    row.delta_deg = parse_number(fields[3], place);
    if (fields.size() == 6) {
        row.sigma_psi_deg = parse_number(fields[4], place);
        row.sigma_delta_deg = parse_number(fields[5], place);
    }
    if (head.trig) undo_trig(row, place);
    row.line = place.line;
    measurement.rows.push_back(row);
}

void Reader::add_depolarization(const std::vector<Word>& words, const Place& place) {
    if (words.size() < 3) {
        user_error_at(place,
                      "found {} numbers, expected the wavelength, the angle of incidence and the "
                      "depolarization in percent",
                      words.size());
    }
    Point point = {parse_wavelength_nm(words[0], place, head.unit), parse_number(words[1], place)};
    if (point.second == 0 && !measurement.rows.empty()) {
        point.second = measurement.rows.back().angle_deg;
    }
    const Depolarization value{parse_number(words[2], place), place.line, false};
    const auto [earlier, is_new] = depolarization.emplace(point, value);
    if (!is_new) {
        user_error_at(place,
                      "found the depolarization of {} nm at {} degrees twice, on line {} and on "
                      "line {}",
                      point.first, point.second, earlier->second.line, place.line);
    }
}

void Reader::join_depolarization() {
    size_t clamped = 0;
    double farthest = 0;
    for (MeasurementRow& row : measurement.rows) {
        const auto found = depolarization.find({row.wavelength_nm, row.angle_deg});
        if (found == depolarization.end()) continue;
        found->second.used = true;
        const double percent = found->second.percent;
        row.depolarization = std::clamp(percent / 100, 0.0, 1.0);
        if (percent >= 0 && percent <= 100) continue;
        ++clamped;
        const auto excess = [](double x) { return std::max(-x, x - 100); };
        if (clamped == 1 || excess(percent) > excess(farthest)) farthest = percent;
    }
    if (clamped > 0) {
        add_warning(measurement,
                    fmt::format("the depolarization of {} of {} points lies outside 0 to 100 %, "
                                "the farthest at {} %; taken for 0 or 100 %",
                                clamped, measurement.rows.size(), farthest));
    }
    const auto unused = std::count_if(depolarization.begin(), depolarization.end(),
                                      [](const auto& entry) { return !entry.second.used; });
    if (unused > 0) {
        add_warning(measurement,
                    fmt::format("{} of {} rows of depolarization are at no wavelength and angle of "
                                "the measurement and were left out",
                                unused, depolarization.size()));
    }
}

}  // namespace

bool is_woollam(const std::string& text) {
    const std::vector<TextLine> lines = start_of(text);
    const Head head = read_head(lines);
    if (!head.method.empty()) return true;
    return head.has_unit_line && head.lines < lines.size() &&
           is_data(split_blanks(lines[head.lines].text));
}

bool is_complete_ease(const std::string& text) {
    const std::vector<TextLine> lines = start_of(text);
    const Head head = read_head(lines);
    if (lower_case(head.method).find("completeease") != std::string::npos) return true;
    if (head.lines >= lines.size()) return false;
    const std::vector<Word> words = split_blanks(lines[head.lines].text);
    return !words.empty() && row_type(words[0].text) == RowType::psi_delta;
}

Measurement parse_woollam(const std::string& text, const std::string& file) {
    const std::vector<TextLine> lines = lines_of(text);
    Reader reader;
    reader.head = read_head(lines);
    const Head& head = reader.head;
    if (!head.has_unit_line) {
        const Place place{file, head.unit_line, 0};
        user_error_at(place,
                      "found {}, expected a unit on the last line before the data: nm, Angstroms, "
                      "um, eV or 1/cm",
                      head.unit_line > 0 ? fmt::format("'{}'", shown(head.unit_text)) : "no unit");
    }
    reader.measurement.file = file;
    auto& header = reader.measurement.header;
    header.emplace_back("imported_from",
                        is_complete_ease(text) ? "CompleteEASE ASCII" : "WVASE ASCII");
    if (!head.title.empty()) header.emplace_back("sample", head.title);
    if (!head.method.empty()) header.emplace_back("vase_method", head.method);
    if (!head.original.empty()) header.emplace_back("original", head.original);

    for (size_t i = head.lines; i < lines.size(); ++i) {
        std::vector<Word> words = split_blanks(lines[i].text);
        if (words.empty()) continue;
        const Place place{file, lines[i].number, 0};
        RowType type = row_type(words[0].text);
        if (type == RowType::unknown) {
            if (std::isalpha(static_cast<unsigned char>(words[0].text[0])) &&
                lower_case(words[0].text) != "nan" && lower_case(words[0].text) != "inf") {
                user_error_at(place,
                              "found a row of the type '{}', expected E or none (Psi and Delta), "
                              "dpolE (depolarization) or an intensity such as uR; data of "
                              "anisotropic samples are not read",
                              shown(words[0].text));
            }
            type = RowType::psi_delta;
        } else {
            words.erase(words.begin());
        }
        if (type == RowType::psi_delta) reader.add_psi_delta(words, place);
        if (type == RowType::depolarization) reader.add_depolarization(words, place);
        if (type == RowType::intensity) ++reader.intensities;
    }
    reader.join_depolarization();
    if (head.trig) {
        add_warning(reader.measurement,
                    "the file holds tan Psi and cos Delta: a cosine does not tell Delta from 360 - "
                    "Delta, and 0 to 180 degrees is what was written");
    }
    if (reader.intensities > 0) {
        add_warning(reader.measurement,
                    fmt::format("{} rows of intensities were left out", reader.intensities));
    }
    if (reader.time) header.emplace_back("time_min", fmt::format("{}", *reader.time));
    reader.measurement.check();
    return std::move(reader.measurement);
}

}  // namespace drude
