// What `drude compare` says of a comparison.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "image/compare.h"
#include "image/flip.h"

namespace drude {

// What the command line said.
struct CompareWords {
    std::string a, b;
    std::string flip;  // "ldr", "hdr": which one a FlipResult is
    double alpha = 0;
};

nlohmann::json comparison_json(const Comparison& comparison, const std::optional<FlipResult>& flip,
                               const CompareWords& words);
// On standard output.
void print_comparison(const Comparison& comparison, const std::optional<FlipResult>& flip,
                      const CompareWords& words);

}  // namespace drude
