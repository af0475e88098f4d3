#include "device/signal/calibration_fit.h"

#include <algorithm>
#include <cmath>

namespace drude {

Fitted fit_model(const Model& model, int parameters, const double* start,
                 const std::vector<BinnedFit>& points, const std::vector<double>& analyser_rad) {
    Fitted fit;
    std::copy(start, start + parameters, fit.value);
    fit.freedom = 2 * static_cast<int>(points.size()) - parameters;
    if (fit.freedom < 0) return fit;
    for (int iteration = 0; iteration < 50; ++iteration) {
        double matrix[16] = {}, right[4] = {};
        fit.chi2 = 0;
        for (size_t i = 0; i < points.size(); ++i) {
            double alpha, beta, slope[2][4];
            model(fit.value, analyser_rad[i], &alpha, &beta);
            for (int m = 0; m < parameters; ++m) {
                constexpr double step = 1e-6;
                double moved[4], above[2], below[2];
                std::copy(fit.value, fit.value + 4, moved);
                moved[m] += step;
                model(moved, analyser_rad[i], &above[0], &above[1]);
                moved[m] -= 2 * step;
                model(moved, analyser_rad[i], &below[0], &below[1]);
                for (int c = 0; c < 2; ++c) slope[c][m] = (above[c] - below[c]) / (2 * step);
            }
            // Where there is no noise, all count alike.
            const double floor = 1e-18;
            const Covariance& n = points[i].noise;
            const double aa = n.aa + floor, bb = n.bb + floor;
            const double determinant = aa * bb - n.ab * n.ab;
            const double weight[2][2] = {{bb / determinant, -n.ab / determinant},
                                         {-n.ab / determinant, aa / determinant}};
            const double residual[2] = {points[i].alpha - alpha, points[i].beta - beta};
            for (int c = 0; c < 2; ++c) {
                for (int e = 0; e < 2; ++e) {
                    fit.chi2 += residual[c] * weight[c][e] * residual[e];
                    for (int m = 0; m < parameters; ++m) {
                        right[m] += slope[c][m] * weight[c][e] * residual[e];
                        for (int k = 0; k < parameters; ++k) {
                            matrix[m * parameters + k] += slope[c][m] * weight[c][e] * slope[e][k];
                        }
                    }
                }
            }
        }
        if (!solve_normal_equations(parameters, matrix, right)) return fit;
        double change = 0;
        for (int m = 0; m < parameters; ++m) {
            fit.value[m] += right[m];
            change = std::max(change, std::abs(right[m]));
            if (!std::isfinite(fit.value[m])) return fit;
        }
        std::copy(matrix, matrix + parameters * parameters, fit.covariance);
        if (change < 1e-11) {
            fit.good = true;
            return fit;
        }
    }
    return fit;
}

double WeightedMean::sigma() const {
    const double scatter = count > 1 ? std::max(0.0, squares - sum * mean()) / (count - 1) : 1.0;
    return std::sqrt(std::max(1.0, scatter) / weight);
}

std::vector<BinnedFit> bin_of(const std::vector<std::vector<BinnedFit>>& scans, size_t bin) {
    std::vector<BinnedFit> points;
    for (const auto& scan : scans) {
        if (scan[bin].usable) points.push_back(scan[bin]);
    }
    return points.size() == scans.size() ? points : std::vector<BinnedFit>{};
}

}  // namespace drude
