// Calibrations from scans: straight through (source, retarder, depth, P0 - A0), and of the plane of
// incidence with a sample (residual and phase method).
#pragma once

#include <string>
#include <vector>

#include "device/signal/reduction.h"

namespace drude {

// Straight-through scans (incidence_deg 90): without the retarder, in two or more zones, and, where
// the bench has one, with it. Gives source_s1 and source_s2, modulation_depth, retardance_deg and
// diattenuation, and the difference P0 - A0 of the azimuths as polariser_offset_deg (they are
// known against each other only; calibrate_azimuth() finds the plane of incidence).
Calibration calibrate_straight_through(const std::vector<Scan>& scans,
                                       const SpectrometerInfo& spectrometer,
                                       const ReductionOptions& options,
                                       std::vector<std::string>* warnings);

// Scans with a sample and the analyser stepped about 0 degrees (p) or 90: the residual
// R(A) = 1 - alpha^2 - beta^2 is least where the analyser stands in the plane of incidence (Aspnes
// & Studna 1975); where Delta is within 30 degrees of 0 or 180 the phase method (de Nijs et al.
// 1988) is used instead. Sets both offsets and their sigmas of `calibration`, and adds which method
// it was to its provenance.
void calibrate_azimuth(const std::vector<Scan>& scans, const SpectrometerInfo& spectrometer,
                       const ReductionOptions& options, Calibration* calibration,
                       std::vector<std::string>* warnings);

}  // namespace drude
