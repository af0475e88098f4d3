#include "fitter/point_fit.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "base/error.h"
#include "fitter/dense_solver.h"
#include "fitter/identifiability.h"
#include "fitter/inversion.h"
#include "fitter/point_residuals.h"

namespace drude {

namespace {

using PointCost = ceres::AutoDiffCostFunction<PointResiduals, ceres::DYNAMIC, 2>;

std::unique_ptr<PointCost> make_cost(const PointResiduals& residuals) {
    return std::make_unique<PointCost>(new PointResiduals(residuals), residuals.count());
}

// "" where the solver converged.
std::string minimise(ceres::CostFunction* cost, double* index) {
    ceres::Problem::Options ownership;
    ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ownership.disable_all_safety_checks = true;
    ceres::Problem problem(ownership);
    problem.AddResidualBlock(cost, nullptr, index);
    problem.SetParameterLowerBound(index, 0, smallest_n);
    problem.SetParameterLowerBound(index, 1, 0);
    problem.SetParameterUpperBound(index, 0, largest_index);
    problem.SetParameterUpperBound(index, 1, largest_index);
    ceres::Solver::Options options = dense_solver(200, 1e-13);
    options.function_tolerance = 1e-15;
    options.gradient_tolerance = 1e-12;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    if (summary.termination_type == ceres::CONVERGENCE && std::isfinite(index[0]) &&
        std::isfinite(index[1])) {
        return "";
    }
    return fmt::format("the least squares did not converge within {} steps",
                       summary.iterations.size());
}

// A start that is inside the bounds, away from the vacuum (where nothing is reflected) and from
// k = 0 (where the derivative by k of what reflects symmetrically in k vanishes).
void make_start(const AveragedIndex& from, double* index) {
    const bool usable = from.angles > 0 && std::isfinite(from.n) && std::isfinite(from.k);
    index[0] = usable ? std::clamp(from.n, 1e-3, 0.1 * largest_index) : 1.0;
    index[1] = usable ? std::clamp(from.k, 1e-6, 0.1 * largest_index) : 1.0;
    if (std::abs(index[0] - 1) < 1e-3 && index[1] < 1e-3) index[1] = 1e-3;
}

void refuse(FittedPoint* point, std::string reason) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    point->identifiable = false;
    point->n = point->k = point->sigma_n = point->sigma_k = point->correlation = nan;
    point->chi2 = nan;
    point->reason = std::move(reason);
}

std::string too_few(const WavelengthData& data, Estimator estimator) {
    const size_t angles = data.points.size();
    const std::string where =
        fmt::format("{} angle{} of incidence", angles, angles == 1 ? "" : "s");
    if (estimator == Estimator::rho2) {
        return fmt::format(
            "{} give{} {} value{} of tan^2 Psi for the two unknowns n and k: measure at two angles "
            "or more, or use Delta as well (--estimator psi-delta)",
            where, angles == 1 ? "s" : "", angles, angles == 1 ? "" : "s");
    }
    return fmt::format("{}: Psi and Delta do not determine n and k", where);
}

double chi2_at(const PointCost& cost, const double* index) {
    std::vector<double> residuals(static_cast<size_t>(cost.num_residuals()));
    const double* parameters[] = {index};
    if (!cost.Evaluate(parameters, residuals.data(), nullptr)) {
        return std::numeric_limits<double>::infinity();
    }
    double sum = 0;
    for (const double residual : residuals) sum += residual * residual;
    return sum;
}

// When a fit starts from metals and dielectrics of every sort, too.
enum class OtherStarts { never, if_poor, always };

// More than noise explains: five standard deviations of chi-square above its mean.
bool is_poor(double chi2, int data) {
    return !(chi2 < data + 5 * std::sqrt(2.0 * data));
}

// The best minimum reached. "" where one converged.
std::string minimise_from(const AveragedIndex& start, OtherStarts others, PointCost* cost,
                          double* index, std::vector<double>* ends) {
    make_start(start, index);
    std::string failure = minimise(cost, index);
    double best = failure.empty() ? chi2_at(*cost, index) : std::numeric_limits<double>::infinity();
    *ends = {best};
    if (others == OtherStarts::never) return failure;
    if (others == OtherStarts::if_poor && !is_poor(best, cost->num_residuals())) return failure;
    constexpr double starts[][2] = {{0.2, 3}, {1, 6},      {0.6, 1.5}, {2.5, 3.5},
                                    {4, 0.1}, {1.5, 0.01}, {0.5, 0.2}, {0.1, 0.1}};
    for (const auto& other : starts) {
        double trial[2] = {other[0], other[1]};
        if (!minimise(cost, trial).empty()) continue;
        const double chi2 = chi2_at(*cost, trial);
        ends->push_back(chi2);
        if (!(chi2 < best)) continue;
        best = chi2;
        failure.clear();
        std::copy(trial, trial + 2, index);
    }
    return failure;
}

void fit_least_squares(const WavelengthData& data, Estimator estimator, const AveragedIndex& start,
                       OtherStarts others, FittedPoint* point) {
    const auto cost = make_cost({&data, estimator});
    double index[2];
    std::vector<double> ends;
    const std::string failure = minimise_from(start, others, cost.get(), index, &ends);
    point->starts = count_starts(ends);
    if (!failure.empty()) return refuse(point, failure);
    if (std::max(index[0], index[1]) > 0.999 * largest_index) {
        return refuse(point, "no surface explains the data: n and k run off to infinity");
    }
    if (std::hypot(index[0] - 1, index[1]) < 1e-6) {
        return refuse(point,
                      "no surface explains the data: n and k run off to those of the vacuum");
    }

    const auto count = static_cast<size_t>(point->data);
    std::vector<double> residuals(count), jacobian(2 * count);
    const double* parameters[] = {index};
    double* jacobians[] = {jacobian.data()};
    if (!cost->Evaluate(parameters, residuals.data(), jacobians)) {
        return refuse(point, "the solution reflects nothing");
    }
    const Identifiability known = analyse_jacobian(jacobian, point->data, 2);
    point->condition = known.condition;
    if (!known.all()) {
        return refuse(point, "the data do not determine n and k: their Jacobian has no full rank");
    }
    point->identifiable = true;
    point->n = index[0];
    point->k = index[1];
    point->sigma_n = known.sigma[0];
    point->sigma_k = known.sigma[1];
    point->correlation = known.correlation[1];
    for (const double residual : residuals) point->chi2 += residual * residual;
}

void take_inversion(const WavelengthData& data, const AveragedIndex& average, FittedPoint* point) {
    if (average.angles == 0) return refuse(point, too_few(data, Estimator::inversion));
    double index[2] = {std::max(average.n, smallest_n), std::max(average.k, 0.0)};
    const auto cost = make_cost({&data, Estimator::inversion});
    const auto count = static_cast<size_t>(point->data);
    std::vector<double> residuals(count), jacobian(2 * count);
    const double* parameters[] = {index};
    double* jacobians[] = {jacobian.data()};
    if (!cost->Evaluate(parameters, residuals.data(), jacobians)) {
        return refuse(point, "the solution reflects nothing");
    }
    point->condition = analyse_jacobian(jacobian, point->data, 2).condition;
    point->identifiable = true;
    point->n = index[0];
    point->k = index[1];
    point->sigma_n = average.sigma_n;
    point->sigma_k = average.sigma_k;
    point->correlation = average.correlation;
    for (const double residual : residuals) point->chi2 += residual * residual;
}

// Refused with the reason where there are fewer residuals than unknowns.
FittedPoint empty_point(const WavelengthData& data, Estimator estimator) {
    FittedPoint point;
    point.wavelength_nm = data.wavelength_nm;
    point.data = PointResiduals{&data, estimator}.count();
    if (point.data < 2) refuse(&point, too_few(data, estimator));
    return point;
}

double chi2_of_normal_incidence(const WavelengthData& data) {
    const Reflection<double> normal_incidence = {1, 1, -1, 0};
    double chi2 = 0;
    for (const AnglePoint& angle : data.points) {
        double residuals[2] = {0, 0};
        psi_delta_residuals(angle, normal_incidence, residuals);
        chi2 += residuals[0] * residuals[0] + residuals[1] * residuals[1];
    }
    return chi2;
}

bool is_at_bound(const FittedPoint& point) {
    return point.identifiable && (point.n <= smallest_n * 1.001 || point.k <= 0);
}

}  // namespace

