#include "base/crc32.h"

#include <zlib.h>

namespace drude {

uint32_t crc32(std::string_view bytes, uint32_t before) {
    if (bytes.empty()) return before;  // zlib takes a null pointer for a new beginning
    return static_cast<uint32_t>(
        ::crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace drude
