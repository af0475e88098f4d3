#include "cli/decision_output.h"

#include <fmt/format.h>

#include <cmath>

namespace drude {

namespace {

using nlohmann::ordered_json;

std::string number_of(const DecisionFigure& figure) {
    if (!figure.value || !std::isfinite(*figure.value)) return "not known";
    return fmt::format("{:.3g}{}{}", *figure.value, figure.unit.empty() ? "" : " ", figure.unit);
}

std::string with_basis(const DecisionFigure& figure) {
    return figure.basis.empty() ? number_of(figure)
                                : fmt::format("{} ({})", number_of(figure), figure.basis);
}

ordered_json json_of(const DecisionFigure& figure) {
    const bool known = figure.value && std::isfinite(*figure.value);
    return {{"value", known ? ordered_json(*figure.value) : ordered_json(nullptr)},
            {"unit", figure.unit},
            {"basis", figure.basis}};
}

}  // namespace

void print_decisions(const std::vector<ModelDecision>& decisions) {
    for (const ModelDecision& decision : decisions) {
        fmt::print("{}: {}{}\n", decision.name, decision.choice,
                   decision.asked ? " (asked for)" : "");
        fmt::print("    because   {}\n", decision.reason);
        fmt::print("    cost      {}\n", with_basis(decision.cost));
        fmt::print("    error     {}\n", with_basis(decision.error));
        for (const DecisionAlternative& other : decision.alternatives) {
            fmt::print("    instead   {}: cost {}; error {}\n", other.choice, number_of(other.cost),
                       other.error.value ? number_of(other.error) : other.error.basis);
        }
        fmt::print("    override  {}\n", decision.override_option);
    }
}

ordered_json decisions_json(const std::vector<ModelDecision>& decisions) {
    ordered_json list = ordered_json::array();
    for (const ModelDecision& decision : decisions) {
        ordered_json alternatives = ordered_json::array();
        for (const DecisionAlternative& other : decision.alternatives) {
            alternatives.push_back({{"choice", other.choice},
                                    {"cost", json_of(other.cost)},
                                    {"error", json_of(other.error)}});
        }
        list.push_back({{"name", decision.name},
                        {"choice", decision.choice},
                        {"asked", decision.asked},
                        {"reason", decision.reason},
                        {"cost", json_of(decision.cost)},
                        {"error", json_of(decision.error)},
                        {"alternatives", std::move(alternatives)},
                        {"override", decision.override_option}});
    }
    return list;
}

}  // namespace drude
