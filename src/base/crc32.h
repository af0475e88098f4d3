// CRC-32 of ISO 3309 (zip, PNG, Ethernet), as zlib computes it.
#pragma once

#include <cstdint>
#include <string_view>

namespace drude {

// Of `bytes`, going on from the CRC of what stood before them. crc32("123456789") is 0xCBF43926.
uint32_t crc32(std::string_view bytes, uint32_t before = 0);

}  // namespace drude
