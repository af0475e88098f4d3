// A simulated ellipsometer: Psi and Delta of a material with Gaussian noise.
//
//     SimulationSetup setup{{65, 70, 75}, {500, 550, 600}, 0.05, 0.1, 1};
//     Measurement m = simulate_ellipsometer(find_material("Cu"), setup);
#pragma once

#include <cstdint>
#include <vector>

#include "materials/material.h"
#include "materials/measurement.h"

namespace drude {

struct SimulationSetup {
    std::vector<double> angles_deg;      // of incidence, in (0, 90), each once
    std::vector<double> wavelengths_nm;  // > 0, each once
    double sigma_psi_deg = 0.05;         // standard deviations of the noise, in [0, 45]; 0: none
    double sigma_delta_deg = 0.1;
    uint64_t seed = 1;
};

// One row for every wavelength and angle, wavelengths outermost, Delta in [0, 360).
//
// Noise is independent and normal; row i takes the pair of deviates number i of the seed, whatever
// the threads. Noise that takes Psi below 0 or above 90 is reflected there together with half a
// turn of Delta, which is the same point of the Poincare sphere: tan(-Psi) exp(i Delta) =
// tan(Psi) exp(i (Delta + 180)). Throws Error (user) for a setup out of range, a material that
// reflects nothing, and wavelengths that its range policy forbids.
Measurement simulate_ellipsometer(const Material& material, const SimulationSetup& setup);

}  // namespace drude
