// The readings of a scan as the fit wants them: linear in the light, without the source's
// polarisation, some pixels side by side.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "device/signal/block_solver.h"
#include "device/signal/calibration.h"
#include "device/signal/reduction.h"
#include "device/signal/scan.h"

namespace drude {

// "at 70 degrees, analyser at -45, with the retarder", for messages.
std::string scan_name(const Scan& scan);

// Counts without their dark, linear in the light. `polynomial` as SpectrometerInfo::nonlinearity.
struct LinearCounts {
    double value;
    double slope;  // of value against counts; 0 and a value of NaN where the polynomial is <= 0
};
LinearCounts linear_counts(double counts_less_dark, const std::vector<double>& polynomial);

// Throws Error (user) where counts, variances or flags are not as many as the spectrometer's
// pixels, or a step's azimuth or time is not finite.
void check_sizes(const Scan& scan, const SpectrometerInfo& spectrometer);

// The design of the steps at these azimuths (radians). No drift where all have one time.
Steps make_steps(const Scan& scan, const std::vector<double>& radians,
                 const ReductionOptions& options);

// The inverse of the steps' variances against each other, mean of the pixels [first, last), within
// 1/4 and 4 of the mean; 1 where no pixel has a variance.
std::vector<double> step_weights(const Scan& scan, size_t first_pixel, size_t last_pixel);

// Fills the block with the readings of pixels j to j + used; lanes beyond repeat the last of them.
// Returns whether one of them was saturated at any step.
bool load_block(const Scan& scan, const std::vector<double>& polynomial, const Calibration& bench,
                const std::vector<double>& nm, const std::vector<DesignRow>& design, size_t j,
                int used, Block* block);

}  // namespace drude
