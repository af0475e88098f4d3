#include "fitter/film_fit.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/executor.h"
#include "fitter/film_search.h"
#include "fitter/fit_data.h"
#include "fitter/identifiability.h"
#include "fitter/offset_fit.h"

namespace drude {

namespace {

constexpr size_t starts_refined = 8;
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

using FilmCost = ceres::AutoDiffCostFunction<FilmResiduals, ceres::DYNAMIC, 1, 1, 1>;

struct FilmSolution {
    double values[3] = {0, 0, 0};  // thickness in nm, porosity, offset in radians
    double chi2 = std::numeric_limits<double>::infinity();
    bool converged = false;
};

struct FreeParameters {
    bool porosity = true, offset = false;
    bool is_free(int parameter) const {
        return parameter == 0 || (parameter == 1 ? porosity : offset);
    }
    int count() const { return 1 + (porosity ? 1 : 0) + (offset ? 1 : 0); }
};

FilmSolution refine(const FilmProblem& problem, const FilmStart& start, FreeParameters free,
                    double largest_nm) {
    FilmSolution solution;
    double* const values = solution.values;
    values[0] = start.thickness_nm;
    values[1] = start.porosity;
    ceres::Problem least_squares;
    least_squares.AddResidualBlock(
        new FilmCost(new FilmResiduals{&problem}, problem.residual_count()), nullptr, values,
        values + 1, values + 2);
    const double lower[] = {0, 0, -largest_angle_offset};
    const double upper[] = {largest_nm, largest_porosity, largest_angle_offset};
    for (int j = 0; j < 3; ++j) {
        if (free.is_free(j)) {
            least_squares.SetParameterLowerBound(values + j, 0, lower[j]);
            least_squares.SetParameterUpperBound(values + j, 0, upper[j]);
        } else {
            least_squares.SetParameterBlockConstant(values + j);
        }
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.logging_type = ceres::SILENT;
    options.num_threads = 1;
    options.max_num_iterations = 200;
    options.function_tolerance = 1e-12;
    options.parameter_tolerance = 1e-12;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &least_squares, &summary);
    solution.chi2 = 2 * summary.final_cost;
    solution.converged =
        summary.termination_type == ceres::CONVERGENCE && std::isfinite(summary.final_cost);
    return solution;
}

// Row-major residuals x free parameters.
std::vector<double> jacobian_at(const FilmProblem& problem, const FilmSolution& solution,
                                FreeParameters free, std::vector<double>* residuals) {
    FilmCost cost(new FilmResiduals{&problem}, problem.residual_count());
    const size_t rows = static_cast<size_t>(problem.residual_count());
    residuals->assign(rows, 0.0);
    std::vector<std::vector<double>> columns(3, std::vector<double>(rows));
    const double* parameters[] = {solution.values, solution.values + 1, solution.values + 2};
    double* jacobians[] = {columns[0].data(), columns[1].data(), columns[2].data()};
    if (!cost.Evaluate(parameters, residuals->data(), jacobians)) return {};
    std::vector<double> jacobian;
    for (size_t i = 0; i < rows; ++i) {
        for (int j = 0; j < 3; ++j) {
            if (free.is_free(j)) jacobian.push_back(columns[static_cast<size_t>(j)][i]);
        }
    }
    return jacobian;
}

void set_common(const FilmSolution& solution, FreeParameters free, const Identifiability& known,
                double sigma_scale, double largest_nm, FitResult* result) {
    struct Declared {
        const char* name;
        const char* unit;
        double scale, lower, upper;  // in the parameter's own unit
    };
    const Declared declared[] = {
        {"thickness", "nm", 1, 0, largest_nm},
        {"porosity", "", 1, 0, largest_porosity},
        {"angle offset", "deg", 180 / pi, -largest_angle_offset, largest_angle_offset}};
    size_t column = 0;
    for (int j = 0; j < 3; ++j) {
        if (!free.is_free(j)) continue;
        const Declared& d = declared[j];
        FittedParameter parameter;
        parameter.name = d.name;
        parameter.unit = d.unit;
        parameter.identifiable = known.identifiable[column];
        parameter.value = parameter.identifiable ? solution.values[j] * d.scale : not_known;
        parameter.sigma = known.sigma[column] * d.scale * sigma_scale;
        const double margin = 1e-9 * (d.upper - d.lower);
        parameter.at_bound =
            solution.values[j] <= d.lower + margin || solution.values[j] >= d.upper - margin;
        result->common.push_back(parameter);
        ++column;
    }
    result->common_correlation = known.correlation;
    result->condition = known.condition;
}

void set_points(const FilmProblem& problem, const FilmSolution& solution, double sigma_porosity,
                const std::vector<double>& residuals, FitResult* result) {
    size_t at = 0;
    for (size_t i = 0; i < problem.groups.size(); ++i) {
        FittedPoint point;
        point.wavelength_nm = problem.groups[i].wavelength_nm;
        const auto index =
            film_index(problem.material[i], ceres::Jet<double, 1>(solution.values[1], 0));
        point.n = index.n.a;
        point.k = index.k.a;
        point.sigma_n = std::abs(index.n.v[0]) * sigma_porosity;
        point.sigma_k = std::abs(index.k.v[0]) * sigma_porosity;
        point.data =
            problem.residuals_per_point() * static_cast<int>(problem.groups[i].points.size());
        for (int j = 0; j < point.data; ++j, ++at) point.chi2 += residuals[at] * residuals[at];
        point.condition = result->condition;
        point.identifiable = true;
        result->points.push_back(point);
    }
}

void set_layer(const FilmSolution& solution, const FitOptions& options, FitResult* result) {
    FilmLayer layer;
    layer.thickness_nm = solution.values[0];
    OpticalConstants& constants = layer.constants;
    constants.name =
        fmt::format("{} with {:.2f} % pores", options.film.material.name, 100 * solution.values[1]);
    constants.material = options.film.material.material;
    constants.kind = "fitted";
    constants.citation = "Bruggeman's mixture of " + options.film.material.name + " and void";
    if (!options.film.material.citation.empty()) {
        constants.citation += "; " + options.film.material.citation;
    }
    for (const FittedPoint& point : result->points) {
        constants.wavelength_nm.push_back(point.wavelength_nm);
        constants.n.push_back(point.n);
        constants.k.push_back(point.k);
        constants.sigma_n.push_back(point.sigma_n);
        constants.sigma_k.push_back(point.sigma_k);
    }
    result->layers.push_back(std::move(layer));
    result->substrate = options.film.substrate;
}

// The best of the minima at another thickness than the first's.
void set_rival(const std::vector<FilmSolution>& solutions, FitResult* result) {
    const FilmSolution& best = solutions.front();
    for (const FilmSolution& other : solutions) {
        if (!other.converged) continue;
        if (std::abs(other.values[0] - best.values[0]) < 1 + 0.01 * best.values[0]) continue;
        result->rival_thickness_nm = other.values[0];
        result->rival_chi2_excess = other.chi2 - best.chi2;
        return;
    }
}

void warn(FitResult* result, bool unweighted) {
    for (const FittedParameter& parameter : result->common) {
        if (!parameter.identifiable) {
            result->warnings.push_back(
                fmt::format("the data do not determine the {}: it is not reported, and no standard "
                            "deviations are",
                            parameter.name));
        } else if (parameter.at_bound) {
            result->warnings.push_back(
                fmt::format("the {} ends at the bound {:.6g} of its range: the truth may lie "
                            "outside, or another model is needed",
                            parameter.name, parameter.value));
        } else if (parameter.name == "porosity" && parameter.sigma > 0.2) {
            result->warnings.push_back(
                fmt::format("porosity {:.3f} +- {:.2g}: a film this thin does not tell porosity "
                            "from thickness; fix it",
                            parameter.value, parameter.sigma));
        }
    }
    const double scale = unweighted ? result->chi2_reduced() : 1;
    if (result->rival_thickness_nm > 0 && result->rival_chi2_excess < 25 * scale) {
        result->warnings.push_back(
            fmt::format("{:.2f} nm explains the data almost as well (chi-square {:.3g} more)",
                        result->rival_thickness_nm, result->rival_chi2_excess));
    }
    if (unweighted || result->dof() <= 0) return;
    const double reduced = result->chi2_reduced(), scatter = 3 * std::sqrt(2.0 / result->dof());
    if (reduced > 1 + scatter) {
        result->warnings.push_back(fmt::format(
            "reduced chi-square {:.3g}, expected 1 +- {:.2g}: other constants of film or "
            "substrate, "
            "an uneven film, a wide bandwidth, a wrong angle of incidence, or standard deviations "
            "stated too small",
            reduced, scatter));
    }
}

}  // namespace

FilmProblem make_film_problem(const Measurement& measurement, const FitOptions& options) {
    FilmProblem problem;
    problem.groups = group_by_wavelength(measurement, options);
    problem.estimator = options.estimator == "rho2" ? Estimator::rho2 : Estimator::psi_delta;
    for (const WavelengthData& group : problem.groups) {
        problem.substrate.push_back(options.film.substrate.at(group.wavelength_nm));
        problem.material.push_back(options.film.material.at(group.wavelength_nm));
    }
    return problem;
}

FitResult fit_film(const Measurement& measurement, const FitOptions& options) {
    const FilmProblem problem = make_film_problem(measurement, options);
    const FreeParameters free{!options.film.porosity.has_value(), options.fit_angle_offset};
    FitResult result;
    result.estimator = options.estimator;
    result.model = options.model;
    result.warnings = data_warnings(measurement, options);
    for (const OpticalConstants* constants : {&options.film.substrate, &options.film.material}) {
        const std::string warning = constants->range_warning(problem.groups.front().wavelength_nm,
                                                             problem.groups.back().wavelength_nm);
        if (!warning.empty()) result.warnings.push_back(warning);
    }
    result.data = problem.residual_count();
    result.parameters = free.count();

    std::vector<double> porosities;
    if (options.film.porosity) {
        porosities = {*options.film.porosity};
    } else {
        for (int i = 0; i <= 9; ++i) porosities.push_back(0.05 * i);
    }
    const auto& guess = options.film.start;
    const std::vector<FilmStart> starts =
        guess ? std::vector<FilmStart>{{guess->thickness_nm,
                                        options.film.porosity.value_or(guess->porosity), 0}}
              : search_film(problem, porosities, options.film.largest_thickness_nm, starts_refined,
                            options.threads);
    std::vector<FilmSolution> solutions(starts.size());
    parallel_for(starts.size(), options.threads, [&](size_t i) {
        solutions[i] = refine(problem, starts[i], free, options.film.largest_thickness_nm);
    });
    std::stable_sort(solutions.begin(), solutions.end(),
                     [](const FilmSolution& a, const FilmSolution& b) {
                         if (a.converged != b.converged) return a.converged;
                         return a.chi2 < b.chi2;
                     });
    if (solutions.empty() || !solutions.front().converged) {
        throw Error(Cause::answer_is_no,
                    fmt::format("no fit: least squares converged from none of {} starts",
                                solutions.size()));
    }
    const FilmSolution& best = solutions.front();
    std::vector<double> residuals;
    const std::vector<double> jacobian = jacobian_at(problem, best, free, &residuals);
    const Identifiability known = analyse_jacobian(jacobian, result.data, free.count());
    // Beyond the range that was searched a standard deviation says that nothing is known: what
    // rounding leaves of a vanishing derivative still has a rank.
    if (jacobian.empty() || !known.identifiable[0] ||
        known.sigma[0] > options.film.largest_thickness_nm) {
        throw Error(
            Cause::answer_is_no,
            fmt::format("no fit: {} data do not determine the thickness of the film", result.data));
    }
    for (const double residual : residuals) result.chi2 += residual * residual;
    const double scale =
        options.unweighted && result.dof() > 0 ? std::sqrt(result.chi2_reduced()) : 1;
    set_common(best, free, known, scale, options.film.largest_thickness_nm, &result);
    set_points(problem, best, free.porosity ? known.sigma[1] * scale : 0, residuals, &result);
    set_layer(best, options, &result);
    set_rival(solutions, &result);
    warn(&result, options.unweighted);
    return result;
}

}  // namespace drude
