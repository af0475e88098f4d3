// Whether some rows are so far from the model that they should count less.
#pragma once

#include <string>

#include "fitter/fit.h"

namespace drude {

struct RobustChoice {
    std::string loss;         // "none" or "tukey"
    int rows = 0, far = 0;    // rows fitted; those far from the model
    double expected_far = 0;  // of Gaussian errors
    std::string reason;
};

// Of a least-squares fit: a row is far where the squares of its residuals exceed far_squared times
// their scale, which is 1, or the median's over its expectation where that is more (standard
// deviations stated too small, a model that is wrong everywhere). "tukey" where there are more such
// rows than Gaussian errors bring with three standard deviations, and no more than half of all:
// beyond that they are no bad rows. `measurement` and `options` are those of `fit`.
RobustChoice robust_choice(const FitResult& fit, const Measurement& measurement,
                           const FitOptions& options);

inline constexpr double far_squared = 25;

}  // namespace drude
