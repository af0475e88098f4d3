// Calibrations from scans: straight through (source, retarder, depth, P0 - A0), and of the plane of
// incidence with a sample (residual and phase method).
#pragma once

#include <string>
#include <vector>

#include "device/signal/reduction.h"

namespace drude {

// Straight-through scans (incidence_deg 90): without the retarder, in two or more zones, and, where
// the bench has one, with it. Gives source_s1 and source_s2, modulation_depth, retardance_deg and
// diattenuation, and the difference P0 - A0 of the azimuths as polariser_offset_deg with its sigma
// (they are known against each other only; calibrate_azimuth() finds the plane of incidence).
//
// Without a sample Psi is 45 and Delta 0, so that a scan is (1 + s.p)(1 + D cos 2(P - A)): four
// unknowns of each wavelength, fitted to alpha and beta of the zones. The retarder is then a sample
// of tan Psi = t and Delta = d, of which cos d is seen: the bench has its fast axis along p, so d
// is taken in (0, 180) degrees. An azimuth between them of e degrees is one of the retarder's axis
// too, which costs cos d second order in e where the zones are opposite.
//
// Throws Error (user) for scans with a sample and for zones that are parallel or crossed, Error
// (answer_is_no) where no wavelength follows that shape.
Calibration calibrate_straight_through(const std::vector<Scan>& scans,
                                       const SpectrometerInfo& spectrometer,
                                       const ReductionOptions& options,
                                       std::vector<std::string>* warnings);

// Three or more scans with a sample and the analyser stepped about 0 degrees (p), 90, or both. The
// residual R(A) = 1 - alpha^2 - beta^2 is least where the analyser stands in the plane of incidence
// (Aspnes & Studna 1975), and the phase atan2(beta, alpha)/2 about 0 crosses that about 90 there
// (de Nijs et al. 1988). Both are in alpha and beta as functions of A, so those are fitted as a
// whole (Psi, cos Delta and the two azimuths of each wavelength), and each method counts by what it
// knows: the residual's share goes with sin^2 Delta, the phases' with how far Psi is from 45
// degrees. Adds what is found to both offsets of `calibration`, turns its source with the
// polariser, sets both sigmas (from the noise, or the scatter of wavelengths where that is larger),
// and adds to its provenance which method carries the result: "phase" within 30 degrees of Delta 0
// or 180, where scans about both axes are asked for by a warning. Throws Error (user) for scans
// that do not fit that, Error (answer_is_no) where nothing is found.
void calibrate_azimuth(const std::vector<Scan>& scans, const SpectrometerInfo& spectrometer,
                       const ReductionOptions& options, Calibration* calibration,
                       std::vector<std::string>* warnings);

// Source parameters against a polariser's zero that lies `by_deg` further on.
void rotate_source(Calibration* calibration, double by_deg);

}  // namespace drude
