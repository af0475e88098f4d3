// MD5 (RFC 1321): the checksum that some instruments put on their messages. It guards against
// accidents on a wire, not against people; records are signed with sha256.h.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace drude {

std::array<uint8_t, 16> md5(std::span<const uint8_t> bytes);

}  // namespace drude
