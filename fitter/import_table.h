// Psi and Delta from any table with names: what spreadsheets and scripts write.
//
//   Wavelength (nm); AOI; Psi (deg); Delta (deg)
//   400,5; 65; 42,885; 130,75
// - separated by semicolons, tabs, commas or blanks, whichever the line of names shows first; a
//   decimal comma where the separator is no comma. Quotes around a field are dropped.
// - lines above the names that start with "#", "%" or "//" are comments; a line of units right
//   below the names is understood, and so are units in the names ("(nm)", "[eV]", "_deg").
// - names, letter case, order, blanks and underscores free: wavelength, lambda, wl, energy or a
//   bare unit (nm, um, Angstrom, eV, 1/cm); angle, aoi, theta, angle of incidence; psi; delta;
//   optionally sigma psi and sigma delta (also std, err, error, d: "psi_err", "dPsi"),
//   depolarization or depol (a fraction, percent with "%"). Other columns are passed over, with
//   a warning.
// - a table without names is read only where this format is asked for: wavelength in nm, angle,
//   Psi, Delta, then nothing, the two standard deviations, or those and the depolarization.
#pragma once

#include <string>

#include "materials/measurement.h"

namespace drude {

// Is the first line of content a line of names with wavelength, angle, Psi and Delta?
bool is_named_table(const std::string& text);

// Throws Error (user) with file:line:column for names that are missing or come twice, rows of the
// wrong length, fields that are no finite number, and what Measurement::check forbids.
Measurement parse_named_table(const std::string& text, const std::string& file);

}  // namespace drude
