// CRC-32 of ISO 3309 (zip, PNG, Ethernet): polynomial 0xEDB88320 reflected, as zlib's crc32.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace drude {

namespace detail {

constexpr std::array<uint32_t, 256> make_crc_table() {
    std::array<uint32_t, 256> table{};
    for (uint32_t byte = 0; byte < 256; ++byte) {
        uint32_t crc = byte;
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xEDB88320U : 0U);
        table[byte] = crc;
    }
    return table;
}

inline constexpr std::array<uint32_t, 256> crc_table = make_crc_table();

}  // namespace detail

// Of `bytes`, going on from the CRC of what stood before them. crc32("123456789") is 0xCBF43926.
constexpr uint32_t crc32(std::string_view bytes, uint32_t before = 0) {
    uint32_t crc = ~before;
    for (const char c : bytes) {
        crc = crc >> 8 ^ detail::crc_table[(crc ^ static_cast<unsigned char>(c)) & 0xFF];
    }
    return ~crc;
}

static_assert(crc32("123456789") == 0xCBF43926);

}  // namespace drude
