#include "fitter/nonnegative_least_squares.h"

#include <Eigen/QR>
#include <vector>

namespace drude {

namespace {

// The unconstrained solution over the free columns; 0 elsewhere.
Eigen::VectorXd solve_free(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                           const std::vector<bool>& is_free) {
    std::vector<Eigen::Index> columns;
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
        if (is_free[static_cast<size_t>(j)]) columns.push_back(j);
    }
    Eigen::MatrixXd part(A.rows(), static_cast<Eigen::Index>(columns.size()));
    for (size_t c = 0; c < columns.size(); ++c) {
        part.col(static_cast<Eigen::Index>(c)) = A.col(columns[c]);
    }
    const Eigen::VectorXd solution = part.colPivHouseholderQr().solve(b);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(A.cols());
    for (size_t c = 0; c < columns.size(); ++c) {
        x(columns[c]) = solution(static_cast<Eigen::Index>(c));
    }
    return x;
}

}  // namespace

Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
    const Eigen::Index count = A.cols();
    // Columns of length 1, so that gradients compare.
    Eigen::VectorXd length = A.colwise().norm();
    for (Eigen::Index j = 0; j < count; ++j) {
        if (!(length(j) > 0)) length(j) = 1;
    }
    const Eigen::MatrixXd scaled = A * length.cwiseInverse().asDiagonal();
    const double enough = 1e-12 * b.norm();
    std::vector<bool> is_free(static_cast<size_t>(count), false);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(count);
    for (Eigen::Index step = 0; step < 3 * count; ++step) {
        const Eigen::VectorXd downhill = scaled.transpose() * (b - scaled * x);
        Eigen::Index best = -1;
        for (Eigen::Index j = 0; j < count; ++j) {
            if (is_free[static_cast<size_t>(j)] || !(downhill(j) > enough)) continue;
            if (best < 0 || downhill(j) > downhill(best)) best = j;
        }
        if (best < 0) break;
        is_free[static_cast<size_t>(best)] = true;
        Eigen::VectorXd wanted = solve_free(scaled, b, is_free);
        // What would turn negative stops at 0 on the way and is no longer free.
        while (true) {
            double reach = 1;
            for (Eigen::Index j = 0; j < count; ++j) {
                if (is_free[static_cast<size_t>(j)] && wanted(j) <= 0 && x(j) > wanted(j)) {
                    reach = std::min(reach, x(j) / (x(j) - wanted(j)));
                }
            }
            x += reach * (wanted - x);
            if (reach == 1) break;
            for (Eigen::Index j = 0; j < count; ++j) {
                if (!is_free[static_cast<size_t>(j)] || x(j) > 1e-14 * (1 + x.maxCoeff())) continue;
                if (wanted(j) <= 0) {
                    is_free[static_cast<size_t>(j)] = false;
                    x(j) = 0;
                }
            }
            wanted = solve_free(scaled, b, is_free);
        }
    }
    return x.cwiseMax(0.0).cwiseQuotient(length);
}

}  // namespace drude
