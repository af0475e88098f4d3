#include "fitter/identifiability.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace drude {

namespace {

constexpr double rank_threshold = 1e-10;
// A parameter belongs to the null space where more than this of its unit vector does; rounding
// leaves about 1e-16, and a truly mixed direction has components of order one.
constexpr double null_component = 1e-6;

double condition_number(const Eigen::MatrixXd& matrix) {
    if (matrix.rows() < matrix.cols()) return std::numeric_limits<double>::infinity();
    const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(matrix).singularValues();
    const double smallest = values(values.size() - 1);
    return smallest > 0 ? values(0) / smallest : std::numeric_limits<double>::infinity();
}

}  // namespace

bool Identifiability::all() const {
    return std::all_of(identifiable.begin(), identifiable.end(), [](bool yes) { return yes; });
}

double Identifiability::sigma_of(const std::vector<double>& gradient) const {
    for (const std::vector<double>& direction : null_directions) {
        double along = 0, square = 0;
        for (size_t j = 0; j < gradient.size(); ++j) {
            along += gradient[j] * direction[j];
            square += gradient[j] * scale[j] * gradient[j] * scale[j];
        }
        if (std::abs(along) > null_component * std::sqrt(square)) {
            return std::numeric_limits<double>::quiet_NaN();
        }
    }
    return std::sqrt(std::max(covariance_of(gradient, gradient), 0.0));
}

double Identifiability::covariance_of(const std::vector<double>& a,
                                      const std::vector<double>& b) const {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        for (size_t j = 0; j < b.size(); ++j) sum += a[i] * covariance[i * b.size() + j] * b[j];
    }
    return sum;
}

Identifiability analyse_jacobian(const std::vector<double>& jacobian, int rows, int columns) {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    Identifiability result;
    result.identifiable.assign(static_cast<size_t>(columns), false);
    result.sigma.assign(static_cast<size_t>(columns), nan);
    result.correlation.assign(static_cast<size_t>(columns) * static_cast<size_t>(columns), nan);
    result.condition = std::numeric_limits<double>::infinity();
    const Eigen::MatrixXd J = Eigen::Map<const RowMajor>(jacobian.data(), rows, columns);
    if (rows == 0 || !J.allFinite()) return result;
    result.condition = condition_number(J);

    Eigen::VectorXd scale(columns);
    for (int j = 0; j < columns; ++j) {
        const double length = J.col(j).norm();
        scale(j) = length > 0 ? 1 / length : 1;
    }
    result.scale.assign(scale.data(), scale.data() + columns);
    const Eigen::MatrixXd scaled = J * scale.asDiagonal();
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeThinU | Eigen::ComputeFullV);
    const Eigen::VectorXd& values = svd.singularValues();
    const Eigen::MatrixXd& V = svd.matrixV();
    int rank = 0;
    while (rank < values.size() && values(rank) > rank_threshold * values(0)) ++rank;
    for (int j = 0; j < columns; ++j) {
        double outside = 0;
        for (int i = rank; i < columns; ++i) outside += V(j, i) * V(j, i);
        result.identifiable[static_cast<size_t>(j)] = std::sqrt(outside) < null_component;
    }
    for (int i = rank; i < columns; ++i) {
        const Eigen::VectorXd direction = scale.asDiagonal() * V.col(i);
        result.null_directions.emplace_back(direction.data(), direction.data() + columns);
    }
    const Eigen::MatrixXd root =
        scale.asDiagonal() * V.leftCols(rank) * values.head(rank).cwiseInverse().asDiagonal();
    const RowMajor covariance = root * root.transpose();
    result.covariance.assign(covariance.data(), covariance.data() + covariance.size());
    if (rank < columns) return result;

    for (int i = 0; i < columns; ++i) {
        result.sigma[static_cast<size_t>(i)] = std::sqrt(covariance(i, i));
        for (int j = 0; j < columns; ++j) {
            result.correlation[static_cast<size_t>(i * columns + j)] =
                covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j));
        }
    }
    return result;
}

}  // namespace drude
