#include "fitter/dispersion_fit.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/executor.h"
#include "fitter/dense_solver.h"
#include "fitter/dispersion_start.h"
#include "fitter/identifiability.h"
#include "fitter/kramers_kronig_spline.h"
#include "fitter/model_ladder.h"
#include "fitter/offset_fit.h"
#include "fitter/point_residuals.h"
#include "materials/dispersion.h"

namespace drude {

namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
constexpr size_t starts_refined = 6;

struct Solution {
    std::vector<double> parameters;
    double offset = 0;
    double chi2 = std::numeric_limits<double>::infinity();
};

struct Setup {
    const std::vector<WavelengthData>& groups;
    const std::vector<FittedPoint>& points;  // point by point
    Estimator estimator;
    const std::vector<double>& start;
    bool fit_offset, unweighted;
    int threads;
};

// A start that absorbs less than nothing somewhere has no residuals.
bool has_value(const DispersionCost& cost, const Solution& solution) {
    std::vector<double> residuals(static_cast<size_t>(cost.num_residuals()));
    const double* const blocks[] = {solution.parameters.data(), &solution.offset};
    return cost.Evaluate(blocks, residuals.data(), nullptr);
}

Solution refine(const DispersionModel& model, const Setup& setup, std::vector<double> start) {
    DispersionCost cost(model, setup.groups, setup.estimator);
    Solution solution;
    solution.parameters = std::move(start);
    if (!has_value(cost, solution)) return solution;
    double* const p = solution.parameters.data();
    ceres::Problem::Options ownership;
    ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::Problem problem(ownership);
    problem.AddResidualBlock(&cost, nullptr, p, &solution.offset);
    for (size_t j = 0; j < model.count(); ++j) {
        problem.SetParameterLowerBound(p, static_cast<int>(j), model.parameters()[j].lower);
        problem.SetParameterUpperBound(p, static_cast<int>(j), model.parameters()[j].upper);
    }
    if (setup.fit_offset) {
        problem.SetParameterLowerBound(&solution.offset, 0, -largest_angle_offset);
        problem.SetParameterUpperBound(&solution.offset, 0, largest_angle_offset);
    } else {
        problem.SetParameterBlockConstant(&solution.offset);
    }
    const ceres::Solver::Options options = dense_solver(300, 1e-10);
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    // Flat valleys of formulas with more parameters than the data need end by the number of steps;
    // where they stand is still the best that was found.
    if (summary.IsSolutionUsable() && std::isfinite(summary.final_cost)) {
        solution.chi2 = 2 * summary.final_cost;
    }
    return solution;
}

FittedParameter make_parameter(const DispersionParameter& declared, double value, double scale,
                               size_t column, const Identifiability& known) {
    FittedParameter parameter;
    parameter.name = declared.name;
    parameter.unit = declared.unit;
    // One parameter that the data leave open takes nothing from the certainty of others.
    std::vector<double> gradient(known.identifiable.size(), 0.0);
    gradient[column] = scale;
    parameter.sigma = known.sigma_of(gradient);
    parameter.identifiable = known.identifiable[column] && std::isfinite(parameter.sigma);
    if (!parameter.identifiable) parameter.sigma = not_known;
    parameter.value = parameter.identifiable ? value * scale : not_known;
    const double margin = 1e-9 * (declared.upper - declared.lower);
    parameter.at_bound = value <= declared.lower + margin || value >= declared.upper - margin;
    return parameter;
}

FittedPoint make_point(const DispersionModel& model, const Setup& setup, size_t i,
                       const Solution& solution, const Identifiability& known) {
    const size_t width = model.count(), columns = width + (setup.fit_offset ? 1 : 0);
    std::vector<double> dn(columns, 0.0), dk(columns, 0.0);
    Index index;
    model.index(i, solution.parameters.data(), &index, dn.data(), dk.data());
    FittedPoint point;
    point.wavelength_nm = setup.groups[i].wavelength_nm;
    point.n = index.n;
    point.k = index.k;
    point.sigma_n = known.sigma_of(dn);
    point.sigma_k = known.sigma_of(dk);
    const double product = point.sigma_n * point.sigma_k;
    point.correlation = product > 0 ? known.covariance_of(dn, dk) / product : 0;
    point.condition = known.condition;
    point.identifiable = std::isfinite(point.sigma_n) && std::isfinite(point.sigma_k);
    if (!point.identifiable) {
        point.n = point.k = point.correlation = not_known;
        point.reason = "the formula leaves n or k open here";
    }
    point.spread_n = setup.points[i].spread_n;
    point.spread_k = setup.points[i].spread_k;
    return point;
}

DispersionFit make_fit(const DispersionModel& model, const Setup& setup, const Solution& solution) {
    const DispersionCost cost(model, setup.groups, setup.estimator);
    const size_t rows = static_cast<size_t>(cost.num_residuals()), width = model.count();
    const size_t columns = width + (setup.fit_offset ? 1 : 0);
    std::vector<double> residuals(rows), by_model(rows * width), by_offset(rows), jacobian;
    const double* const blocks[] = {solution.parameters.data(), &solution.offset};
    double* jacobians[] = {by_model.data(), by_offset.data()};
    cost.Evaluate(blocks, residuals.data(), jacobians);
    for (size_t i = 0; i < rows; ++i) {
        const auto from = by_model.begin() + static_cast<ptrdiff_t>(i * width);
        jacobian.insert(jacobian.end(), from, from + static_cast<ptrdiff_t>(width));
        if (setup.fit_offset) jacobian.push_back(by_offset[i]);
    }
    const Identifiability known =
        analyse_jacobian(jacobian, static_cast<int>(rows), static_cast<int>(columns));
    DispersionFit fit;
    fit.name = model.name();
    fit.values = solution.parameters;
    fit.data = static_cast<int>(rows);
    fit.condition = known.condition;
    fit.correlation = known.correlation;
    for (size_t j = 0; j < width; ++j) {
        fit.parameters.push_back(
            make_parameter(model.parameters()[j], solution.parameters[j], 1, j, known));
    }
    if (setup.fit_offset) {
        DispersionParameter offset;
        offset.name = "angle offset";
        offset.unit = "deg";
        offset.lower = -largest_angle_offset;
        offset.upper = largest_angle_offset;
        fit.parameters.push_back(make_parameter(offset, solution.offset, 180 / pi, width, known));
    }
    size_t row = 0;
    for (size_t i = 0; i < setup.groups.size(); ++i) {
        FittedPoint point = make_point(model, setup, i, solution, known);
        point.data = PointResiduals{&setup.groups[i], setup.estimator}.count();
        for (int j = 0; j < point.data; ++j, ++row) point.chi2 += residuals[row] * residuals[row];
        fit.chi2 += point.chi2;
        fit.points.push_back(point);
    }
    return fit;
}

DispersionFit fit_one(const std::string& name, const Setup& setup) {
    std::vector<double> wavelengths;
    int data = 0;
    for (const WavelengthData& group : setup.groups) {
        wavelengths.push_back(group.wavelength_nm);
        data += PointResiduals{&group, setup.estimator}.count();
    }
    const DispersionModel model(name, wavelengths);
    const int unknowns = static_cast<int>(model.count()) + (setup.fit_offset ? 1 : 0);
    if (data < unknowns) {
        throw Error(Cause::answer_is_no,
                    fmt::format("no fit: {} data do not determine the {} parameters of the "
                                "dispersion '{}'",
                                data, unknowns, name));
    }
    std::vector<PermittivityTarget> targets = permittivity_targets(setup.points);
    // Too few of them mislead.
    if (2 * targets.size() < model.count() || 2 * targets.size() < setup.points.size()) {
        targets.clear();
    }
    const auto starts = setup.start.size() == model.count()
                            ? std::vector<std::vector<double>>{setup.start}
                            : search_dispersion(model, targets, starts_refined, setup.threads);
    std::vector<Solution> solutions(starts.size());
    parallel_for(starts.size(), setup.threads,
                 [&](size_t i) { solutions[i] = refine(model, setup, starts[i]); });
    const auto best =
        std::min_element(solutions.begin(), solutions.end(),
                         [](const Solution& a, const Solution& b) { return a.chi2 < b.chi2; });
    if (best == solutions.end() || !std::isfinite(best->chi2)) {
        throw Error(Cause::answer_is_no,
                    fmt::format("no fit: from none of {} starts does the dispersion '{}' end where "
                                "the surface reflects and im eps >= 0 at every wavelength",
                                starts.size(), name));
    }
    std::vector<double> ends;
    for (const Solution& solution : solutions) ends.push_back(solution.chi2);
    DispersionFit fit = make_fit(model, setup, *best);
    fit.starts = count_starts(ends);
    return fit;
}

// The smallest formula that the data need.
DispersionFit fit_smallest(const std::vector<std::string>& names, const Setup& setup) {
    DispersionFit best;
    std::vector<LadderRung> ladder;
    double lowest = std::numeric_limits<double>::infinity();
    for (const std::string& name : names) {
        LadderRung rung;
        rung.model = name;
        try {
            DispersionFit fit = fit_one(name, setup);
            const int parameters = static_cast<int>(fit.parameters.size());
            rung.data = fit.data;
            rung.parameters = parameters;
            rung.chi2_reduced = fit.chi2 / (fit.data - parameters);
            rung.bic = bayesian_criterion(fit.chi2, fit.data, parameters, setup.unweighted);
            rung.taken = fit.data > parameters && lowest - rung.bic > ladder_bic_gain;
            if (fit.data <= parameters) {
                rung.chi2_reduced = rung.bic = not_known;
                rung.objection = "it has as many parameters as data";
            } else if (rung.taken) {
                lowest = rung.bic;
                best = std::move(fit);
            } else {
                rung.objection = small_gain(lowest - rung.bic);
            }
        } catch (const Error& error) {
            if (error.cause() != Cause::answer_is_no) throw;
            rung.objection = error.message();
        }
        ladder.push_back(std::move(rung));
    }
    if (best.points.empty()) {
        throw Error(Cause::answer_is_no, fmt::format("no fit with {}: {}", ladder.front().model,
                                                     ladder.front().objection));
    }
    best.ladder = std::move(ladder);
    return best;
}

std::vector<std::string> spline_names(const std::vector<WavelengthData>& groups) {
    if (groups.size() < 2) {
        throw Error(Cause::answer_is_no,
                    "no fit: a spline over the wavelengths takes several, found one");
    }
    const double first = photon_energy(groups.back().wavelength_nm);
    const double last = photon_energy(groups.front().wavelength_nm);
    std::vector<std::string> names;
    int intervals = std::max(4, KramersKronigSpline::fewest_intervals(first, last));
    if (intervals > most_spline_intervals) {
        throw Error(
            Cause::answer_is_no,
            fmt::format(
                "no fit: a spline from {:g} to {:g} nm would take {} intervals, expected at "
                "most {}: its knots must stay above 0 eV (--range narrows the data)",
                groups.front().wavelength_nm, groups.back().wavelength_nm, intervals,
                most_spline_intervals));
    }
    for (; intervals <= 48 && intervals + 6 < 2 * static_cast<int>(groups.size());
         intervals += std::max(2, intervals / 3)) {
        names.push_back(fmt::format("spline:{}", intervals));
    }
    if (names.empty()) names.push_back(fmt::format("spline:{}", intervals));
    return names;
}

}  // namespace

DispersionFit fit_dispersion(const std::vector<WavelengthData>& groups, Estimator estimator,
                             const std::string& name, const std::vector<double>& start,
                             bool fit_offset, bool unweighted, int threads) {
    std::vector<FittedPoint> points(groups.size());
    parallel_for(groups.size(), threads,
                 [&](size_t i) { points[i] = fit_point(groups[i], estimator); });
    const Setup setup{groups, points, estimator, start, fit_offset, unweighted, threads};
    if (name == "compact") return fit_smallest({"drude", "drude+cp", "drude+2cp"}, setup);
    if (name == "spline") return fit_smallest(spline_names(groups), setup);
    return fit_one(name, setup);
}

}  // namespace drude
