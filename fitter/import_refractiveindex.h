// Optical constants in the YAML of the refractiveindex.info database.
//
//   REFERENCES: "P. B. Johnson and R. W. Christy. ..."
//   COMMENTS: "..."
//   DATA:
//     - type: tabulated nk
//       data: |
//           0.1879 0.94 1.337
//     - type: formula 2
//       wavelength_range: 0.2 5
//       coefficients: 0 1.4313493 0.0052799261
// - wavelengths in micrometres of vacuum, N = n + ik.
// - types: tabulated nk (wavelength, n, k), tabulated n, tabulated k, formula 1 to 9
//   (refractiveindex_formula.h). n may come from one entry and k from another: both are then taken
//   where both are known, at the wavelengths of either, interpolated linearly in between.
// - a formula is tabulated at every nm up to 1 micrometre and every 0.1 % beyond, within its range
//   ("wavelength_range"; "range" in older files).
// - n without k: k = 0, with a warning. k without n is refused.
// - rows in any order; repeated wavelengths and negative k (the database has both) as in
//   constants_rows.h, with a warning.
// - further entries of a kind that is already there (other temperatures, ...) are refused, since
//   no choice would be right.
#pragma once

#include <string>

#include "materials/material.h"

namespace drude {

// Is there a line "DATA:" and a type that the database knows?
bool is_refractiveindex_info(const std::string& text);

// A bare mirror of the file's constants, with warnings in its provenance. Throws Error (user) with
// file:line[:column] for text that is no YAML, keys that are missing, types that are unknown, rows
// of the wrong length, fields that are no finite number, a formula that has no real n in its range,
// n and k without common wavelengths, and what OpticalConstants::check forbids.
Material parse_refractiveindex_info(const std::string& text, const std::string& file);

}  // namespace drude
