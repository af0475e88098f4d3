// Anodised aluminium as fits of films meet it.
#pragma once

#include <vector>

#include "base/counter_random.h"
#include "base/numbers.h"
#include "device/virtual/ellipsometer_simulation.h"
#include "fitter/fit.h"
#include "materials/porous_film.h"

namespace drude {

// Alumina with pores on aluminium, the mixture tabulated at `wavelengths_nm`.
inline Material anodised(double thickness_nm, double porosity,
                         const std::vector<double>& wavelengths_nm) {
    Material material = find_material("Al-Rakic");
    FilmLayer layer;
    layer.thickness_nm = thickness_nm;
    layer.constants = porous_constants(published_set("Al2O3-Malitson-o"), porosity, wavelengths_nm);
    layer.constants.name = "porous alumina";
    material.layers = {layer};
    return material;
}

// The model "film" on what anodised() is made of.
inline FitOptions anodised_options() {
    FitOptions options;
    options.model = "film";
    options.film.substrate = published_set("Al-Rakic");
    options.film.material = published_set("Al2O3-Malitson-o");
    return options;
}

// 380 to 750 nm by 2 nm, noise of 0.05 and 0.1 degrees; seed 0 is noise-free.
inline Measurement measured_film(double thickness_nm, double porosity, uint64_t seed,
                                 const std::vector<double>& angles_deg = {60, 70}) {
    SimulationSetup setup;
    setup.wavelengths_nm = parse_grid("380:750:2", "wavelengths");
    setup.angles_deg = angles_deg;
    setup.seed = seed;
    if (seed == 0) setup.sigma_psi_deg = setup.sigma_delta_deg = 0;
    return simulate_ellipsometer(anodised(thickness_nm, porosity, setup.wavelengths_nm), setup);
}

struct FilmCase {
    double thickness_nm = 0, porosity = 0;
};

// Uniform in 600 to 6000 nm and 0.01 to 0.4.
inline FilmCase random_film_case(uint64_t seed) {
    const PhiloxBlock bits = philox(
        {static_cast<uint32_t>(seed), static_cast<uint32_t>(seed >> 32), 0x66696c6d, 0}, {1, 0});
    const double u = bits[0] * 0x1p-32, v = bits[1] * 0x1p-32;
    return {600 + 5400 * u, 0.01 + 0.39 * v};
}

}  // namespace drude
