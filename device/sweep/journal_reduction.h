// What a journal is reduced to: a measurement, a lobe scan, or a calibration of the bench.
#pragma once

#include <string>
#include <vector>

#include "device/signal/calibration.h"
#include "device/signal/reduction.h"
#include "device/sweep/journal.h"
#include "device/sweep/noise_model.h"

namespace drude {

struct JournalReduction {
    std::string text;  // of the file: a measurement, a lobe scan (CSV) or a calibration (JSON)
    size_t rows = 0;   // of a CSV; of a calibration 0
    Reduction reduction;
    NoiseModel noise;
    std::vector<std::string> warnings;  // those of the sweep first
};

struct JournalReductionOptions {
    Calibration calibration;
    // For the header: the calibration's file name and digest, the journal's; empty: none, unknown.
    std::string calibration_name, journal_name, journal_sha256;
    // Bins in place of the recipe's; last_nm 0: the recipe's.
    double first_nm = 0, last_nm = 0, step_nm = 0;
};

// A pure function of the journal and the options. Throws Error (user) where the journal holds
// nothing that is complete, and as reduce_scans() and its kin.
JournalReduction reduce_journal(const Journal& journal, const JournalReductionOptions& options);

}  // namespace drude
