// Whether films on a metal change what it reflects by anything that could be seen.
#pragma once

#include "materials/film_table.h"
#include "materials/material.h"

namespace drude {

// The largest change of any of Rs, Rp, C and S (numbers from 0 to 1 in size) that leaving out all
// films makes, over 380 to 780 nm every 10 nm and 16 angles of incidence from 0 to 88 degrees; the
// films averaged over a nanometre and over their spread, as the renderer has them. 0 without films.
// Throws Error (user) as film_samples().
double film_effect(const Material& material);

// Films that change less are not modelled: it is what the table of a film may be wrong by.
inline constexpr double negligible_film_effect = film_table_tolerance;

}  // namespace drude
