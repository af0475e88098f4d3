// Layers of float pictures as text small enough for a page: half floats, deflated, in base64.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace drude {

// The nearest IEEE 754 binary16, ties to even: relative error at most 2^-11 from 2^-14 to 65504,
// infinity beyond, subnormal below. NaN stays NaN.
uint16_t half_from_float(float value);

// base64 of the zlib stream (RFC 1950) of `bytes`; what a browser's DecompressionStream('deflate')
// takes apart.
std::string pack_bytes(std::string_view bytes);

// The same of half floats: the high bytes of all of them, then the low ones, so that alike
// exponents stand together. "" where all are zero (of whatever sign), which needs no text.
std::string pack_halves(const std::vector<uint16_t>& halves);

}  // namespace drude
