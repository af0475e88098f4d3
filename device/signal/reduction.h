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
    // Standard deviations in degrees of the error that all wavelengths of an angle share, from the
    // stated repeatability of the mounts; one for each distinct angle, ascending.
    std::vector<double> angles_deg, common_sigma_psi_deg, common_sigma_delta_deg;
    std::vector<ScanQuality> quality;
    std::vector<std::string> warnings;
};

// All scans of a sweep: of each angle of incidence at least one; scans with the retarder make Delta
// known over 360 degrees, without them its sign is taken as that of a bare metal (0 to 180) with a
// warning. Zones (analyser azimuths) are averaged. Bins without a usable pixel, and pairs that no
// sample gives (|cos Delta| above 1 beyond its noise), are left out with a warning. Throws Error
// (user) where a scan cannot be reduced at all (too few distinct angles, pixel counts that differ),
// Error (answer_is_no) where no row is left.
Reduction reduce_scans(const std::vector<Scan>& scans, const SpectrometerInfo& spectrometer,
                       const Calibration& calibration, const ReductionOptions& options);

}  // namespace drude
