// One JSON document on stdout.
#pragma once

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace drude {

// Numbers with round-trip precision, NaN as null; bytes that are no UTF-8 (in file names) are
// replaced rather than refused.
inline void print_json_document(const nlohmann::ordered_json& document) {
    fmt::print("{}\n",
               document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

}  // namespace drude
