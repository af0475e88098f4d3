// From the coefficients of one sample's scans to Psi and Delta, in one bin of wavelength.
//
// With the analyser at A (from p) and the source unpolarised, a scan of the polariser has
// (Azzam & Bashara 1977, chapter 3; Fujiwara 2007, eqs 4.19-4.24)
//
//     alpha = (tan^2 Psi - tan^2 A) / (tan^2 Psi + tan^2 A)
//     beta  = 2 tan Psi cos Delta tan A / (tan^2 Psi + tan^2 A)
//
// so that ln tan Psi = artanh alpha + ln |tan A| =: L and cos Delta = sign(tan A) beta /
// sqrt(1 - alpha^2) =: C. Zones are averaged in L and C: an analyser that is off by e moves L of +A
// and -A by opposite amounts (exactly so at 45 degrees), a polariser that is off does so to first
// order. A retarder of d and t behind the sample gives L2 = L + ln t and C2 = cos(Delta + d).
#pragma once

#include <cstddef>
#include <vector>

#include "device/signal/wavelength_bins.h"

namespace drude {

struct BinScan {
    BinnedFit fit;
    double analyser_rad = 0;  // from p, offset taken off; not along p or s
    bool retarder_in = false;
    int dark = 0;  // scans with the same number share their dark, and its noise
    int stop = 0;  // and those between which the analyser did not move, its error
};

struct RetarderState {
    bool known = false;
    double retardance_rad = 0, diattenuation = 1;
};

// Standard deviations in radians of errors of azimuth: of each stop of a mount against what it
// reports, and of the offsets of the calibration.
struct AzimuthErrors {
    double polariser_stop = 0, analyser_stop = 0;
    double polariser_offset = 0, analyser_offset = 0;
};

enum class PsiDeltaState {
    good,
    clamped,     // |cos Delta| above 1 by noise: Delta is set to 0 or 180 degrees
    impossible,  // beyond 4 standard deviations, stated azimuth errors included, or |alpha| >= 1
    half_wave,   // the retarder is so near to 0 or 180 degrees that it tells nothing
};

struct PsiDelta {
    PsiDeltaState state = PsiDeltaState::good;
    double psi = 0, delta = 0;  // radians, Delta in [0, 2 pi)
    Covariance noise;           // of Psi (a) and Delta (b), readings and dark
    Covariance common;          // of the errors of azimuth
    // Squared length of (cos Delta, sin Delta) as two cycles give it: 1 for a sample that does not
    // depolarise; 1 where there is one cycle only.
    double coherence = 1;
    bool two_cycles = false;
    // |alpha| of a scan is within five of its standard deviations of 1: noise reaches Psi = 0 or 90
    // degrees. The standard deviations stated, which are those of small errors, are then too small.
    bool faint = false;
};

// At least one scan, one of them without the retarder. With one cycle Delta is taken in
// [0, 180 degrees]; where the retarder's properties are not known, it is taken for a quarter-wave
// plate that decides the half only.
PsiDelta combine_scans(const std::vector<BinScan>& scans, const RetarderState& retarder,
                       const AzimuthErrors& errors);

}  // namespace drude
