// From fluxes at positions of the detector to a lobe scan.
#pragma once

#include <vector>

#include "device/signal/reduction.h"
#include "materials/lobe_scan.h"

namespace drude {

// Counts for one polarisation of the light (polariser along s: azimuth 90, p: 0) at one position of
// the detector; the analyser stands at 45 degrees, as in the straight-through beam, so that it
// passes half of either.
struct LobeReading {
    double incidence_deg = 0;  // 90: straight through
    double offset_deg = 0;
    bool s_polarised = false;
    double integration_s = 0;
    ScanStep step;  // its polariser_deg and time_s are not used
    std::vector<double> dark, dark_variance;
};

// Reflectances are ratios to the straight-through readings of the same polarisation, corrected for
// dark, linearity and integration time. Same errors as reduce_scans().
LobeScan reduce_lobe_readings(const std::vector<LobeReading>& readings,
                              const SpectrometerInfo& spectrometer, const ReductionOptions& options,
                              double detector_solid_angle_sr, double detector_half_angle_deg,
                              std::vector<std::string>* warnings);

}  // namespace drude
