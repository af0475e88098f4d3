// One integration time for a whole sweep, from its brightest setting.
#pragma once

#include <vector>

#include "device/sweep/bench_driver.h"
#include "device/sweep/plan.h"

namespace drude {

struct ExposureLimits {
    double longest_s = 5;
    double least_signal = 0.02;  // of max_counts
};

// Those of a recipe: what a rough surface sends into a small detector is little, but a lobe needs
// fewer digits than Psi and Delta do.
ExposureLimits exposure_limits(const Recipe& recipe);

struct ExposureChoice {
    double integration_s = 0;
    double peak = 0;  // of the brightest pixel at the brightest setting, over max_counts
    PlanPoint brightest;
    std::vector<std::string> warnings;
};

// The integration time at which the brightest pixel of the brightest of `points` reads 70 to 85 %
// of what the spectrometer counts to, at most limits.longest_s.
//
// With everything else standing still the polariser's intensity is I0 (1 + a cos 2P + b sin 2P), so
// that I(P) + I(P + 90) = 2 I0 bounds every azimuth, every zone of the same |A| and any retarder:
// two frames say which angle of incidence is the brightest, three more (60 degrees apart) for each
// retarder setting where its peak is. With a goniometer that is moved by hand the first angle
// stands for all, with a warning.
//
// A frame that reads full scale is believed when the next one does (to 90 %), too; otherwise a
// DeviceError (bad_frame) asks for the choice to be made again.
//
// Throws Error (outside) where the brightest setting stays dark (less than limits.least_signal) at
// the longest time, or reads its maximum at the shortest; DeviceError as the parts do.
ExposureChoice choose_exposure(BenchDriver& driver, const Bench& bench,
                               const std::vector<PlanPoint>& points,
                               const ExposureLimits& limits = {});

}  // namespace drude
