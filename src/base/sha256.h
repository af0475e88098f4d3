// SHA-256 (FIPS 180-4), so that what a record was made from can be checked with sha256sum.
#pragma once

#include <string>
#include <string_view>

namespace drude {

// The digest of `bytes` as 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace drude
