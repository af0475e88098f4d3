// Pearson's chi-square, in units of standard deviations of a normal deviate (Wilson & Hilferty
// 1931, PNAS 17, 684).
#pragma once

#include <cmath>
#include <vector>

namespace drude {

// Cells that expect fewer than five are pooled.
inline double chi_square_deviate(const std::vector<double>& observed,
                                 const std::vector<double>& expected) {
    double sum = 0, pooled_observed = 0, pooled_expected = 0;
    int cells = -1;
    const auto count = [&](double o, double e) {
        sum += (o - e) * (o - e) / e;
        ++cells;
    };
    for (size_t i = 0; i < observed.size(); ++i) {
        if (expected[i] >= 5) {
            count(observed[i], expected[i]);
        } else {
            pooled_observed += observed[i];
            pooled_expected += expected[i];
        }
    }
    if (pooled_expected >= 5) count(pooled_observed, pooled_expected);
    const double k = cells;
    return (std::cbrt(sum / k) - (1 - 2 / (9 * k))) / std::sqrt(2 / (9 * k));
}

}  // namespace drude
