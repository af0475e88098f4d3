#include "device/signal/small_least_squares.h"

#include <cmath>

namespace drude {

namespace {

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
    return sum;
}

}  // namespace

bool factorise(const std::vector<DesignRow>& design, const std::vector<double>& weights,
               int columns, LeastSquares* result) {
    const size_t rows = design.size();
    std::vector<double> root(rows);
    for (size_t k = 0; k < rows; ++k) root[k] = std::sqrt(weights[k]);
    // sqrt(W) X = Q R, column by column.
    std::array<std::vector<double>, most_columns> q;
    double r[most_columns][most_columns] = {};
    for (int m = 0; m < columns; ++m) {
        q[m].resize(rows);
        for (size_t k = 0; k < rows; ++k) q[m][k] = root[k] * design[k][m];
        const double length = std::sqrt(dot(q[m], q[m]));
        for (int pass = 0; pass < 2; ++pass) {
            for (int i = 0; i < m; ++i) {
                const double share = dot(q[i], q[m]);
                r[i][m] += share;
                for (size_t k = 0; k < rows; ++k) q[m][k] -= share * q[i][k];
            }
        }
        r[m][m] = std::sqrt(dot(q[m], q[m]));
        if (!(r[m][m] > 1e-6 * length)) return false;
        for (size_t k = 0; k < rows; ++k) q[m][k] /= r[m][m];
    }
    result->columns = columns;
    result->rows = rows;
    result->inverse.assign(columns * rows, 0);
    result->leverage.assign(rows, 0);
    for (size_t k = 0; k < rows; ++k) {
        for (int m = columns - 1; m >= 0; --m) {
            double value = q[m][k] * root[k];
            for (int i = m + 1; i < columns; ++i) value -= r[m][i] * result->inverse[i * rows + k];
            result->inverse[m * rows + k] = value / r[m][m];
            result->leverage[k] += q[m][k] * q[m][k];
        }
    }
    return true;
}

bool solve_normal_equations(int n, double* matrix, double* right) {
    // Cholesky, L in the lower triangle.
    double l[most_columns][most_columns] = {};
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j <= i; ++j) {
            double sum = matrix[i * n + j];
            for (int k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
            if (i == j) {
                if (!(sum > 1e-14 * matrix[i * n + i])) return false;
                l[i][i] = std::sqrt(sum);
            } else {
                l[i][j] = sum / l[j][j];
            }
        }
    }
    const auto solve = [&](double* x) {
        for (int i = 0; i < n; ++i) {
            for (int k = 0; k < i; ++k) x[i] -= l[i][k] * x[k];
            x[i] /= l[i][i];
        }
        for (int i = n - 1; i >= 0; --i) {
            for (int k = i + 1; k < n; ++k) x[i] -= l[k][i] * x[k];
            x[i] /= l[i][i];
        }
    };
    solve(right);
    for (int m = 0; m < n; ++m) {
        double unit[most_columns] = {};
        unit[m] = 1;
        solve(unit);
        for (int i = 0; i < n; ++i) matrix[i * n + m] = unit[i];
    }
    return true;
}

}  // namespace drude
