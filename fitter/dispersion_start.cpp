#include "fitter/dispersion_start.h"

#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/counter_random.h"
#include "base/executor.h"
#include "fitter/dense_solver.h"
#include "fitter/nonnegative_least_squares.h"

namespace drude {

namespace {

double uniform(int number, size_t parameter) {
    const PhiloxBlock bits = philox(
        {static_cast<uint32_t>(number), static_cast<uint32_t>(parameter), 0x64697370, 0}, {1, 0});
    return (bits[0] + 0.5) * 0x1p-32;
}

// The whitened permittivities of `parameters`, two numbers a target.
Eigen::VectorXd whitened(const DispersionModel& model,
                         const std::vector<PermittivityTarget>& targets,
                         const std::vector<double>& parameters) {
    std::vector<std::complex<double>> derivatives(model.count());
    Eigen::VectorXd values(2 * static_cast<Eigen::Index>(targets.size()));
    Eigen::Index row = 0;
    for (const PermittivityTarget& target : targets) {
        const std::complex<double> e =
            model.epsilon(target.wavelength, parameters.data(), derivatives.data());
        for (const auto& weights : target.weights) {
            values(row++) = weights[0] * e.real() + weights[1] * e.imag();
        }
    }
    return values;
}

Eigen::VectorXd whitened_targets(const std::vector<PermittivityTarget>& targets) {
    Eigen::VectorXd values(2 * static_cast<Eigen::Index>(targets.size()));
    Eigen::Index row = 0;
    for (const PermittivityTarget& target : targets) {
        for (const auto& weights : target.weights) {
            values(row++) = weights[0] * target.epsilon.real() + weights[1] * target.epsilon.imag();
        }
    }
    return values;
}

void solve_linear(const DispersionModel& model, const std::vector<PermittivityTarget>& targets,
                  std::vector<double>* parameters) {
    const auto& declared = model.parameters();
    std::vector<size_t> linear;
    for (size_t j = 0; j < declared.size(); ++j) {
        if (declared[j].role == ParameterRole::nonlinear) continue;
        linear.push_back(j);
    }
    if (linear.empty()) return;
    for (const size_t j : linear) (*parameters)[j] = declared[j].lower;
    const Eigen::VectorXd rest = whitened(model, targets, *parameters);
    Eigen::MatrixXd basis(rest.size(), static_cast<Eigen::Index>(linear.size()));
    for (size_t c = 0; c < linear.size(); ++c) {
        std::vector<double> unit = *parameters;
        unit[linear[c]] += 1;
        basis.col(static_cast<Eigen::Index>(c)) = whitened(model, targets, unit) - rest;
    }
    if (!basis.allFinite() || !rest.allFinite()) return;
    const Eigen::VectorXd above =
        nonnegative_least_squares(basis, whitened_targets(targets) - rest);
    for (size_t c = 0; c < linear.size(); ++c) {
        const DispersionParameter& parameter = declared[linear[c]];
        double value = above(static_cast<Eigen::Index>(c));
        if (parameter.role == ParameterRole::squared) value = std::sqrt(value);
        // A little inside, where the derivatives by the other parameters of a term live.
        const double margin = 1e-6 * (parameter.last - parameter.first);
        (*parameters)[linear[c]] =
            std::clamp(parameter.lower + value, parameter.lower + margin, parameter.upper);
    }
}

struct Candidate {
    std::vector<double> parameters;
    double chi2 = std::numeric_limits<double>::infinity();
};

Candidate refine(const DispersionModel& model, const std::vector<PermittivityTarget>& targets,
                 std::vector<double> start) {
    PermittivityCost cost(model, targets);
    Candidate candidate;
    candidate.parameters = std::move(start);
    double* const p = candidate.parameters.data();
    ceres::Problem::Options ownership;
    ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::Problem problem(ownership);
    problem.AddResidualBlock(&cost, nullptr, p);
    for (size_t j = 0; j < model.count(); ++j) {
        problem.SetParameterLowerBound(p, static_cast<int>(j), model.parameters()[j].lower);
        problem.SetParameterUpperBound(p, static_cast<int>(j), model.parameters()[j].upper);
    }
    ceres::Solver::Options options = dense_solver(100, 1e-6);
    options.parameter_tolerance = 1e-8;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    if (summary.IsSolutionUsable() && std::isfinite(summary.final_cost)) {
        candidate.chi2 = 2 * summary.final_cost;
    }
    return candidate;
}

}  // namespace

std::vector<double> dispersion_start(const DispersionModel& model,
                                     const std::vector<PermittivityTarget>& targets, int number) {
    std::vector<double> parameters;
    for (size_t j = 0; j < model.count(); ++j) {
        const DispersionParameter& parameter = model.parameters()[j];
        parameters.push_back(std::lerp(parameter.first, parameter.last, uniform(number, j)));
    }
    if (!targets.empty()) solve_linear(model, targets, &parameters);
    return parameters;
}

std::vector<std::vector<double>> search_dispersion(const DispersionModel& model,
                                                   const std::vector<PermittivityTarget>& targets,
                                                   size_t count, int threads) {
    const size_t starts = static_cast<size_t>(model.starts());
    std::vector<Candidate> found(starts);
    parallel_for(starts, threads, [&](size_t i) {
        found[i].parameters = dispersion_start(model, targets, static_cast<int>(i));
        if (!targets.empty()) found[i] = refine(model, targets, std::move(found[i].parameters));
    });
    std::vector<std::vector<double>> chosen;
    if (targets.empty()) {
        for (Candidate& candidate : found) chosen.push_back(std::move(candidate.parameters));
        return chosen;
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Candidate& a, const Candidate& b) { return a.chi2 < b.chi2; });
    double last = -1;
    for (Candidate& candidate : found) {
        if (chosen.size() == count || !std::isfinite(candidate.chi2)) break;
        if (last >= 0 && candidate.chi2 - last < 1e-3 * (1 + last)) continue;
        last = candidate.chi2;
        chosen.push_back(std::move(candidate.parameters));
    }
    return chosen;
}

}  // namespace drude
