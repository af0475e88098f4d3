// The noise of a spectrometer, from the scatter of its own frames.
#pragma once

#include <cstddef>

#include "device/sweep/journal.h"

namespace drude {

// Variance of one reading in counts squared against the light in it:
// read + photon * net + relative * net^2 with net counts above the dark: read noise, photon noise,
// and noise in proportion to the signal (the lamp's flicker). Each at least 0.
struct NoiseModel {
    double read = 0, photon = 0, relative = 0;
    size_t readings = 0;  // pixels of settings that it was fitted to
    // Those of them with light. 0: nothing is known of the noise of light, and variance() is that
    // of the dark alone.
    size_t light_readings = 0;

    // Never below the 1/12 of rounding to whole counts.
    double variance(double net_counts) const;
};

// Least squares over what every pixel of every point with two frames or more scatters, in classes
// of equal signal, each weighted by the inverse square of its variance; saturated pixels are left
// out, dark frames are the class without signal.
//
// With one frame a point, the two points of a scan half a turn apart stand for two frames: the
// polariser is the same there, and what else differs between them (drift, eccentricity) goes
// smoothly with wavelength, so that the difference of the differences of neighbouring pixels, a
// quarter of its square, is the noise alone. Where there are none, as with an odd number of steps,
// `light_readings` is 0.
NoiseModel fit_noise_model(const Journal& journal);

// Of the points and darks of one group only: the noise of the dark current grows with the
// integration time, so groups of a lobe scan differ. readings is 0 where it has none.
NoiseModel fit_noise_model(const Journal& journal, uint32_t group);

}  // namespace drude
