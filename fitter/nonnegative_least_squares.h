// Linear least squares whose unknowns are not negative.
#pragma once

#include <Eigen/Core>

namespace drude {

// The x >= 0 that makes |A x - b| smallest, by the active sets of Lawson & Hanson (Solving Least
// Squares Problems, 1974, chapter 23). A: rows x columns, finite; columns of zeros get 0. Ends
// after 3 columns steps at the latest, with what was reached by then.
Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

}  // namespace drude
