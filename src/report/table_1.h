// Table 1 of Berger, Weidlich, Wilkie & Magnor (2012) beside a study's own.
#pragma once

#include <string>
#include <vector>

#include "fitter/like_the_paper.h"
#include "report/study_data.h"

namespace drude {

// One metal's columns.
struct Table1Metal {
    std::string name;    // "Copper", or the paper's where the study has no such sample
    std::string sample;  // what the measurement is of; empty where there is none
    const PaperMetal* printed = nullptr;
    PaperFit fit;         // the paper's procedure with the study's measurement, or no blocks and
    std::string refusal;  // why not; empty where there is no sample
    PaperCheck check;     // of the printed numbers by themselves
};

// In the paper's order, one a column of the table: with the study's measurement of that metal
// where it has one.
std::vector<Table1Metal> table_1(const Study& study);

// A number is hatched where |rho|^2 changes by less than the first a unit of beta, or where the
// fit's standard deviation of n or k is more than the second, as a share of the value.
constexpr double least_column_beta = 1e-9, largest_relative_sigma = 0.2;

// What hatching means, and what these fits say of beta: plain text, every figure taken from them.
std::string table_1_note(const std::vector<Table1Metal>& metals);

// HTML: one table a metal, printed and ours side by side. Hatched is what holds no information: of
// ours by the fit to the study's measurement, of the printed by the fit to the printed pair.
std::string table_1_markup(const std::vector<Table1Metal>& metals);

}  // namespace drude
