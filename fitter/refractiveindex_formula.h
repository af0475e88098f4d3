// The dispersion formulae of the refractiveindex.info database ("formula 1" to "formula 9" in its
// YAML; M. N. Polyanskiy, Sci. Data 11, 94 (2024), and the database's own list of formulae).
//
// With L the vacuum wavelength in micrometres and c1, c2, ... the coefficients:
//   1 Sellmeier     n^2 = 1 + c1 + sum c_{2i} L^2/(L^2 - c_{2i+1}^2)
//   2 Sellmeier-2   n^2 = 1 + c1 + sum c_{2i} L^2/(L^2 - c_{2i+1})
//   3 polynomial    n^2 = c1 + sum c_{2i} L^c_{2i+1}
//   4 database's    n^2 = c1 + c2 L^c3/(L^2 - c4^c5) + c6 L^c7/(L^2 - c8^c9) + sum c_{2i}
//   L^c_{2i+1} 5 Cauchy        n   = c1 + sum c_{2i} L^c_{2i+1} 6 gases         n   = 1 + c1 + sum
//   c_{2i}/(c_{2i+1} - L^-2) 7 Herzberger    n   = c1 + c2/(L^2 - 0.028) + c3/(L^2 - 0.028)^2 + c4
//   L^2 + c5 L^4 + c6 L^6 8 retro         (n^2 - 1)/(n^2 + 2) = c1 + c2 L^2/(L^2 - c3) + c4 L^2 9
//   exotic        n^2 = c1 + c2/(L^2 - c3) + c4 (L - c5)/((L - c5)^2 + c6)
// Coefficients that are not given are zero. All give n alone.
#pragma once

#include <cstddef>
#include <vector>

namespace drude {

constexpr int first_refractiveindex_formula = 1, last_refractiveindex_formula = 9;

// The largest number of coefficients that the formula has a meaning for; a sum has as many terms
// as there are pairs.
std::size_t most_coefficients(int formula);

// n at a vacuum wavelength in micrometres (> 0). NaN where the formula has no real n there (n^2
// below 0, a pole) and for a formula that does not exist.
double refractiveindex_formula(int formula, const std::vector<double>& coefficients,
                               double wavelength_um);

}  // namespace drude
