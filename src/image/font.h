// A bitmap font for captions and scales: no font file, no font library, the same pixels everywhere.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace drude {

inline constexpr int glyph_width = 5;
inline constexpr int glyph_ascent = 7;   // rows above the base line
inline constexpr int glyph_height = 9;   // two more for descenders
inline constexpr int glyph_advance = 6;  // from one letter to the next

// Row r, from the top; bit 4 is the leftmost column.
using Glyph = std::array<uint8_t, glyph_height>;

// The glyph of a Unicode code point: printable ASCII, the degree sign, plus-minus, times and the
// Greek letters beta, lambda, psi, Psi and Delta; a hollow box for any other.
const Glyph& glyph(char32_t letter);

// The code points of UTF-8 text; a broken sequence gives U+FFFD and goes on with the next byte.
std::vector<char32_t> code_points(std::string_view text);

// Width in pixels of one line of text at a scale of 1: letters without the last gap.
int text_width(std::string_view text);

}  // namespace drude
