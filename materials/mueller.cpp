#include "materials/mueller.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace drude {

namespace {

using Complex64 = std::complex<double>;
constexpr int order = 4;

struct Hermitian {
    Complex64 h[order][order];
};

// H = 1/4 sum_ij M_ij sigma_i (x) conj(sigma_j) (Cloude 1986), with the Pauli matrices in the
// order that belongs to Stokes parameters: identity, diagonal, real off-diagonal, imaginary.
Hermitian coherency(const Mueller<double>& matrix) {
    const Complex64 i(0, 1);
    const Complex64 pauli[4][2][2] = {
        {{1, 0}, {0, 1}}, {{1, 0}, {0, -1}}, {{0, 1}, {1, 0}}, {{0, -i}, {i, 0}}};
    Hermitian sum{};
    for (int a = 0; a < 4; ++a) {
        for (int b = 0; b < 4; ++b) {
            for (int row = 0; row < order; ++row) {
                for (int column = 0; column < order; ++column) {
                    sum.h[row][column] += 0.25 * matrix.m[a][b] * pauli[a][row / 2][column / 2] *
                                          std::conj(pauli[b][row % 2][column % 2]);
                }
            }
        }
    }
    return sum;
}

double off_diagonal(const Hermitian& matrix) {
    double sum = 0;
    for (int p = 0; p < order; ++p) {
        for (int q = p + 1; q < order; ++q) sum += std::norm(matrix.h[p][q]);
    }
    return sum;
}

// One Jacobi rotation that makes h[p][q] vanish (Golub & Van Loan, Matrix Computations, 8.5, with
// the phase of the element taken out first).
void annihilate(Hermitian* matrix, int p, int q) {
    auto& h = matrix->h;
    const double size = std::abs(h[p][q]);
    if (size == 0) return;
    const Complex64 phase = h[p][q] / size;
    const double tau = (h[q][q].real() - h[p][p].real()) / (2 * size);
    const double t = (tau >= 0 ? 1.0 : -1.0) / (std::abs(tau) + std::sqrt(1 + tau * tau));
    const double c = 1 / std::sqrt(1 + t * t), s = t * c;
    // Columns (p, q) <- (p, q) U, then rows by the adjoint, U = [c, s; -s conj(phase), c
    // conj(phase)].
    for (int row = 0; row < order; ++row) {
        const Complex64 x = h[row][p], y = h[row][q];
        h[row][p] = c * x - s * std::conj(phase) * y;
        h[row][q] = s * x + c * std::conj(phase) * y;
    }
    for (int column = 0; column < order; ++column) {
        const Complex64 x = h[p][column], y = h[q][column];
        h[p][column] = c * x - s * phase * y;
        h[q][column] = s * x + c * phase * y;
    }
    h[p][q] = h[q][p] = 0;
}

}  // namespace

double smallest_coherency_eigenvalue(const Mueller<double>& matrix) {
    Hermitian h = coherency(matrix);
    double scale = 0;
    for (int i = 0; i < order; ++i) scale += std::abs(h.h[i][i].real());
    // Quadratic convergence: a 4x4 matrix needs about five sweeps.
    for (int sweep = 0; sweep < 30 && off_diagonal(h) > 1e-34 * scale * scale; ++sweep) {
        for (int p = 0; p < order; ++p) {
            for (int q = p + 1; q < order; ++q) annihilate(&h, p, q);
        }
    }
    double smallest = h.h[0][0].real();
    for (int i = 1; i < order; ++i) smallest = std::min(smallest, h.h[i][i].real());
    // Nothing reflected is a device too: the zero matrix has eigenvalues 0.
    const double size = matrix.m[0][0];
    return size != 0 ? smallest / size : smallest;
}

}  // namespace drude
