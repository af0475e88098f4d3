// A smooth surface of a material record: substrate and films at one wavelength and angle.
#pragma once

#include <string>
#include <vector>

#include "materials/film_stack.h"
#include "materials/material.h"

namespace drude {

// `wavelength_nm` > 0, cos_theta in (0, 1]. Outside the tables as OpticalConstants::at.
inline Reflection<double> reflect(const Material& material, double wavelength_nm,
                                  double cos_theta) {
    const auto index = [&](const OpticalConstants& constants) {
        const Index at = constants.at(wavelength_nm);
        return ComplexIndex<double>{at.n, at.k};
    };
    std::vector<ThinFilm<double>> films;
    for (const FilmLayer& layer : material.layers) {
        films.push_back({index(layer.constants), layer.thickness_nm});
    }
    return reflect(films.data(), static_cast<int>(films.size()), index(material.substrate),
                   cos_theta, wavelength_nm);
}

// True where substrate and films are vacuum: nothing is reflected but rounding, and Psi and Delta
// do not exist.
inline bool is_vacuum(const Material& material, double wavelength_nm) {
    const auto vacuum = [&](const OpticalConstants& constants) {
        const Index at = constants.at(wavelength_nm);
        return at.n == 1 && at.k == 0;
    };
    for (const FilmLayer& layer : material.layers) {
        if (!vacuum(layer.constants)) return false;
    }
    return vacuum(material.substrate);
}

// What a caller should be told before using the material from `first_nm` to `last_nm`: one
// sentence for each table that does not cover the range.
inline std::vector<std::string> range_warnings(const Material& material, double first_nm,
                                               double last_nm) {
    std::vector<std::string> warnings;
    const auto add = [&](const OpticalConstants& constants) {
        const std::string warning = constants.range_warning(first_nm, last_nm);
        if (!warning.empty()) warnings.push_back(warning);
    };
    add(material.substrate);
    for (const FilmLayer& layer : material.layers) add(layer.constants);
    return warnings;
}

}  // namespace drude
