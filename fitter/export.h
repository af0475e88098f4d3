// Optical constants for other programs. All functions give the text of a file.
#pragma once

#include <string>

#include "materials/optical_constants.h"

namespace drude {

enum class IndexPart { n, k };

// Wavelength in nm and value on every line, "#" comments: what pbrt (v3, v4) and Mitsuba (2, 3)
// read as a sampled spectrum; n and k take a file each. Those programs take a spectrum for zero
// outside its samples, which would make a metal of it a perfect mirror there; so the end values are
// added at 360 and 830 nm, the ends of their range, where the table does not reach them.
std::string format_spd(const OpticalConstants& constants, IndexPart part);

// The YAML of refractiveindex.info ("tabulated nk", wavelengths in micrometres). Read back
// (import_refractiveindex.h), the numbers are the same to the last bit.
std::string format_refractiveindex_info(const OpticalConstants& constants);

// "# key: value" lines, then wavelength_nm,n,k[,sigma_n,sigma_k].
std::string format_constants_csv(const OpticalConstants& constants);

}  // namespace drude
