#include "fitter/dispersion_residuals.h"

#include <ceres/jet.h>

#include <algorithm>
#include <cmath>

#include "fitter/point_residuals.h"

namespace drude {

DispersionCost::DispersionCost(const DispersionModel& model,
                               const std::vector<WavelengthData>& groups, Estimator estimator)
    : model_(model), groups_(groups), estimator_(estimator) {
    mutable_parameter_block_sizes()->push_back(static_cast<int>(model.count()));
    mutable_parameter_block_sizes()->push_back(1);
    int count = 0;
    for (const WavelengthData& group : groups) count += PointResiduals{&group, estimator}.count();
    set_num_residuals(count);
}

bool DispersionCost::Evaluate(double const* const* parameters, double* residuals,
                              double** jacobians) const {
    using Jet = ceres::Jet<double, 3>;
    const size_t width = model_.count();
    std::vector<double> dn(width), dk(width);
    std::vector<Jet> values;
    const Jet offset(*parameters[1], 2);
    size_t row = 0;
    for (size_t i = 0; i < groups_.size(); ++i) {
        Index index;
        if (!model_.index(i, parameters[0], &index, dn.data(), dk.data())) return false;
        const PointResiduals point{&groups_[i], estimator_};
        values.resize(static_cast<size_t>(point.count()));
        const Jet nk[] = {Jet(index.n, 0), Jet(index.k, 1)};
        if (!point(nk, &offset, values.data())) return false;
        for (const Jet& value : values) {
            residuals[row] = value.a;
            if (jacobians && jacobians[0]) {
                double* const to = jacobians[0] + row * width;
                for (size_t j = 0; j < width; ++j) to[j] = value.v[0] * dn[j] + value.v[1] * dk[j];
            }
            if (jacobians && jacobians[1]) jacobians[1][row] = value.v[2];
            ++row;
        }
    }
    return true;
}

std::vector<PermittivityTarget> permittivity_targets(const std::vector<FittedPoint>& points) {
    std::vector<PermittivityTarget> targets;
    for (size_t i = 0; i < points.size(); ++i) {
        const FittedPoint& point = points[i];
        if (!point.identifiable || !(point.sigma_n > 0) || !(point.sigma_k > 0)) continue;
        const std::complex<double> N(point.n, point.k), inverse = 0.5 / N;
        // dn = re(inverse d), dk = im(inverse d); whitened by Cholesky's factor of the covariance.
        const double rest = std::sqrt(std::max(1 - point.correlation * point.correlation, 1e-12));
        const double by_n[] = {inverse.real() / point.sigma_n, -inverse.imag() / point.sigma_n};
        const double by_k[] = {inverse.imag() / point.sigma_k, inverse.real() / point.sigma_k};
        PermittivityTarget target;
        target.wavelength = i;
        target.epsilon = N * N;
        for (int j = 0; j < 2; ++j) {
            target.weights[0][j] = by_n[j];
            target.weights[1][j] = (by_k[j] - point.correlation * by_n[j]) / rest;
        }
        targets.push_back(target);
    }
    return targets;
}

PermittivityCost::PermittivityCost(const DispersionModel& model,
                                   const std::vector<PermittivityTarget>& targets)
    : model_(model), targets_(targets) {
    mutable_parameter_block_sizes()->push_back(static_cast<int>(model.count()));
    set_num_residuals(2 * static_cast<int>(targets.size()));
}

bool PermittivityCost::Evaluate(double const* const* parameters, double* residuals,
                                double** jacobians) const {
    const size_t width = model_.count();
    std::vector<std::complex<double>> derivatives(width);
    for (size_t t = 0; t < targets_.size(); ++t) {
        const PermittivityTarget& target = targets_[t];
        const std::complex<double> difference =
            model_.epsilon(target.wavelength, parameters[0], derivatives.data()) - target.epsilon;
        for (size_t part = 0; part < 2; ++part) {
            const double* const weights = target.weights[part];
            const size_t row = 2 * t + part;
            residuals[row] = weights[0] * difference.real() + weights[1] * difference.imag();
            if (!std::isfinite(residuals[row])) return false;
            if (!jacobians || !jacobians[0]) continue;
            for (size_t j = 0; j < width; ++j) {
                jacobians[0][row * width + j] =
                    weights[0] * derivatives[j].real() + weights[1] * derivatives[j].imag();
            }
        }
    }
    return true;
}

}  // namespace drude
