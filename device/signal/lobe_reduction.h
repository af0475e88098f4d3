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
// dark, linearity and integration time, in the bins of `options` (nothing else of which is used);
// readings of one position and polarisation are averaged. A row's sigmas hold the noise of its
// readings, of their darks and of the straight-through beam, whose part the rows of a wavelength
// share; they are at least 1e-9. A bin is left out with a warning where a position or the straight
// beam has no pixel that is neither saturated nor (straight through) dark.
//
// Throws Error (user) where pixel counts differ, an integration time is not positive, a position
// has one polarisation only, or there is no straight-through reading; Error (answer_is_no) where no
// row is left.
LobeScan reduce_lobe_readings(const std::vector<LobeReading>& readings,
                              const SpectrometerInfo& spectrometer, const ReductionOptions& options,
                              double detector_solid_angle_sr, double detector_half_angle_deg,
                              std::vector<std::string>* warnings);

}  // namespace drude
