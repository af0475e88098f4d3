// The summands that dispersion models are made of (formulas: materials/dispersion.h).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fitter/dispersion_model.h"

namespace drude {

using DispersionTerms = std::vector<std::unique_ptr<DispersionTerm>>;
using Wavelengths = std::vector<double>;

// A constant, from 1 up.
std::unique_ptr<DispersionTerm> constant_term();
std::unique_ptr<DispersionTerm> free_electron_term(const Wavelengths& wavelengths_nm);
// `number` from 1 goes into the names of the parameters.
std::unique_ptr<DispersionTerm> oscillator_term(const Wavelengths& wavelengths_nm, int number);
std::unique_ptr<DispersionTerm> band_edge_term(const Wavelengths& wavelengths_nm, int number);
// n^2, not a summand of others.
std::unique_ptr<DispersionTerm> cauchy_formula(const Wavelengths& wavelengths_nm);
// n^2 = 1 + as many of Sellmeier's terms as `count`, not a summand of others.
std::unique_ptr<DispersionTerm> sellmeier_formula(const Wavelengths& wavelengths_nm, int count);
// The permittivity of a mixture of two named materials, not a summand of others.
std::unique_ptr<DispersionTerm> mixture_formula(const Wavelengths& wavelengths_nm,
                                                const std::string& a, const std::string& b);
// A Kramers-Kronig spline over the photon energies, and a pole above them.
std::unique_ptr<DispersionTerm> spline_term(const Wavelengths& wavelengths_nm, int intervals);

}  // namespace drude