FittedPoint fit_point(const WavelengthData& data, Estimator estimator) {
    FittedPoint point = empty_point(data, estimator);
    if (!point.reason.empty()) return point;
    const AveragedIndex inverted = invert_and_average(data);
    // Below layers interference makes minima that a bare surface does not have, and tan^2 Psi alone
    // has some where n < 1 and k is small.
    const OtherStarts others = !data.bare()                   ? OtherStarts::always
                               : estimator == Estimator::rho2 ? OtherStarts::if_poor
                                                              : OtherStarts::never;
    if (estimator == Estimator::inversion) {
        take_inversion(data, inverted, &point);
    } else if (estimator == Estimator::rho2) {
        fit_least_squares(data, estimator, start_from_tan2_psi(data), others, &point);
    } else {
        fit_least_squares(data, estimator, inverted, others, &point);
    }
    // Delta takes no part in rho2, and neither does what follows from it. Below layers the closed
    // form gives pseudo-values, whose spread is no fault of the model.
    if (estimator != Estimator::rho2 && data.bare()) {
        point.spread_n = inverted.spread_n;
        point.spread_k = inverted.spread_k;
    }
    point.at_bound = is_at_bound(point);
    return point;
}

FittedPoint fit_point_from(const WavelengthData& data, Estimator estimator, Index start) {
    if (estimator == Estimator::inversion) throw std::logic_error("an inversion takes no start");
    FittedPoint point = empty_point(data, estimator);
    if (!point.reason.empty()) return point;
    AveragedIndex from;
    from.n = start.n;
    from.k = start.k;
    from.angles = 1;
    fit_least_squares(data, estimator, from, OtherStarts::never, &point);
    point.at_bound = is_at_bound(point);
    return point;
}

