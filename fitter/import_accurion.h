// Psi and Delta as Accurion's EP3 and EP4 imaging ellipsometers export them (.ds.dat).
//
// The format, as its files show it (separated by tabs, LF or CRLF, Latin-1 or UTF-8):
//   #Lambda  Bandwidth  AOI  Delta  Psi  Zone  ...  ROIidx  Time  X_pos  Y_pos
//   #nm      nm         deg  deg    deg  -     ...  -       s     mm     mm
//   658.0    2.0    50.000  169.624 31.474 4   ...  000   2.927  -6.980  -15.123
// - line 1: names, in any order and number (Delta often before Psi), with or without "#";
//   Lambda, AOI, Psi and Delta are needed. Line 2: units, possibly empty, possibly missing.
// - Zone, where it is there: 1 to 4 are measurements of the same point in four settings of
//   polariser and analyser, whose mean cancels the instrument's first-order errors: the mean is
//   what is read (of Delta around the circle). 0 is the instrument's own mean and 5 a spread over
//   the zones, small numbers that are no Psi and Delta: both are left out, 0 is read where there
//   are no zones. A point with fewer zones than others gets a warning.
// - NaN where a zone failed: such rows are left out, with a warning.
// - AOI differs between zones by nothing, X_pos and Y_pos by microns (refocusing). A point that
//   comes twice in a zone is a map, several regions of interest or a series in time: refused.
#pragma once

#include <string>

#include "materials/measurement.h"

namespace drude {

// Does the first line hold the names?
bool is_accurion(const std::string& text);

// Throws Error (user) with file:line:column for a column that is missing or comes twice, units
// other than nm and deg, rows without the fields needed, fields that are neither a number nor NaN,
// the same point twice in a zone, a file of nothing but NaN, and what Measurement::check forbids.
Measurement parse_accurion(const std::string& text, const std::string& file);

}  // namespace drude
