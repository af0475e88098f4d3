#include "fitter/point_profile.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fitter/dense_solver.h"
#include "fitter/offset_fit.h"
#include "fitter/point_residuals.h"

namespace drude {

namespace {

struct HeldResiduals {
    PointResiduals residuals;
    bool hold_k;
    double held;

    template <class T>
    bool operator()(const T* free, T* out) const {
        T index[2];
        index[0] = hold_k ? *free : T(held);
        index[1] = hold_k ? T(held) : *free;
        return residuals(index, out);
    }
};

// The smallest chi-square over the index that is free; `free` is the start and becomes the end.
double minimise(const WavelengthData& data, Estimator estimator, bool hold_k, double held,
                double* free) {
    const PointResiduals residuals{&data, estimator};
    ceres::Problem::Options quick;
    quick.disable_all_safety_checks = true;
    ceres::Problem problem(quick);
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<HeldResiduals, ceres::DYNAMIC, 1>(
                                 new HeldResiduals{residuals, hold_k, held}, residuals.count()),
                             nullptr, free);
    problem.SetParameterLowerBound(free, 0, hold_k ? smallest_n : 0);
    problem.SetParameterUpperBound(free, 0, largest_index);
    // At k = 0 the derivative of what reflects symmetrically in k vanishes.
    *free = std::clamp(*free, 1e-6, 0.99 * largest_index);
    const ceres::Solver::Options options = dense_solver(100, 1e-12);
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    const bool usable = summary.IsSolutionUsable() && std::isfinite(summary.final_cost);
    return usable ? 2 * summary.final_cost : std::numeric_limits<double>::infinity();
}

}  // namespace

HeldChi2 held_index_chi2(const WavelengthData& data, Estimator estimator, const FittedPoint& point,
                         bool hold_k) {
    double free = hold_k ? point.n : point.k;
    return [&data, estimator, hold_k, free](double held) mutable {
        return minimise(data, estimator, hold_k, held, &free);
    };
}

HeldChi2 held_index_chi2(const WavelengthData& data, Estimator estimator, const FittedPoint& point,
                         bool hold_k, const std::vector<double>& others, double offset_low,
                         double offset_high) {
    double free = hold_k ? point.n : point.k;
    return [&data, &others, estimator, hold_k, offset_low, offset_high, free](double held) mutable {
        const auto at_offset = [&](double offset) {
            const auto moved = with_angle_offset({data}, offset);
            return minimise(moved[0], estimator, hold_k, held, &free) +
                   chebyshev_value(others, offset_low, offset_high, offset);
        };
        return minimise_on_line(at_offset, offset_low, offset_high,
                                1e-4 * (offset_high - offset_low))
            .value;
    };
}

double chebyshev_point(size_t i, size_t count, double low, double high) {
    const double cosine = std::cos(pi * static_cast<double>(i) / static_cast<double>(count - 1));
    return 0.5 * (low + high) + 0.5 * (high - low) * cosine;
}

double chebyshev_value(const std::vector<double>& values, double low, double high, double at) {
    double above = 0, below = 0;
    for (size_t i = 0; i < values.size(); ++i) {
        const double distance = at - chebyshev_point(i, values.size(), low, high);
        if (distance == 0) return values[i];
        const bool end = i == 0 || i + 1 == values.size();
        const double weight = (i % 2 == 0 ? 1.0 : -1.0) * (end ? 0.5 : 1.0) / distance;
        above += weight * values[i];
        below += weight;
    }
    return above / below;
}

}  // namespace drude
