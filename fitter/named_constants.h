// Optical constants by what a person types for them.
#pragma once

#include <array>
#include <string>

#include "materials/material.h"

namespace drude {

// Cauchy's formula (dispersion.h; coefficients in 1, um^2, um^4) as a table from 190 to 3500 nm by
// 0.5 nm, of which linear interpolation is good to 1e-6 in n. Throws Error (user) where n is not
// above 0 somewhere in that range.
OpticalConstants cauchy_constants(const std::array<double, 3>& coefficients);

// "Al-Rakic" or "Al" (a published set), "al.json" (the substrate of a material file without
// layers), "1.46,0" (n,k at every wavelength), "cauchy:1.452,0.0036[,0]". Throws Error (user) that
// starts with `what`.
OpticalConstants find_constants(const std::string& text, const std::string& what);

// "Al2O3-Malitson-o,3": constants as above, a comma, and the thickness in nm, from 0 to 1e9.
FilmLayer find_layer(const std::string& text, const std::string& what);

}  // namespace drude
