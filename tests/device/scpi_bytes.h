// Blocks and floats as SCPI instruments send them.
#pragma once

#include <string>

namespace drude {

inline std::string scpi_block(const std::string& bytes) {
    const std::string size = std::to_string(bytes.size());
    return "#" + std::to_string(size.size()) + size + bytes;
}

// Most significant byte first, by shifting.
template <class Bits>
std::string big_endian(Bits bits) {
    std::string bytes;
    for (int byte = sizeof(Bits) - 1; byte >= 0; --byte) {
        bytes += static_cast<char>((bits >> (8 * byte)) & 0xFF);
    }
    return bytes;
}

}  // namespace drude
