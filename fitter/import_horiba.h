// Psi and Delta as Horiba's ellipsometers (UVISEL, Auto SE, Smart SE) export them (.spe).
//
// The format, as its files show it (text in any encoding, LF or CRLF): blocks that end at a blank
// line, each under its label:
//   # INCIDENCE ANGLE:
//   70.00
//
//   # DATA:
//   nm Psi Delta
//   400.0 25.1 110.2
// - the first number of the INCIDENCE ANGLE block is the angle in degrees. Several measurements may
//   follow each other: a DATA block belongs to the angle above it, or to the file's only angle.
// - DATA: a line of names separated by blanks, among them nm or eV, Psi and Delta, in any order;
//   then rows with a number under every name. Is and Ic alone do not make Psi: refused.
// - all other blocks are passed over.
#pragma once

#include <string>

#include "materials/measurement.h"

namespace drude {

// Is there a line "# DATA:" or "# INCIDENCE ANGLE:"?
bool is_horiba(const std::string& text);

// Throws Error (user) with file:line:column for a file without angle or data, names other than the
// above, rows of the wrong length, fields that are no finite number, and what Measurement::check
// forbids.
Measurement parse_horiba(const std::string& text, const std::string& file);

}  // namespace drude
