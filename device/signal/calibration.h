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
    double at(double wavelength_nm_, double otherwise) const;
};

// File format "drude-calibration/1" (JSON); unknown keys are errors.
struct Calibration {
    // Subtracted from the azimuths that the bench file's zero_deg gives, in degrees.
    double polariser_offset_deg = 0, analyser_offset_deg = 0;
    double polariser_offset_sigma_deg = 0, analyser_offset_sigma_deg = 0;
    // Stokes parameters s1 = S1/S0 and s2 = S2/S0 of the light that meets the polariser, in the
    // frame of the plane of incidence with S1 > 0 along s (conventions).
    WavelengthCurve source_s1, source_s2;
    // Retardance in degrees of p against s, and amplitude transmittance of p over that of s: the
    // retarder multiplies rho by t exp(-i d).
    WavelengthCurve retardance_deg, diattenuation;
    // Depth of the modulation of a straight-through scan, at most 1: polariser extinction, stray
    // light and what dark and linearity correction leave. Where known it divides alpha and beta.
    WavelengthCurve modulation_depth;
    std::vector<std::pair<std::string, std::string>> provenance;  // key, value

    void check(const std::string& where) const;
};

std::string format_calibration(const Calibration& calibration);
Calibration parse_calibration(const std::string& json, const std::string& file);
Calibration read_calibration(const std::string& path);

}  // namespace drude
