// What a bench is known to do to the light besides the sample: azimuths, source, retarder,
// detector.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace drude {

// A quantity against wavelength, interpolated linearly and held at its ends; empty: not known.
struct WavelengthCurve {
    std::vector<double> wavelength_nm, value;

    bool known() const { return !wavelength_nm.empty(); }
    // `otherwise` where nothing is known.
    double at(double nm, double otherwise) const;
};

// File format "drude-calibration/1" (JSON); unknown keys are errors.
struct Calibration {
    // Subtracted from the azimuths that the bench file's zero_deg gives, in degrees.
    double polariser_offset_deg = 0, analyser_offset_deg = 0;
    double polariser_offset_sigma_deg = 0, analyser_offset_sigma_deg = 0;
    // Stokes parameters s1 = S1/S0 and s2 = S2/S0 of the light that meets the polariser, in the
    // frame of the plane of incidence with S1 > 0 along s (conventions).
    WavelengthCurve source_s1, source_s2;
    // Retardance d in degrees, by which p comes out of the retarder ahead of s (its fast axis
    // stands along p; negative where the slow one does), and amplitude transmittance t of p over
    // that of s: the retarder multiplies rho by t exp(i d), as linear_retarder() of
    // materials/optical_elements.h does with its fast axis along p.
    WavelengthCurve retardance_deg, diattenuation;
    // Depth of the modulation of a straight-through scan, at most 1: polariser extinction, stray
    // light and what dark and linearity correction leave. Where known it divides alpha and beta.
    WavelengthCurve modulation_depth;
    std::vector<std::pair<std::string, std::string>> provenance;  // key, value

    // Throws Error (user) that begins with `where` for what is not finite or out of range: offsets
    // within 180 degrees, sigmas >= 0, wavelengths positive and ascending, source polarised by less
    // than 1, retardance within 360, diattenuation above 0, depth in (0, 1.1] (noise may take a
    // depth of 1 above it).
    void check(const std::string& where) const;
};

// Numbers are written so that they read back with the same bits; what is not known is left out.
// Parsing ends in check().
std::string format_calibration(const Calibration& calibration);
Calibration parse_calibration(const std::string& json, const std::string& file);
Calibration read_calibration(const std::string& path);

}  // namespace drude
