// Repeated noisy measurements of one metal against the Cramer-Rao bound.
#pragma once

#include <ceres/jet.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/executor.h"
#include "fit_cases.h"
#include "fitter/fit.h"
#include "fitter/fit_data.h"
#include "fitter/identifiability.h"
#include "fitter/point_residuals.h"

namespace drude {

// Of n or of k, over all draws that gave a value.
struct Scatter {
    double bound = 0;     // Cramer-Rao: the smallest standard deviation of an unbiased estimator
    double ratio = 0;     // sample standard deviation over the bound
    double bias = 0;      // mean error over the bound
    double coverage = 0;  // fraction of draws whose own one-sigma interval holds the truth
};

struct CramerRao {
    Scatter n, k;
    double condition = 0;  // of the weighted Jacobian at the truth
    size_t draws = 0, refused = 0;
};

// n, k of the six angles of the paper with 0.05 and 0.1 degrees of noise: covariance from the
// Jacobian at the truth, (J^T J)^-1. What `estimator` does not look at (rho2: Delta) does not
// count.
inline Identifiability bound_at_truth(const MetalCase& metal, Estimator estimator) {
    using Jet = ceres::Jet<double, 2>;
    const auto groups = group_by_wavelength(measured(metal, paper_angles(), 0), {});
    const PointResiduals model{&groups[0], estimator};
    const Jet index[] = {Jet(metal.n, 0), Jet(metal.k, 1)};
    std::vector<Jet> residuals(static_cast<size_t>(model.count()));
    model(index, residuals.data());
    std::vector<double> jacobian;
    for (const Jet& residual : residuals) {
        jacobian.push_back(residual.v[0]);
        jacobian.push_back(residual.v[1]);
    }
    return analyse_jacobian(jacobian, model.count(), 2);
}

// `draws` independent measurements of the metal, seeds 1 to `draws`; metals are kept apart by
// `stream`. The bound of rho2 is that of tan^2 Psi alone, the bound of the other two that of Psi
// and Delta. The result does not depend on `threads`.
inline CramerRao sample_cramer_rao(const MetalCase& metal, const std::string& estimator,
                                   uint64_t stream, size_t draws, int threads) {
    std::vector<FittedPoint> points(draws);
    FitOptions options;
    options.estimator = estimator;
    options.threads = 1;
    parallel_for(draws, threads, [&](size_t i) {
        try {
            points[i] =
                fit_measurement(measured(metal, paper_angles(), i + 1, stream), options).points[0];
        } catch (const Error& error) {
            if (error.cause() != Cause::answer_is_no) throw;
        }
    });
    const Identifiability bound =
        bound_at_truth(metal, estimator == "rho2" ? Estimator::rho2 : Estimator::psi_delta);
    CramerRao result;
    result.draws = draws;
    result.condition = bound.condition;
    const auto scatter = [&](double truth, double sigma, double FittedPoint::*value,
                             double FittedPoint::*reported) {
        Scatter s;
        s.bound = sigma;
        double sum = 0, squares = 0, inside = 0, count = 0;
        for (const FittedPoint& point : points) {
            if (!point.identifiable) continue;
            const double error = point.*value - truth;
            sum += error;
            squares += error * error;
            inside += std::abs(error) < point.*reported;
            ++count;
        }
        const double mean = sum / count;
        s.ratio = std::sqrt((squares - count * mean * mean) / (count - 1)) / sigma;
        s.bias = mean / sigma;
        s.coverage = inside / count;
        return s;
    };
    for (const FittedPoint& point : points) result.refused += point.identifiable ? 0 : 1;
    result.n = scatter(metal.n, bound.sigma[0], &FittedPoint::n, &FittedPoint::sigma_n);
    result.k = scatter(metal.k, bound.sigma[1], &FittedPoint::k, &FittedPoint::sigma_k);
    return result;
}

}  // namespace drude
