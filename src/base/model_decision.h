// What a program chose by itself, so that a person can judge it: how much of a model was taken,
// why, what that costs, what it loses, and how to have it otherwise.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace drude {

// A cost or an error.
struct DecisionFigure {
    std::optional<double> value;  // none where no number can be had; `basis` then says why
    std::string unit;             // of what the value is: "times the time of scalar"
    // Where the value comes from: "measured: ...", "computed: ...", "estimated: ...", "proved:
    // ...".
    std::string basis;
};

struct DecisionAlternative {
    std::string choice;
    DecisionFigure cost, error;
};

struct ModelDecision {
    std::string name;    // what is decided: "transport"
    std::string choice;  // "scalar"
    bool asked = false;  // an option overrides what would have been chosen
    std::string reason;
    DecisionFigure cost, error;
    std::vector<DecisionAlternative> alternatives;
    std::string override_option;  // as it is typed: "--transport scalar|intensity|stokes"
};

}  // namespace drude
