// From scans of the polariser to Psi and Delta with their covariance.
#pragma once

#include <string>
#include <vector>

#include "device/signal/calibration.h"
#include "device/signal/scan.h"
#include "materials/measurement.h"

namespace drude {

struct ReductionOptions {
    double first_nm = 380, last_nm = 780, step_nm = 5;  // bins, centred on the grid
    bool harmonic_4 = true;                             // fit cos 4P and sin 4P beside the signal
    bool drift = true;  // fit a linear drift of the lamp over each scan
    // Standard deviation of where the polariser's mount ends against what it reports: the part of
    // the error that all wavelengths share. 0: none is stated.
    double mount_repeatability_deg = 0;
    // The same of the analyser's mount, which moves once a scan.
    double analyser_repeatability_deg = 0;
    // Of lobe scans: systematic error of a reflectance over its value, part of its sigma.
    double relative_floor = 0;
};

// What a scan says about the bench, the mean over the wavelengths that were used.
struct ScanQuality {
    double incidence_deg = 0, analyser_deg = 0;
    bool retarder_in = false;
    double harmonic_4 = 0;           // amplitude over that of the mean intensity
    double drift = 0;                // relative change of the lamp from the first step to the last
    double residual_over_noise = 0;  // rms residual over the stated noise; about 1
    double step_jitter_deg = 0;  // azimuth error common to all wavelengths that the residuals show
    int saturated = 0;           // readings left out
};

struct Reduction {
    std::vector<MeasurementRow> rows;  // wavelengths outermost; depolarization filled in
    // Covariance of Psi and Delta of each row in degrees squared, off the diagonal.
    std::vector<double> covariance_psi_delta;
    // Standard deviations in degrees of the error that all wavelengths of an angle share: from the
    // stated repeatability of the mounts and the calibration's sigmas of the azimuths, the root
    // mean square over the angle's rows, which do not hold it; one for each distinct angle,
    // ascending.
    std::vector<double> angles_deg, common_sigma_psi_deg, common_sigma_delta_deg;
    std::vector<ScanQuality> quality;
    std::vector<std::string> warnings;
};

// All scans of a sweep: of each angle of incidence at least one without the retarder; scans with it
// make Delta known over 360 degrees, without them its sign is taken as that of a bare metal (0 to
// 180) with a warning. Where the calibration does not know the retarder, it is taken for a
// quarter-wave plate that decides the half of the circle only. Zones (analyser azimuths) are
// averaged (psi_delta.h). Bins whose centre is not surrounded by pixels of use in every scan
// (wavelength_bins.h), and pairs that no sample gives (|cos Delta| above 1 beyond 4 standard
// deviations), are left out with a warning; |cos Delta| above 1 by noise becomes 0 or 180 degrees
// with a warning.
//
// depolarization is 1 - P^2 with P^2 = cos^2 2Psi + sin^2 2Psi (cos^2 Delta + sin^2 Delta), the two
// squares as the two cycles give them, kept within [0, 1]; -1 with one cycle, which cannot see it.
//
// Throws Error (user) where a scan cannot be reduced at all (too few distinct angles, pixel counts
// that differ, a straight-through scan, an analyser along p or s), Error (answer_is_no) where no
// row is left.
Reduction reduce_scans(const std::vector<Scan>& scans, const SpectrometerInfo& spectrometer,
                       const Calibration& calibration, const ReductionOptions& options);

}  // namespace drude
