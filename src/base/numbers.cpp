#include "base/numbers.h"

#include <charconv>
#include <cmath>

#include "base/error.h"

namespace drude {

namespace {

// from_chars takes no leading plus sign; people write one.
std::string_view without_plus(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+') {
        text.remove_prefix(1);
    }
    return text;
}

template <class T>
std::optional<T> parse_all(std::string_view text) {
    text = without_plus(text);
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || text.empty()) return {};
    return value;
}

}  // namespace

std::optional<double> parse_double(std::string_view text) {
    return parse_all<double>(text);
}

std::optional<long long> parse_integer(std::string_view text) {
    return parse_all<long long>(text);
}

std::optional<uint64_t> parse_unsigned(std::string_view text) {
    return parse_all<uint64_t>(text);
}

std::string format_double(double value) {
    // A NaN's sign means nothing, and "-nan" would be one more spelling for readers to know.
    if (std::isnan(value)) return "nan";
    return fmt::format("{}", value);
}

std::string json_number(double value) {
    return std::isfinite(value) ? format_double(value) : std::string("null");
}

std::vector<double> parse_grid(std::string_view text, std::string_view what) {
    constexpr size_t largest_grid = 100000;
    const auto number = [&](std::string_view word) {
        const std::optional<double> value = parse_double(word);
        if (!value || !std::isfinite(*value)) {
            user_error("{}: '{}' is not a number; expected FIRST:LAST:STEP or a list like 45,60,75",
                       what, word);
        }
        return *value;
    };
    const auto split = [](std::string_view whole, char separator) {
        std::vector<std::string_view> words;
        size_t begin = 0;
        for (size_t i = 0; i <= whole.size(); ++i) {
            if (i == whole.size() || whole[i] == separator) {
                words.push_back(whole.substr(begin, i - begin));
                begin = i + 1;
            }
        }
        return words;
    };
    std::vector<double> grid;
    for (const std::string_view part : split(text, ',')) {
        const std::vector<std::string_view> words = split(part, ':');
        if (words.size() == 1) {
            grid.push_back(number(words[0]));
            continue;
        }
        if (words.size() != 3) user_error("{}: '{}' is not FIRST:LAST:STEP", what, part);
        const double first = number(words[0]), last = number(words[1]), step = number(words[2]);
        if (!(step > 0)) user_error("{}: the step in '{}' must be positive", what, part);
        if (last < first)
            user_error("{}: the range '{}' is empty: {} < {}", what, part, last, first);
        const double count = std::floor((last - first) / step + 1e-9) + 1;
        if (static_cast<double>(grid.size()) + count > largest_grid) {
            user_error("{}: '{}' holds more than {} values", what, part, largest_grid);
        }
        for (int i = 0; i < static_cast<int>(count); ++i) {
            // Rounding must not carry the last value past the end that was typed.
            const double value = first + i * step;
            const bool at_end = std::abs(value - last) < 1e-9 * step;
            grid.push_back(at_end ? last : value);
        }
    }
    if (grid.size() > largest_grid) {
        user_error("{}: found {} values, expected at most {}", what, grid.size(), largest_grid);
    }
    return grid;
}

}  // namespace drude