void refuse_if_unknown(const WavelengthData& data, Estimator estimator, FittedPoint* point) {
    if (!point->identifiable) return;
    if (estimator != Estimator::rho2 && !is_poor(chi2_of_normal_incidence(data), point->data)) {
        return refuse(point, normal_incidence_reason);
    }
    refuse_if_vague(point);
}

bool understates_errors(const FittedPoint& point, Estimator estimator) {
    return estimator == Estimator::rho2 && point.identifiable &&
           (10 * point.sigma_n > point.n || 10 * point.sigma_k > point.k);
}

bool hold_nothing(const std::vector<WavelengthData>& groups, Estimator estimator) {
    double chi2 = 0;
    int data = 0;
    for (const WavelengthData& group : groups) {
        chi2 += chi2_of_normal_incidence(group);
        data += PointResiduals{&group, estimator}.count();
    }
    return estimator != Estimator::rho2 && !is_poor(chi2, data);
}

void refuse_if_vague(FittedPoint* point) {
    if (!point->identifiable) return;
    const double length = std::hypot(point->n, point->k);
    if (std::hypot(point->sigma_n, point->sigma_k) <= not_known_at_all * length) return;
    refuse(point, fmt::format("the data do not determine n and k: their standard deviations would "
                              "be {:.2g} and {:.2g}",
                              point->sigma_n, point->sigma_k));
}

}  // namespace drude
