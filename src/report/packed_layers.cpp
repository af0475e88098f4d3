#include "report/packed_layers.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "report/markup.h"

namespace drude {

uint16_t half_from_float(float value) {
    const uint32_t bits = std::bit_cast<uint32_t>(value);
    const uint32_t sign = bits >> 16 & 0x8000u, magnitude = bits & 0x7fffffffu;
    const auto half = [sign](uint32_t rest) { return static_cast<uint16_t>(sign | rest); };
    if (magnitude > 0x7f800000u) return half(0x7e00u);
    if (magnitude >= 0x477ff000u) return half(0x7c00u);  // 65520 and above round to infinity
    if (magnitude < 0x33000001u) return half(0);         // at most half of the least subnormal
    const uint32_t exponent = magnitude >> 23;
    // Bits of the significand that fall away, more of them for subnormals.
    const uint32_t shift = exponent < 113 ? 126 - exponent : 13;
    const uint32_t significand =
        exponent < 113 ? (magnitude & 0x7fffffu) | 0x800000u : magnitude - (112u << 23);
    const uint32_t kept = significand >> shift, lost = significand & ((1u << shift) - 1);
    const uint32_t middle = 1u << (shift - 1);
    // A carry out of the significand steps the exponent, which is what rounding up then means.
    return half(kept + (lost > middle || (lost == middle && (kept & 1u)) ? 1 : 0));
}

std::string pack_bytes(std::string_view bytes) {
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::string packed(size, '\0');
    const int status = compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                                 reinterpret_cast<const Bytef*>(bytes.data()),
                                 static_cast<uLong>(bytes.size()), Z_BEST_COMPRESSION);
    if (status != Z_OK) throw std::logic_error("pack_bytes: zlib refused");
    return base64(std::string_view(packed).substr(0, size));
}

std::string pack_halves(const std::vector<uint16_t>& halves) {
    if (std::all_of(halves.begin(), halves.end(), [](uint16_t h) { return (h & 0x7fffu) == 0; })) {
        return "";
    }
    std::string bytes(2 * halves.size(), '\0');
    for (size_t i = 0; i < halves.size(); ++i) {
        bytes[i] = static_cast<char>(halves[i] >> 8);
        bytes[halves.size() + i] = static_cast<char>(halves[i] & 0xffu);
    }
    return pack_bytes(bytes);
}

}  // namespace drude
