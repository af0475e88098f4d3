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

// The same of a lobe scan: what was measured so far, positions of which not everything was read
// left out. The variance is that of the noise model of the readings' own group where it has frames
// to tell it by, `noise` otherwise. Darks of one integration time are one pattern, of which the
// mean of all has the least noise, and a level of each part of the scan; a dark whose pattern
// differs by more than noise stands for itself. Times of several sessions follow each other.
std::vector<LobeReading> lobe_readings_of(const Journal& journal, const NoiseModel& noise,
                                          std::vector<std::string>* warnings);

}  // namespace drude
