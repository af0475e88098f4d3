// One turn of the polariser with everything else standing still, as counts, and what it reduces to.
#pragma once

#include <cstdint>
#include <vector>

#include "device/spectrometer.h"

namespace drude {

// The average of some frames at one position of the polariser.
struct ScanStep {
    double polariser_deg = 0;    // azimuth of its axis from p, offsets of a calibration not applied
    double time_s = 0;           // mid of its exposures, from any zero common to the scan
    int frames = 0;              // that were averaged, >= 1
    std::vector<double> counts;  // mean raw counts of every pixel, dark included
    std::vector<double> variance;    // of that mean, by the caller's noise model or from the frames
    std::vector<uint8_t> saturated;  // 1 where any of the frames read max_counts
};

struct Scan {
    double incidence_deg = 0;  // 90: straight through, no sample
    double analyser_deg = 45;  // azimuth of its axis from p, offsets not applied
    bool retarder_in = false;
    std::vector<double> dark;           // counts of every pixel at the same integration time
    std::vector<double> dark_variance;  // of these
    std::vector<ScanStep> steps;
};

}  // namespace drude
