// A smooth surface of a material record: substrate and films at one wavelength and angle.
#pragma once

#include <string>
#include <vector>

#include "materials/film_average.h"
#include "materials/film_stack.h"
#include "materials/material.h"

namespace drude {

// The material as it is met by light in a clear medium of index `ambient` > 0, as one that stands
// in vacuum: every index counts against the medium's, and the films are as many more wavelengths
// thick.
inline Material seen_from(Material material, double ambient) {
    const auto relative = [&](OpticalConstants* constants) {
        for (double& n : constants->n) n /= ambient;
        for (double& k : constants->k) k /= ambient;
    };
    relative(&material.substrate);
    for (FilmLayer& layer : material.layers) {
        relative(&layer.constants);
        layer.thickness_nm *= ambient;
        layer.thickness_spread_nm *= ambient;
    }
    return material;
}

// In light spread evenly over `width_nm` (0: of one wavelength) about `wavelength_nm` > 0, averaged
// over the spread of the films' thickness; cos_theta in (0, 1]. Outside the tables as
// OpticalConstants::at.
inline Reflection<double> reflect(const Material& material, double wavelength_nm, double cos_theta,
                                  double width_nm = 0) {
    if (material.layers.empty()) {
        const Index index = material.substrate.at(wavelength_nm);
        return reflect(ComplexIndex<double>{index.n, index.k}, cos_theta);
    }
    Reflection<double> sum{0, 0, 0, 0};
    std::vector<ThinFilm<double>> films(material.layers.size());
    const int harmonics = film_harmonics(material, wavelength_nm, cos_theta);
    for (const FilmSample& sample : film_samples(material, wavelength_nm, width_nm, harmonics)) {
        for (size_t j = 0; j < films.size(); ++j) {
            const Index index = sample.layers[j];
            films[j] = {{index.n, index.k}, sample.thickness_nm[j]};
        }
        const Reflection<double> r =
            reflect(films.data(), static_cast<int>(films.size()),
                    ComplexIndex<double>{sample.substrate.n, sample.substrate.k}, cos_theta,
                    sample.wavelength_nm);
        add_weighted(r, sample.weight, &sum);
    }
    return sum;
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
