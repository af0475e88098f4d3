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

// HTML: one table a metal, printed and ours side by side; what is no information is set apart and
// says why.
std::string table_1_markup(const std::vector<Table1Metal>& metals);

}  // namespace drude
