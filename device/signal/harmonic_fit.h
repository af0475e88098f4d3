// What a scan of the polariser says of each pixel: the coefficients of its 2P harmonic.
//
//     I(P, t) = I0 (1 + s.p(P)) (1 + x t) (1 + alpha cos 2P + beta sin 2P + c cos 4P + d sin 4P)
//
// P is the polariser's azimuth from the plane of incidence, t the time from -1/2 (first step) to
// 1/2 (last), x the drift of the lamp, s.p = -s1 cos 2P - s2 sin 2P what the source's own
// polarisation does (its S1 > 0 along s, which is the polariser at 90 degrees), known from the
// calibration and divided out exactly, and the 4P terms what a detector that is not linear adds
// (Aspnes & Studna 1975, Appl. Opt. 14, 220).
#pragma once

#include <cstdint>
#include <vector>

#include "device/signal/calibration.h"
#include "device/signal/reduction.h"
#include "device/signal/scan.h"
#include "device/signal/small_least_squares.h"

namespace drude {

// Columns of pixels; of those outside the range of wavelengths and those that could not be used
// (dark, saturated at too many steps) only valid = 0 is set.
struct ScanFit {
    std::vector<uint8_t> valid;
    std::vector<double> alpha, beta;
    // Covariance of these from the independent noise of the readings.
    std::vector<double> var_alpha, cov_alpha_beta, var_beta;
    // The noise of the dark is common to all steps: one standard deviation of it moves alpha and
    // beta together by these.
    std::vector<double> dark_alpha, dark_beta;
    std::vector<double> intensity;      // I0, in linear counts
    std::vector<double> polariser_rad;  // of every step, offset taken off
    LeastSquares factor;                // of the steps of pixels without saturation, drift included
    ScanQuality quality;
};

// Weights are those of the steps, the same for all pixels: the inverse of their stated variance
// (relative to that of the pixel's other steps, mean of the pixels), kept within 1/4 and 4 of the
// mean so that nothing hangs on a few steps. Covariances follow from each reading's own variance,
// so they are right whatever the weights. Steps at which a pixel is saturated are left out for it,
// and the pixel where fewer than 3 distinct azimuths modulo 180 degrees are left, 5 with the 4P
// harmonic, or where these leave a gap from which the harmonic does not follow (make_factors()).
// Throws Error (user) where no pixel could have that many, and where counts, variances or flags are
// not as many as the spectrometer's pixels. `where` names the scan in messages.
ScanFit fit_scan(const Scan& scan, const SpectrometerInfo& spectrometer,
                 const Calibration& calibration, const ReductionOptions& options,
                 std::vector<std::string>* warnings);

}  // namespace drude
