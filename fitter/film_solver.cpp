#include "fitter/film_solver.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "fitter/dense_solver.h"
#include "fitter/film_average.h"
#include "fitter/fit_data.h"
#include "fitter/offset_fit.h"

namespace drude {

namespace {

constexpr double largest_porosity = 0.95;  // beyond, the film is next to nothing
constexpr double largest_roughness = 100;

// The fewest parameters that the problem and `values` call for: derivatives are what a step costs.
std::unique_ptr<ceres::CostFunction> make_cost(const FilmProblem& problem, const FilmValues& values,
                                               const FreeFilmParameters& free) {
    using Straight = ceres::AutoDiffCostFunction<FilmResiduals, ceres::DYNAMIC, 1, 1>;
    using Even = ceres::AutoDiffCostFunction<FilmResiduals, ceres::DYNAMIC, 1, 1, 1>;
    using Uneven = ceres::AutoDiffCostFunction<FilmResiduals, ceres::DYNAMIC, 1, 1, 1, 1, 1>;
    const int count = problem.residual_count();
    FilmResiduals* const residuals = new FilmResiduals{&problem};
    if (problem.rough || problem.spread_nodes.size() > 1) {
        return std::make_unique<Uneven>(residuals, count);
    }
    if (free[2] || values[2] != 0) return std::make_unique<Even>(residuals, count);
    return std::make_unique<Straight>(residuals, count);
}

// How many of the parameters the cost takes.
size_t blocks_of(const ceres::CostFunction& cost) {
    return cost.parameter_block_sizes().size();
}

FilmSolution solve(const FilmProblem& problem, const FilmValues& start,
                   const FreeFilmParameters& free, const FilmRange& range, bool bounded) {
    FilmSolution solution;
    solution.values = start;
    const std::unique_ptr<ceres::CostFunction> cost = make_cost(problem, start, free);
    ceres::Problem::Options ownership;
    ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::Problem least_squares(ownership);
    std::vector<double*> addresses;
    for (size_t j = 0; j < blocks_of(*cost); ++j) addresses.push_back(&solution.values[j]);
    least_squares.AddResidualBlock(cost.get(), nullptr, addresses);
    for (size_t j = 0; j < addresses.size(); ++j) {
        if (!free[j]) {
            least_squares.SetParameterBlockConstant(addresses[j]);
        } else if (bounded) {
            least_squares.SetParameterLowerBound(addresses[j], 0, range.lower[j]);
            least_squares.SetParameterUpperBound(addresses[j], 0, range.upper[j]);
        }
    }
    const ceres::Solver::Options options = dense_solver(bounded ? 200 : 50, 1e-12);
    ceres::Solver::Summary summary;
    ceres::Solve(options, &least_squares, &summary);
    solution.converged =
        summary.termination_type == ceres::CONVERGENCE && std::isfinite(summary.final_cost);
    if (summary.IsSolutionUsable() && std::isfinite(summary.final_cost)) {
        solution.chi2 = 2 * summary.final_cost;
    }
    return solution;
}

}  // namespace

const std::array<FilmParameterInfo, film_parameter_count>& film_parameters() {
    static const std::array<FilmParameterInfo, film_parameter_count> parameters = {
        {{"thickness", "nm", 1},
         {"porosity", "", 1},
         {"angle offset", "deg", 180 / pi},
         {"thickness spread", "nm", 1},
         {"roughness", "nm", 1}}};
    return parameters;
}

FilmProblem make_coherent_film_problem(const Measurement& measurement, const FitOptions& options) {
    FilmProblem problem;
    problem.groups = group_by_wavelength(measurement, options);
    problem.estimator = options.estimator == "rho2" ? Estimator::rho2 : Estimator::psi_delta;
    for (const WavelengthData& group : problem.groups) {
        const double nm = group.wavelength_nm;
        problem.bands.push_back(
            {{nm, 1, options.film.substrate.at(nm), options.film.material.at(nm)}});
    }
    return problem;
}

FilmProblem make_film_problem(const Measurement& measurement, const FitOptions& options) {
    FilmProblem problem = make_coherent_film_problem(measurement, options);
    if (options.film.bandwidth_nm > 0) {
        set_bands(options.film, options.film.bandwidth_nm, &problem);
    }
    if (options.film.spread_nm.given()) set_spread_nodes(&problem);
    problem.rough = options.roughness_nm.given();
    return problem;
}

FreeFilmParameters free_film_parameters(const FitOptions& options) {
    return {true, !options.film.porosity.has_value(), options.fit_angle_offset,
            options.film.spread_nm.fitted, options.roughness_nm.fitted};
}

FilmRange film_range(const FilmProblem& problem, const FitOptions& options) {
    return {{0, 0, -largest_angle_offset, 0, 0},
            {options.film.largest_thickness_nm, largest_porosity, largest_angle_offset,
             largest_spread(problem), largest_roughness}};
}

FilmValues film_start(const FilmStart& start, const FilmProblem& problem,
                      const FitOptions& options) {
    // At 0 the derivative by the spread vanishes.
    const double spread = options.film.spread_nm.fitted ? std::min(0.01 * start.thickness_nm + 1,
                                                                   0.3 * largest_spread(problem))
                                                        : options.film.spread_nm.value;
    const double roughness = options.roughness_nm.fitted ? 2 : options.roughness_nm.value;
    return {start.thickness_nm, start.porosity, 0, spread, roughness};
}

// Bounds cost Ceres a line search and a second Jacobian every step, and few fits meet one: they are
// set only where a solution without them does not converge or lies outside.
FilmSolution solve_film(const FilmProblem& problem, const FilmValues& start,
                        const FreeFilmParameters& free, const FilmRange& range) {
    const FilmSolution solution = solve(problem, start, free, range, false);
    bool inside = solution.converged;
    for (size_t j = 0; j < film_parameter_count; ++j) {
        inside = inside && (!free[j] || (solution.values[j] >= range.lower[j] &&
                                         solution.values[j] <= range.upper[j]));
    }
    return inside ? solution : solve(problem, start, free, range, true);
}

std::vector<double> film_jacobian(const FilmProblem& problem, const FilmSolution& solution,
                                  const FreeFilmParameters& free, std::vector<double>* residuals) {
    const std::unique_ptr<ceres::CostFunction> cost = make_cost(problem, solution.values, free);
    const size_t rows = static_cast<size_t>(problem.residual_count()), blocks = blocks_of(*cost);
    residuals->assign(rows, 0.0);
    std::vector<std::vector<double>> columns(blocks, std::vector<double>(rows));
    std::vector<const double*> parameters;
    std::vector<double*> jacobians;
    for (size_t j = 0; j < blocks; ++j) {
        parameters.push_back(&solution.values[j]);
        jacobians.push_back(columns[j].data());
    }
    if (!cost->Evaluate(parameters.data(), residuals->data(), jacobians.data())) return {};
    std::vector<double> jacobian;
    for (size_t i = 0; i < rows; ++i) {
        for (size_t j = 0; j < blocks; ++j) {
            if (free[j]) jacobian.push_back(columns[j][i]);
        }
    }
    return jacobian;
}

}  // namespace drude
