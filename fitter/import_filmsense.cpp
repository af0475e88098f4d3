#include "fitter/import_filmsense.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fitter/import_text.h"

namespace drude {

namespace {

constexpr double degrees = 180 / std::numbers::pi;

class Rows {
  public:
    Rows(const std::string& text, const std::string& file) : lines_(lines_of(text)), file_(file) {}

    // The words of the next line that is not blank, at least `count` of them.
    std::vector<Word> next(size_t count, const char* what) {
        while (at_ < lines_.size()) {
            const TextLine line = lines_[at_++];
            std::vector<Word> words = split_blanks(line.text);
            if (words.empty()) continue;
            place_ = {file_, line.number, 0};
            if (words.size() < count) {
                user_error_at(place_, "found {} fields, expected {}", words.size(), what);
            }
            return words;
        }
        user_error_at({file_, static_cast<int>(lines_.size()), 0},
                      "found the end of the file, expected {}", what);
    }
    const Place& place() const { return place_; }

  private:
    std::vector<TextLine> lines_;
    std::string file_;
    size_t at_ = 0;
    Place place_;
};

MeasurementRow from_ncs(const std::vector<Word>& words, const Place& place) {
    const double n = parse_number(words[0], place), c = parse_number(words[1], place),
                 s = parse_number(words[2], place), p = parse_number(words[3], place);
    const double sin_2psi = std::hypot(c, s);
    if (!(std::hypot(n, sin_2psi) > 0)) {
        user_error_at(place, "found N = C = S = 0, expected a vector of length 1");
    }
    if (p < 0) user_error_at(place, "found P = {}, expected a degree of polarisation", p);
    MeasurementRow row;
    row.psi_deg = std::atan2(sin_2psi, n) / 2 * degrees;
    row.delta_deg = std::atan2(s, c) * degrees;
    row.depolarization = std::clamp(1 - p * p, 0.0, 1.0);
    row.line = place.line;
    return row;
}

size_t count_in(const Word& word, const Place& place, const char* what) {
    const double value = parse_number(word, place);
    if (!(value >= 1 && value <= 10000) || value != std::floor(value)) {
        user_error_at({place.file, place.line, word.column}, "found {} {}, expected 1 to 10000",
                      value, what);
    }
    return static_cast<size_t>(value);
}

}  // namespace

bool is_film_sense(const std::string& text) {
    for (const TextLine& line : lines_of(std::string_view(text).substr(0, 4096))) {
        const std::vector<Word> words = split_blanks(line.text);
        if (words.empty()) continue;
        return lower_case(words[0].text).substr(0, 10) == "film_sense";
    }
    return false;
}

Measurement parse_film_sense(const std::string& text, const std::string& file) {
    Rows rows(text, file);
    const std::vector<Word> title = rows.next(1, "Film_Sense_Data");
    if (lower_case(title[0].text) == "film_sense_dyn_data") {
        user_error_at(rows.place(),
                      "found a series in time ({}); expected Film_Sense_Data: export one time",
                      shown(title[0].text));
    }
    if (lower_case(title[0].text) != "film_sense_data") {
        user_error_at(rows.place(), "found '{}', expected Film_Sense_Data", shown(title[0].text));
    }
    const std::vector<Word> counts =
        rows.next(3, "the numbers of wavelengths and points and the angle of incidence");
    const size_t wavelengths = count_in(counts[0], rows.place(), "wavelengths");
    if (const size_t points = count_in(counts[1], rows.place(), "points"); points != 1) {
        user_error_at({file, rows.place().line, counts[1].column},
                      "found {} points of a map, expected one: export one point", points);
    }
    const double angle = std::abs(parse_number(counts[2], rows.place()));

    Measurement measurement;
    measurement.file = file;
    measurement.header = {{"imported_from", "Film Sense N, C, S"}};
    std::vector<double> nm;
    for (size_t i = 0; i < wavelengths; ++i) {
        const std::vector<Word> words = rows.next(1, "a row for every wavelength");
        nm.push_back(parse_wavelength_nm(words[0], rows.place(), SpectralUnit::nm));
    }
    for (size_t i = 0; i < wavelengths; ++i) {
        const std::vector<Word> words = rows.next(4, "N, C, S and P for every wavelength");
        MeasurementRow row = from_ncs(words, rows.place());
        row.wavelength_nm = nm[i];
        row.angle_deg = angle;
        measurement.rows.push_back(row);
    }
    measurement.check();
    return measurement;
}

}  // namespace drude
