// How far the polarisation of two pictures is apart.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "image/image.h"

namespace drude {

// Degree of linear polarisation P/S0 and its angle 1/2 atan2(S2, S1), P = sqrt(S1^2 + S2^2), a - b.
// Averages over pixels and layers are weighted by the polarised intensity (P_a + P_b)/2: where
// there is no polarised light neither figure means anything.
struct PolarisationErrors {
    double dolp_bias = 0.0;            // mean of a - b, in [-1, 1]
    double dolp_mae = 0.0;             // mean |a - b|
    double aolp_mae_deg = 0.0;         // mean of the smaller angle between the two, in [0, 90]
    double polarised_intensity = 0.0;  // mean P of b, in the picture's unit
    size_t not_physical = 0;           // pixels and layers left out: not finite, or S0 <= 0
    std::vector<std::string> layers;   // what was looked at: "550,000000nm" of the spectral layers,
                                       // or "Y" for the luminance of S0.R ... S3.B
};

// Per wavelength where both pictures have spectral layers of S0, S1 and S2 of the same wavelengths,
// otherwise from Y (Rec.709) of S0.R ... S2.B, which are linear in the spectrum where R, G and B of
// their own may be negative. Nothing where a picture has neither. Sizes must agree.
std::optional<PolarisationErrors> polarisation_errors(const Image& a, const Image& b);

}  // namespace drude
