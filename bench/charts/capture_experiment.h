// Sweeps of a recipe over the virtual bench, reduced, against the truth.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "device/sweep/recipe.h"
#include "device/virtual/virtual_optics.h"

namespace drude {

struct CaptureOutcome {
    double seconds = 0;                      // by the bench's clock, homing and darks included
    double moving_s = 0, integrating_s = 0;  // parts of it
    double psi_error_deg = 0, delta_error_deg = 0;  // root mean square over the rows
    // The same over the stated sigmas, those that all wavelengths share included: 1 where they are
    // right.
    double psi_pull = 0, delta_pull = 0;
    size_t rows = 0;
};

// One sweep over a smooth surface of a published set, on a bench whose calibration is exact. The
// truth of a row is what its bin would read of Psi and Delta without any error. The journal
// stands in a folder of the system's for files on the way, and is removed.
CaptureOutcome capture_outcome(const std::string& set, const VirtualBenchSettings& settings,
                               const Recipe& recipe);

}  // namespace drude
