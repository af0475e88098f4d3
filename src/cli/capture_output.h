// What `drude capture` and `drude reduce` share: reading the calibration, reducing, writing,
// summing up.
#pragma once

#include <string>
#include <vector>

#include "cli/command.h"
#include "device/sweep/journal.h"
#include "device/sweep/journal_reduction.h"

namespace drude {

struct CaptureOutput {
    std::string output;       // file to write
    std::string journal;      // its path
    std::string calibration;  // path, or empty
    std::string wavelengths;  // "A:B:STEP" in place of the recipe's, or empty
    bool resumed = false;
};

// Bins "first:last:step" of --wavelengths. Throws Error (user).
struct BinRange {
    double first_nm = 0, last_nm = 0, step_nm = 0;
};
BinRange parse_bins(const std::string& text);

// Reduces, writes the file and prints what there is to say.
void write_reduction(const Journal& journal, const CaptureOutput& what,
                     const CommonOptions& common);

}  // namespace drude
