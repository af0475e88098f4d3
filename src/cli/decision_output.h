// Automatic decisions as --explain prints them.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "base/model_decision.h"

namespace drude {

void print_decisions(const std::vector<ModelDecision>& decisions);

// An array: name, choice, asked, reason, cost, error, alternatives, override; cost and error are
// {value, unit, basis}, value null where no number can be had.
nlohmann::ordered_json decisions_json(const std::vector<ModelDecision>& decisions);

}  // namespace drude
