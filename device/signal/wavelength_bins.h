// Pixels gathered into bins of wavelength.
#pragma once

#include <vector>

#include "device/signal/harmonic_fit.h"

namespace drude {

// The shares with which pixels make up the value at a bin's centre.
struct BinShares {
    std::vector<size_t> pixel;
    std::vector<double> share;  // their sum is 1
};

// Pixels within half a step of `centre_nm`, `weights` (> 0 where a pixel is of use) as many as
// pixels. A parabola fitted over the bin is read at its centre (Savitzky & Golay 1964, Anal. Chem.
// 36, 1627), so that neither the spectrum's slope and bend nor a bin that pixels do not fill evenly
// shift anything; its value is as noisy as the mean of 4/9 of the pixels. A bin of fewer than five
// pixels is read by a line. Where pixels of use end before the bin does (a saturated range, the end
// of the spectrum), as far as they reach on both sides of the centre counts: nothing is
// extrapolated. Empty where they do not stand on both sides, three or more of them for a parabola
// and around its middle, but for a pixel at the centre itself (to 1/1000 of half a step), which
// then is the value.
BinShares bin_shares(const std::vector<double>& wavelength_nm, const std::vector<double>& weights,
                     double centre_nm, double step_nm);

// The centres that the options name. Throws Error (user) for a range or step that makes none.
std::vector<double> bin_centres(const ReductionOptions& options);

// Two numbers that vary together.
struct Covariance {
    double aa = 0, ab = 0, bb = 0;
};

// A scan's coefficients at the centre of a bin, divided by the depth of the modulation.
struct BinnedFit {
    bool usable = false;
    double alpha = 0, beta = 0;
    Covariance noise;                      // of the readings
    double dark_alpha = 0, dark_beta = 0;  // one standard deviation of the dark's noise
    Covariance jitter;                     // for steps that end 1 rad (standard deviation) off
};

std::vector<BinnedFit> bin_fit(const ScanFit& fit, const SpectrometerInfo& spectrometer,
                               const Calibration& calibration, const ReductionOptions& options);

}  // namespace drude
