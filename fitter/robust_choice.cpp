#include "fitter/robust_choice.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "fitter/row_residuals.h"

namespace drude {

RobustChoice robust_choice(const FitResult& fit, const Measurement& measurement,
                           const FitOptions& options) {
    RobustChoice choice;
    choice.loss = "none";
    const bool single = fit.estimator == "rho2";
    std::vector<double> squares;
    for (const RowResidual& residual : row_residuals(fit, measurement, options)) {
        if (std::isfinite(residual.squared())) squares.push_back(residual.squared());
    }
    choice.rows = static_cast<int>(squares.size());
    if (options.unweighted || squares.empty()) {
        choice.reason = "without standard deviations no row is known to be far from the model";
        return choice;
    }
    const auto middle = squares.begin() + static_cast<ptrdiff_t>(squares.size() / 2);
    std::nth_element(squares.begin(), middle, squares.end());
    // Medians of chi-square with one and two degrees of freedom.
    const double scale = std::max(1.0, *middle / (single ? 0.4549 : 1.3863));
    choice.far = static_cast<int>(std::count_if(squares.begin(), squares.end(), [&](double square) {
        return square > far_squared * scale;
    }));
    const double tail = single ? std::erfc(std::sqrt(far_squared / 2)) : std::exp(-far_squared / 2);
    choice.expected_far = tail * choice.rows;
    if (choice.far <= choice.expected_far + 3 * std::sqrt(choice.expected_far)) {
        choice.reason = "no more rows are far from the model than Gaussian errors bring";
    } else if (2 * choice.far > choice.rows) {
        choice.reason = "so many rows are far from the model that it is the model that is wrong";
    } else {
        choice.loss = "tukey";
        choice.reason = fmt::format(
            "{} of {} rows are more than {:g} standard deviations from the "
            "model, which Gaussian errors do not bring",
            choice.far, choice.rows, std::sqrt(far_squared * scale));
    }
    return choice;
}

}  // namespace drude
