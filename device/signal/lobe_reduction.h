// From fluxes at positions of the detector to a lobe scan.
#pragma once

#include <vector>

#include "device/signal/reduction.h"
#include "materials/lobe_scan.h"

namespace drude {

// Counts for one polarisation of the light (polariser along s: azimuth 90, p: 0) at one position of
// the detector. The analyser stands along the polariser, or, `crossed`, across it: both together
// are the flux, and across it is as good as none where the detector's cone is narrow. Or it stands
// at 45 degrees, in the straight beam too, where it passes half of either.
struct LobeReading {
    double incidence_deg = 0;  // 90: straight through
    double offset_deg = 0;
    bool s_polarised = false;
    bool crossed = false;
    uint32_t visit = 0;  // straight through: readings of the same visit are one reading of the lamp
    double integration_s = 0;
    ScanStep step;  // its polariser_deg is not used; time_s from one zero for all readings
    std::vector<double> dark, dark_variance;
};

// Reflectances are ratios to the straight-through readings of the same polarisation, corrected for
// dark, linearity, integration time and what the lamp did between straight-through readings of
// different visits (lamp_drift.h), in the bins of `options` (of which relative_floor is used
// besides); readings of one position and polarisation are averaged. A row's sigmas hold the noise
// of its readings, of their darks and of the straight-through beam, whose part the rows of a
// wavelength share, and the stated floor; they are at least 1e-9. The header says how often the
// beam was read, how far the lamp went, and the floor. A bin is left out with a warning where a
// position or the straight beam has no pixel that is neither saturated nor (straight through) dark.
//
// What azimuths leave, p that of the polariser's error and a of the analyser's: with the analyser
// at 45 degrees the straight beam passes cos^2(45 -+ (p - a)) of s and p and the sample
// (1 +- 2 a)/2, so that their ratio moves by -+2 p in first order, to which light that the
// polariser lets through along the other axis adds +-2 p tan Psi cos Delta. Along the polariser the
// beam passes 1 - (p - a)^2 and the sample 1 - p^2 - a^2 + 2 p a tan Psi cos Delta, of s: 2 p a
// (tan Psi cos Delta - 1) in the ratio, at most 2e-4 for half a degree of the one and 0.3 of the
// other.
//
// Throws Error (user) where pixel counts differ, an integration time is not positive, a time is not
// finite, a position has one polarisation only, or there is no straight-through reading; Error
// (answer_is_no) where no row is left.
LobeScan reduce_lobe_readings(const std::vector<LobeReading>& readings,
                              const SpectrometerInfo& spectrometer, const ReductionOptions& options,
                              double detector_solid_angle_sr, double detector_half_angle_deg,
                              std::vector<std::string>* warnings);

}  // namespace drude
