// Weighted linear least squares with a handful of columns, factorised once for many right-hand
// sides.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace drude {

constexpr int most_columns = 6;

// One row of the design for each reading; columns beyond those used are without meaning.
using DesignRow = std::array<double, most_columns>;

// The pseudo-inverse of a weighted design: coefficients = inverse * readings.
struct LeastSquares {
    int columns = 0;
    size_t rows = 0;
    // Row m of the inverse is inverse[m * rows .. + rows).
    std::vector<double> inverse;
    // Diagonal of the projection on the design, one for each row: its share of a reading's own
    // noise that the fit follows. Their sum is the number of columns.
    std::vector<double> leverage;
};

// `weights` > 0 (or 0: the row is left out), as many as rows. False where the columns are not
// independent to 1e-6 of their length; `result` is then without meaning.
// Modified Gram-Schmidt applied twice (Giraud, Langou & Rozloznik 2005, Comput. Math. Appl. 50,
// 1069): orthogonal to rounding, and no square of the condition number.
bool factorise(const std::vector<DesignRow>& design, const std::vector<double>& weights,
               int columns, LeastSquares* result);

// Solves the symmetric positive definite system of n <= most_columns unknowns in place, `matrix`
// row-major with row length n: `right` becomes the solution and `matrix` its inverse (the
// covariance, where the system is that of normal equations). False where it is singular.
bool solve_normal_equations(int n, double* matrix, double* right);

}  // namespace drude
