// Whether a bench that is taken up again is still the one that was left.
#pragma once

#include <string>

#include "device/sweep/journal.h"

namespace drude {

// Mean of the new dark less the old, in counts. Throws Error (answer_is_no) with what to do where
// it is beyond 5 standard deviations of their noise and 0.5 % of the spectrometer's range.
double checked_dark_change(const JournalDark& before, const JournalDark& now,
                           const SpectrometerInfo& spectrometer, const std::string& journal);

struct Drift {
    double scale = 1;  // net light now over before, all pixels together
    double sigma = 0;  // its standard deviation, from the scatter of the frames
};

// Of one setting of the bench measured twice, each with its dark. Throws Error (answer_is_no) with
// what to do where the light has changed by more than 5 %.
Drift checked_drift(const JournalPoint& before, const JournalDark& dark_before,
                    const JournalPoint& now, const JournalDark& dark_now,
                    const SpectrometerInfo& spectrometer, const std::string& journal);

}  // namespace drude
