// Where the ticks of an axis stand and what is written beside them.
#pragma once

#include <string>
#include <vector>

namespace drude {

struct Tick {
    double value = 0;
    std::string label;  // empty: an unlabelled minor tick
};

// Multiples of 1, 2 or 5 times a power of ten within [low, high], at most `most` (at least 2) of
// them, the finest step that keeps to that. Empty unless low < high and both are finite.
std::vector<Tick> linear_ticks(double low, double high, int most);

// Powers of ten within [low, high], thinned to at most `most` labelled ones; over less than two
// decades also their doubles and quintuples, and linear_ticks where that leaves fewer than two.
// Empty unless 0 < low < high and both are finite.
std::vector<Tick> log_ticks(double low, double high, int most);

}  // namespace drude
