// Optical constants as SENTECH's SpectraRay keeps tabulated materials: a dielectric function.
//
// The format, as its files show it (LF or CRLF, decimal point or comma):
//   ...                        further lines of settings, passed over
//   Units=eV,E1E2              or Units=Wavelength,E1E2 (nm)
//   ...
//   Begin of array
//   1.5  -2.03  27.8           photon energy in eV or wavelength in nm, Re and Im of epsilon
//   End of array
// - epsilon = (n + ik)^2 with Im >= 0 for an absorber. Im below 0, as noise gives it in transparent
//   ranges, becomes k = 0 with a warning.
// - rows by energy run against the wavelength; both orders are read.
// - materials kept as formulae have no array and are refused.
#pragma once

#include <string>

#include "materials/material.h"

namespace drude {

// Is there a line "Units=..." and one "Begin of array"?
bool is_spectraray_dielectric(const std::string& text);

// A bare mirror of the file's constants, with warnings in its provenance. Throws Error (user) with
// file:line:column for a file without units or array, units other than the above, rows of fewer
// than three numbers, fields that are no finite number, an array without end, and epsilon = 0.
Material parse_spectraray_dielectric(const std::string& text, const std::string& file);

}  // namespace drude
