// The option --film, shared by the commands that take a material: a film laid on it.
#pragma once

#include <string>
#include <vector>

#include "materials/material.h"

namespace drude {

// Lays `films`, each "n,k,nm" and the first the outermost, on top of the material's own layers.
// Throws Error (user) that names the film.
void lay_films(const std::vector<std::string>& films, Material* material);

// Optical constants that are the same at every wavelength. Throws Error (user), calling them
// `what`, unless n is in (0, 1000] and k in [0, 1000].
OpticalConstants constant_index(double n, double k, const std::string& what);

}  // namespace drude
