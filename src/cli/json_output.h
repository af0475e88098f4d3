// One JSON document on stdout.
#pragma once

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace drude {

// Numbers with round-trip precision, NaN as null; bytes that are no UTF-8 (in file names) are
// replaced rather than refused.
template <class Json = nlohmann::ordered_json>
void print_json_document(const Json& document) {
    fmt::print("{}\n", document.dump(2, ' ', false, Json::error_handler_t::replace));
}

}  // namespace drude
