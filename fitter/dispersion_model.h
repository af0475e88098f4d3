// Optical constants of all wavelengths as one formula with few parameters.
#pragma once

#include <complex>
#include <memory>
#include <string>
#include <vector>

#include "materials/optical_constants.h"

namespace drude {

// Of the dispersion "spline:N".
inline constexpr int most_spline_intervals = 60;

// How a parameter enters the permittivity: those that are linear, or linear in the square (lower
// bound 0), have starts by linear least squares.
enum class ParameterRole { nonlinear, linear, squared };

struct DispersionParameter {
    std::string name, unit;
    double lower = 0, upper = 0;  // bounds of a fit
    double first = 0, last = 0;   // starts are sought in this range
    ParameterRole role = ParameterRole::linear;
};

// A summand of the permittivity at a fixed list of wavelengths.
class DispersionTerm {
  public:
    virtual ~DispersionTerm() = default;
    virtual std::vector<DispersionParameter> parameters() const = 0;
    // Adds its value at wavelength `i` to *epsilon, and writes its derivatives by its parameters.
    virtual void add(size_t i, const double* parameters, std::complex<double>* epsilon,
                     std::complex<double>* derivatives) const = 0;
};

// A sum of terms, named by what a person types:
//   drude            eps_inf and free electrons
//   drude+2cp        and two critical points; 1 to 4, written cp for one
//   drude+3lorentz   and three Lorentz oscillators; 1 to 6
//   2lorentz, cp     eps_inf and bound electrons alone
//   cauchy           n = A + B/l^2 + C/l^4, k = 0
//   sellmeier        n^2 = 1 + B l^2/(l^2 - L^2); 2sellmeier and 3sellmeier with as many terms
//   bruggeman:A,B    a mixture of two named materials, the volume fraction of B fitted
//   spline:N         eps_2 a cubic B-spline of N intervals in E with coefficients >= 0, eps_1 its
//                    Kramers-Kronig transform, free electrons, eps_inf and a pole above the data
class DispersionModel {
  public:
    // `wavelengths_nm` ascending, > 0. Throws Error (user), naming the nearest word, for what is
    // none of the above.
    DispersionModel(const std::string& name, const std::vector<double>& wavelengths_nm);

    const std::string& name() const { return name_; }
    const std::vector<DispersionParameter>& parameters() const { return parameters_; }
    size_t count() const { return parameters_.size(); }
    // How many random starts are worth trying, where linear parameters follow from the others by
    // linear least squares.
    int starts() const { return starts_; }

    // The permittivity at wavelength `i` of the list, and its derivatives by all parameters.
    std::complex<double> epsilon(size_t i, const double* parameters,
                                 std::complex<double>* derivatives) const;
    // n and k there, and their derivatives (null: not wanted). False where the formula absorbs
    // less than nothing (im eps < 0) or n would vanish.
    bool index(size_t i, const double* parameters, Index* index, double* dn, double* dk) const;

  private:
    std::string name_;
    std::vector<std::unique_ptr<DispersionTerm>> terms_;
    std::vector<size_t> first_;  // of each term's parameters
    std::vector<DispersionParameter> parameters_;
    int starts_ = 1;
};

// Words that a name may start with, for suggestions.
const std::vector<std::string>& dispersion_words();

}  // namespace drude
