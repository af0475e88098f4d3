// Numbers as text: read strictly, written so that reading them back gives the same bits.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drude {

// The double that the whole of `text` spells (decimal point, optional sign and exponent, "nan" and
// "inf" included), or nothing. No white space, no trailing characters, no locale.
std::optional<double> parse_double(std::string_view text);

// The integer that the whole of `text` spells, or nothing (also where it does not fit).
std::optional<long long> parse_integer(std::string_view text);

// The same without a sign: 0 to 2^64 - 1.
std::optional<uint64_t> parse_unsigned(std::string_view text);

// The shortest decimal that reads back as the same double; "nan", "inf", "-inf".
std::string format_double(double value);

// A finite double as a JSON number, anything else as "null".
std::string json_number(double value);

// A grid as people type it: "380:780:5" (first:last:step, last included, with its own bits, where
// it falls on the grid), "550" or "400,500,633.5". Values must be finite, a step positive, last >=
// first and the grid at most 100 000 long; throws Error (user) naming `what` otherwise.
std::vector<double> parse_grid(std::string_view text, std::string_view what);

}  // namespace drude
