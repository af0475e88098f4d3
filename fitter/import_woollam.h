// Psi and Delta as J.A. Woollam's WVASE and CompleteEASE export them in ASCII (.dat, .txt).
//
// The format, as its files show it. Five variants, one grammar:
//   2nm SiO2 on Si                          any title, also an empty line
//   VASEmethod[EllipsometerType=4, ...]     how it was measured; absent in simulated exports
//   Original[sample.dat]                    optional
//   Dynamic                                 optional: a time series, see below
//   nm                                      the unit: the last line before the data
//   E  300.0  65.0  12.14  1.56  0.37  3.46
//   dPolE  300.0  65.0  -0.39  0.20
//   uR  300.0  65.0  0.64  inf
// - unit: nm, Angstroms, um, eV or 1/cm; column names may follow it ("nm aoi Psi Delta"), and so
//   may the word TRIG: the columns are then tan Psi and cos Delta. A cosine does not tell Delta
//   from 360 - Delta: 0..180 is read, with a warning.
// - rows of Psi and Delta: wavelength, angle of incidence, Psi, Delta in degrees, then the two
//   standard deviations in the same units or nothing. WVASE begins them with the wavelength,
//   CompleteEASE 6 with an "E". CompleteEASE 3 ends them with a tab.
// - dPolE (dpolE in WVASE): depolarization in percent, in its own grid and at its own angles. What
//   falls on a point of the measurement becomes its `depolarization` (a fraction), the rest is
//   counted in a warning. The angle 0 stands for the row above (CompleteEASE 3). Noise around zero
//   gives negative values: taken for 0, with a warning.
// - uR, R, T and other intensities are passed over, and counted in a warning.
// - separated by tabs or blanks, LF or CRLF, letter case of the row types free; Delta in any 360
//   degree window, kept as read. Titles are in any encoding.
// - Dynamic: the rows carry the time in minutes in the last column. One time slice is read; a file
//   with several is refused at the first row of the second.
#pragma once

#include <string>

#include "materials/measurement.h"

namespace drude {

// Does the text start the way such a file does (VASEmethod, or a unit line and a row of data)?
bool is_woollam(const std::string& text);
// Was it CompleteEASE (it names itself, or its rows begin with E), as against WVASE?
bool is_complete_ease(const std::string& text);

// Throws Error (user) with file:line:column for a missing or unknown unit, unknown row types (those
// of anisotropic samples among them), rows of the wrong length, fields that are no finite number,
// a point twice, a second time slice, and what Measurement::check forbids.
Measurement parse_woollam(const std::string& text, const std::string& file);

}  // namespace drude
