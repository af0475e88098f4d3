// Psi and Delta as SENTECH's SpectraRay exports them in ASCII.
//
// The format, as its files show it:
//   ; WAVELENGTH 50.20000 50.20000 60.20000 60.20000
//   190.13558 45.74309 168.36886 55.11351 170.81765
// - line 1: a semicolon, a label, then the angle of incidence of every data column in degrees. Psi
//   and Delta have a column each, so every angle stands twice; 16 times the same angle is a Mueller
//   matrix, which is another export.
// - rows: vacuum wavelength in nm, then Psi, Delta for every angle in degrees; fields separated by
//   blanks or tabs, often with a blank at the end of the line; LF or CRLF.
// - decimals are written with a point, or with a comma where the computer's language does so.
// - Delta lies in 0..360, -90..270 or -180..180 and may wrap from row to row; it is kept as read.
// - there are no standard deviations.
// Further lines that start with a semicolon are comments.
#pragma once

#include <string>

#include "materials/measurement.h"

namespace drude {

// Does the text start the way such a file does?
bool is_spectraray_psi_delta(const std::string& text);

// Throws Error (user) with file:line:column for: angles that do not come in equal pairs, a Mueller
// matrix, the same angle twice, rows of the wrong length, fields that are no finite number, the
// same wavelength twice, and what Measurement::check forbids.
Measurement parse_spectraray(const std::string& text, const std::string& file);

}  // namespace drude
