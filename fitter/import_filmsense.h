// N, C, S as Film Sense's FS ellipsometers export them.
//
// The format, as its files show it (separated by tabs, LF or CRLF):
//   Film_Sense_Data
//   8  1  -70.012  -0.002  -0.003  19.0913     wavelengths, points, angle of incidence, ...
//   367.20  14.32  3.39 ...                    a row a wavelength: nm, then calibration
//   0.60270  -0.74368  0.28928  0.99845  16.5  a row a wavelength: N, C, S, P, intensity
//   3                                          results of the instrument's own fit: passed over
// - the angle of incidence is written with a sign; its magnitude counts.
// - N = cos 2Psi, C = sin 2Psi cos Delta, S = sin 2Psi sin Delta, already divided by the degree of
//   polarisation P. Psi is taken as atan2(sqrt(C^2 + S^2), N)/2, which does not mind their noise;
//   Delta as atan2(S, C), from -180 to 180.
// - P gives the depolarization 1 - P^2, the quantity that other makers' dPol is; P a little above 1
//   is noise and gives 0.
// - "Film_Sense_Dyn_Data" is a series in time and is refused: export one time.
#pragma once

#include <string>

#include "materials/measurement.h"

namespace drude {

// Does the first line name such a file?
bool is_film_sense(const std::string& text);

// Throws Error (user) with file:line:column for another first line, a series in time, several
// points of a map, fewer rows than were announced, fields that are no finite number, N, C, S that
// are all zero, P below 0, and what Measurement::check forbids.
Measurement parse_film_sense(const std::string& text, const std::string& file);

}  // namespace drude
