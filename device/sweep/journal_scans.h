// From the raw frames of a journal to what the signal room reduces.
#pragma once

#include <string>
#include <vector>

#include "device/signal/lobe_reduction.h"
#include "device/signal/scan.h"
#include "device/sweep/journal.h"
#include "device/sweep/noise_model.h"

namespace drude {

// Scans of every angle of incidence that is complete; what is left out is said in `warnings`.
// Azimuths are those that the mounts reported. Frames of a point are averaged and their variance is
// the noise model's. Both parts of a scan that was interrupted are on the first one's scale where
// the lamp had changed by more than 3 standard deviations, and on one time.
std::vector<Scan> scans_of(const Journal& journal, const NoiseModel& noise,
                           std::vector<std::string>* warnings);

// The same of a lobe scan: what was measured so far, straight-through readings first.
std::vector<LobeReading> lobe_readings_of(const Journal& journal, const NoiseModel& noise,
                                          std::vector<std::string>* warnings);

}  // namespace drude
