#include "fitter/import_text.h"

#include <algorithm>
#include <cmath>

#include "base/numbers.h"

namespace drude {

namespace {

constexpr std::string_view white = " \t\r\v\f";

std::string_view trimmed(std::string_view text) {
    const size_t begin = text.find_first_not_of(white);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(white) - begin + 1);
}

// Length of the UTF-8 sequence at the start of `text`, 0 where it is none.
size_t utf8_length(std::string_view text) {
    const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
    const size_t length = byte(0) < 0x80    ? 1
                          : byte(0) < 0xC2  ? 0
                          : byte(0) < 0xE0  ? 2
                          : byte(0) < 0xF0  ? 3
                          : byte(0) <= 0xF4 ? 4
                                            : 0;
    if (length == 0 || length > text.size()) return 0;
    for (size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0) != 0x80) return 0;
    }
    // Overlong forms, surrogates and what lies beyond U+10FFFF.
    if (byte(0) == 0xE0 && byte(1) < 0xA0) return 0;
    if (byte(0) == 0xED && byte(1) > 0x9F) return 0;
    if (byte(0) == 0xF0 && byte(1) < 0x90) return 0;
    if (byte(0) == 0xF4 && byte(1) > 0x8F) return 0;
    return length;
}

// The text with a point for its only comma: a thousands separator would come with a point or
// with another comma.
std::string with_point(std::string_view text) {
    std::string result(text);
    if (std::count(text.begin(), text.end(), ',') == 1 && text.find('.') == text.npos) {
        result[result.find(',')] = '.';
    }
    return result;
}

[[noreturn]] void no_number(const Word& word, const Place& line) {
    user_error_at({line.file, line.line, word.column}, "found '{}', expected a finite number",
                  shown(word.text));
}

}  // namespace

std::vector<TextLine> lines_of(std::string_view text) {
    if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
    std::vector<TextLine> lines;
    while (!text.empty()) {
        const size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        lines.push_back({line, static_cast<int>(lines.size()) + 1});
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

std::vector<Word> split_blanks(std::string_view line) {
    std::vector<Word> words;
    size_t begin = line.find_first_not_of(white);
    while (begin != std::string_view::npos) {
        const size_t end = std::min(line.find_first_of(white, begin), line.size());
        words.push_back({line.substr(begin, end - begin), static_cast<int>(begin + 1)});
        begin = line.find_first_not_of(white, end);
    }
    return words;
}

std::vector<Word> split_fields(std::string_view line, char separator) {
    std::vector<Word> fields;
    size_t begin = 0;
    while (true) {
        const size_t end = std::min(line.find(separator, begin), line.size());
        const std::string_view field = line.substr(begin, end - begin);
        const std::string_view content = trimmed(field);
        const size_t skipped =
            content.empty() ? 0 : static_cast<size_t>(content.data() - field.data());
        fields.push_back({content, static_cast<int>(begin + skipped + 1)});
        if (end == line.size()) return fields;
        begin = end + 1;
    }
}

std::string shown(std::string_view text) {
    std::string result;
    for (const char c : text.substr(0, 40)) result += c >= 32 && c < 127 ? c : '?';
    return text.size() > 40 ? result + "..." : result;
}

std::string lower_case(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return result;
}

std::string utf8(std::string_view text) {
    text = trimmed(text);
    bool valid = true;
    for (size_t i = 0; valid && i < text.size();) {
        const size_t length = utf8_length(text.substr(i));
        valid = length > 0;
        i += length;
    }
    std::string result;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (valid ? byte < 0x20 || byte == 0x7F : byte < 0x20 || (byte >= 0x7F && byte < 0xA0)) {
            result += ' ';
        } else if (valid || byte < 0x80) {
            result += c;
        } else {
            result += static_cast<char>(0xC0 | (byte >> 6));
            result += static_cast<char>(0x80 | (byte & 0x3F));
        }
    }
    return result;
}

std::optional<double> number_in(std::string_view text) {
    const auto value = parse_double(with_point(text));
    if (!value || !std::isfinite(*value)) return std::nullopt;
    return value;
}

double parse_number(const Word& word, const Place& line) {
    const auto value = number_in(word.text);
    if (!value) no_number(word, line);
    return *value;
}

double parse_scaled(const Word& word, const Place& line, int power) {
    const double plain = parse_number(word, line);
    if (power == 0) return plain;
    const std::string text = with_point(word.text);
    const bool has_exponent = text.find_first_of("eE") != std::string::npos;
    const auto shifted = parse_double(text + fmt::format("e{}", power));
    const double value = has_exponent || !shifted ? plain * std::pow(10.0, power) : *shifted;
    if (!std::isfinite(value)) no_number(word, line);
    return value;
}

std::optional<SpectralUnit> spectral_unit(std::string_view word) {
    const std::string unit = lower_case(utf8(word));
    const auto is = [&](std::initializer_list<const char*> names) {
        return std::find(names.begin(), names.end(), unit) != names.end();
    };
    if (is({"nm", "nanometer", "nanometers", "nanometre", "nanometres"})) return SpectralUnit::nm;
    if (is({"a", "angstrom", "angstroms", "\xC3\xA5", "\xC3\x85", "\xE2\x84\xAB"})) {
        return SpectralUnit::angstrom;
    }
    if (is({"um", "micron", "microns", "micrometer", "micrometers", "micrometre", "micrometres",
            "\xC2\xB5m", "\xCE\xBCm"})) {
        return SpectralUnit::micrometre;
    }
    if (is({"ev"})) return SpectralUnit::electronvolt;
    if (is({"1/cm", "cm-1", "cm^-1", "wavenumbers"})) return SpectralUnit::per_centimetre;
    return std::nullopt;
}

double parse_wavelength_nm(const Word& word, const Place& line, SpectralUnit unit) {
    constexpr double hc_ev_nm = 6.62607015e-34 * 299792458 / 1.602176634e-19 * 1e9;
    const double value = parse_number(word, line);
    const Place place{line.file, line.line, word.column};
    if (!(value > 0)) {
        user_error_at(place, "found '{}', expected a wavelength or a photon energy above 0",
                      shown(word.text));
    }
    double nm = value;
    if (unit == SpectralUnit::angstrom) nm = parse_scaled(word, line, -1);
    if (unit == SpectralUnit::micrometre) nm = parse_scaled(word, line, 3);
    if (unit == SpectralUnit::electronvolt) nm = hc_ev_nm / value;
    if (unit == SpectralUnit::per_centimetre) nm = 1e7 / value;
    if (!(nm > 0) || !std::isfinite(nm)) {
        user_error_at(place, "found '{}', which is no wavelength that light can have",
                      shown(word.text));
    }
    return nm;
}

void add_warning(Measurement& measurement, std::string text) {
    measurement.header.emplace_back("warning", std::move(text));
}

}  // namespace drude
