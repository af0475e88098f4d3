#include "device/instruments/scpi_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>

#include "base/numbers.h"
#include "device/device_error.h"

namespace drude {

namespace {

constexpr const char* white = " \t\r\n";

std::string_view trimmed(std::string_view text) {
    const size_t first = text.find_first_not_of(white);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(white) - first + 1);
}

// For messages: what can be printed, and not much of it.
std::string shown(std::string_view text, size_t most = 40) {
    std::string result;
    for (const char c : text.substr(0, most)) result += c >= ' ' && c <= '~' ? c : '?';
    if (text.size() > most) result += "...";
    return result;
}

bool same_word(std::string_view text, std::string_view word) {
    return std::equal(text.begin(), text.end(), word.begin(), word.end(),
                      [](char a, char b) { return (a >= 'a' && a <= 'z' ? a - 32 : a) == b; });
}

std::vector<std::string_view> fields(std::string_view text) {
    std::vector<std::string_view> result;
    for (size_t at = 0;;) {
        const size_t comma = text.find(',', at);
        result.push_back(text.substr(at, comma - at));
        if (comma == std::string_view::npos) return result;
        at = comma + 1;
    }
}

// An unsigned integer of `size` bytes.
uint64_t bits(std::string_view bytes, bool least_first) {
    uint64_t value = 0;
    for (size_t byte = 0; byte < bytes.size(); ++byte) {
        const size_t at = least_first ? bytes.size() - 1 - byte : byte;
        value = (value << 8) | static_cast<unsigned char>(bytes[at]);
    }
    return value;
}

// The numbers that stand for what is none, whichever way they came.
double special(double value) {
    // A float of 9.91E37 is not the double of that name.
    const auto near = [&](double mark) { return std::abs(value - mark) < 1e-6 * std::abs(mark); };
    if (near(9.91e37)) return std::numeric_limits<double>::quiet_NaN();
    if (near(9.9e37)) return std::numeric_limits<double>::infinity();
    if (near(-9.9e37)) return -std::numeric_limits<double>::infinity();
    return value;
}

}  // namespace

std::string_view parse_scpi_block(std::string_view answer, const std::string& where) {
    if (answer.size() < 2 || answer[0] != '#' || answer[1] < '0' || answer[1] > '9') {
        device_error(Fault::bad_frame, "{}: answered '{}'; expected a block: #, a digit, a length",
                     where, shown(answer));
    }
    if (answer[1] == '0') {
        device_error(Fault::bad_frame,
                     "{}: answered a block of indefinite length (#0); expected one of a definite "
                     "length",
                     where);
    }
    const size_t digits = static_cast<size_t>(answer[1] - '0');
    const std::string_view length = answer.substr(2, digits);
    const bool decimal =
        std::all_of(length.begin(), length.end(), [](char c) { return c >= '0' && c <= '9'; });
    const std::optional<uint64_t> size = decimal ? parse_unsigned(length) : std::nullopt;
    if (length.size() < digits || !size) {
        device_error(Fault::bad_frame, "{}: a block that begins with '{}', which is no length",
                     where, shown(answer.substr(0, 2 + digits)));
    }
    const std::string_view rest = answer.substr(2 + digits);
    if (rest.size() < *size) {
        device_error(Fault::bad_frame, "{}: a block of {} bytes of which {} came", where, *size,
                     rest.size());
    }
    const std::string_view after = rest.substr(*size);
    if (!after.empty() && after != "\n" && after != "\r\n") {
        device_error(Fault::bad_frame, "{}: {} bytes after a block of {}", where, after.size(),
                     *size);
    }
    return rest.substr(0, *size);
}

double parse_scpi_number(std::string_view text, const std::string& where) {
    const std::string_view word = trimmed(text);
    if (same_word(word, "NAN")) return std::numeric_limits<double>::quiet_NaN();
    if (same_word(word, "INF")) return std::numeric_limits<double>::infinity();
    if (same_word(word, "NINF")) return -std::numeric_limits<double>::infinity();
    const std::optional<double> value = parse_double(word);
    // Other spellings of what is no number are not SCPI's.
    if (!value || !std::isfinite(*value)) {
        device_error(Fault::bad_frame, "{}: answered '{}' where a number was expected", where,
                     shown(word));
    }
    return special(*value);
}

std::vector<double> parse_scpi_numbers(std::string_view answer, ScpiFormat format, bool swapped,
                                       const std::string& where) {
    std::vector<double> values;
    if (format == ScpiFormat::ascii) {
        const std::string_view text =
            !answer.empty() && answer[0] == '#' ? parse_scpi_block(answer, where) : answer;
        for (const std::string_view field : fields(text)) {
            values.push_back(parse_scpi_number(field, where));
        }
        return values;
    }
    const std::string_view block = parse_scpi_block(answer, where);
    const size_t size = format == ScpiFormat::real32 ? 4 : 8;
    if (block.empty() || block.size() % size != 0) {
        device_error(Fault::bad_frame, "{}: a block of {} bytes; expected floats of {} bytes each",
                     where, block.size(), size);
    }
    for (size_t at = 0; at < block.size(); at += size) {
        const uint64_t raw = bits(block.substr(at, size), swapped);
        values.push_back(special(size == 4 ? std::bit_cast<float>(static_cast<uint32_t>(raw))
                                           : std::bit_cast<double>(raw)));
    }
    return values;
}

ScpiError parse_scpi_error(std::string_view answer, const std::string& where) {
    const std::string_view text = trimmed(answer);
    const size_t comma = text.find(',');
    const std::optional<long long> code = parse_integer(trimmed(text.substr(0, comma)));
    // SCPI-99, 21.8: 16 bits.
    if (!code || *code < -32768 || *code > 32767) {
        device_error(Fault::bad_frame,
                     "{}: answered '{}' to a question for errors; expected a code and a text",
                     where, shown(text));
    }
    ScpiError error;
    error.code = static_cast<int>(*code);
    if (comma != std::string_view::npos) {
        std::string_view words = trimmed(text.substr(comma + 1));
        if (words.size() >= 2 && words.front() == '"' && words.back() == '"') {
            words = words.substr(1, words.size() - 2);
        }
        error.text = shown(words, 255);
    }
    return error;
}

std::string scpi_error_words(const ScpiError& error) {
    if (!error.text.empty()) return fmt::format("{}, {}", error.code, error.text);
    const char* kind = error.code == 0      ? "no error"
                       : error.code > 0     ? "an error of the instrument's own"
                       : error.code <= -400 ? "query error"
                       : error.code <= -300 ? "device error"
                       : error.code <= -200 ? "execution error"
                       : error.code <= -100 ? "command error"
                                            : "error";
    return fmt::format("{}, {}", error.code, kind);
}

ScpiIdentity parse_scpi_identity(std::string_view answer, const std::string& where) {
    const std::string_view text = trimmed(answer);
    const bool printable =
        std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
    const std::vector<std::string_view> parts = fields(text);
    if (text.empty() || !printable || parts.size() > 4 || text.size() > 200) {
        device_error(Fault::bad_frame,
                     "{}: identifies itself as '{}'; expected maker,model,serial,firmware", where,
                     shown(text));
    }
    const auto field = [&](size_t at) {
        return at < parts.size() ? std::string(trimmed(parts[at])) : std::string();
    };
    return {field(0), field(1), field(2), field(3)};
}

std::string ScpiIdentity::str() const {
    std::string result;
    for (const std::string* part : {&maker, &model, &serial, &firmware}) {
        if (part->empty()) continue;
        if (!result.empty()) result += ", ";
        result += *part;
    }
    return result;
}

}  // namespace drude
