// Films that are uneven, or seen through a slit: the nodes over which their reflectance is
// averaged. What is averaged are the intensities (Reflection is linear in them), so that the light
// is partly depolarised.
#pragma once

#include <vector>

#include "materials/fresnel.h"
#include "materials/material.h"
#include "materials/quadrature.h"

namespace drude {

// A share of an average of intensities.
template <class T>
void add_weighted(const Reflection<T>& r, const T& weight, Reflection<T>* sum) {
    sum->Rs = sum->Rs + weight * r.Rs;
    sum->Rp = sum->Rp + weight * r.Rp;
    sum->C = sum->C + weight * r.C;
    sum->S = sum->S + weight * r.S;
}

// Nodes of a distribution of mean 0 and their weights, which sum to 1.
using AverageNodes = QuadratureRule;

// A Gaussian of standard deviation 1, fine enough for the average of a fringe whose phase scatters
// by `phase` radians, and of its harmonics up to `harmonics`.
AverageNodes gaussian_nodes(double phase, int harmonics = 2);

// The uniform distribution on [-1, 1], fine enough for a fringe whose phase goes from -phase to
// phase, and for its harmonics (Gauss-Legendre; within 1e-4 of a fringe's contrast).
AverageNodes uniform_nodes(double phase, int harmonics = 2);

// The phase of a fringe, 4 pi n d/lambda, may scatter by so many radians; beyond, nothing is left:
// exp(-18) of its contrast.
inline constexpr double largest_phase_spread = 6;

// One of the coherent stacks that an average is made of.
struct FilmSample {
    double wavelength_nm = 0, weight = 1;
    std::vector<double> thickness_nm;  // of each layer
    std::vector<Index> layers;         // their constants at this wavelength
    Index substrate;
};

// How many harmonics of its fringes matter in what the material reflects: multiple reflections in
// its films fall below 3e-4 after as many. A few at normal incidence; towards grazing angles, where
// every surface is a mirror, up to most_harmonics.
inline constexpr int most_harmonics = 64;
int film_harmonics(const Material& material, double wavelength_nm, double cos_theta);

// The stacks whose weighted mean is the material's reflection in light spread evenly over
// `width_nm` (>= 0) about `wavelength_nm`, its layers' thickness scattering by their spread
// (Gaussian, independent of each other). One stack where there is nothing to average. Spreads
// beyond largest_phase_spread count as that much, and a layer of which the width holds more than
// six fringes as that uneven: their fringes are gone either way. Where the spread does three times
// more than the width, the width is added to it. Throws Error (user) where more than two layers
// are to be averaged over. Outside the tables as OpticalConstants::at for `wavelength_nm`; beside
// it the end values hold.
std::vector<FilmSample> film_samples(const Material& material, double wavelength_nm,
                                     double width_nm, int harmonics);

}  // namespace drude
