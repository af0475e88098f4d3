#include "fitter/film_profile.h"

#include <ceres/ceres.h>

#include <array>
#include <cmath>
#include <limits>

#include "fitter/film_fit.h"
#include "fitter/offset_fit.h"

namespace drude {

namespace {

constexpr double degree = pi / 180;
// In the order of FilmResiduals.
constexpr std::array<const char*, 3> names = {"thickness", "porosity", "angle offset"};

double unit_of(size_t parameter) {
    return parameter == 2 ? degree : 1;
}

}  // namespace

FilmBound film_bound(const std::string& name, double largest_thickness_nm) {
    if (name == names[0]) return {0, largest_thickness_nm};
    if (name == names[1]) return {0, largest_porosity};
    return {-largest_angle_offset / degree, largest_angle_offset / degree};
}

HeldChi2 held_film_chi2(const FilmProblem& problem, const FitResult& fit, const std::string& name,
                        double largest_thickness_nm, std::optional<double> known_porosity) {
    std::array<double, 3> values = {0, known_porosity.value_or(0), 0};
    std::array<bool, 3> free = {false, false, false};
    size_t held = 0;
    for (size_t j = 0; j < names.size(); ++j) {
        for (const FittedParameter& p : fit.common) {
            if (p.name != names[j] || !p.identifiable) continue;
            values[j] = p.value * unit_of(j);
            free[j] = p.name != name;
        }
        if (name == names[j]) held = j;
    }
    return [&problem, largest_thickness_nm, values, free, held](double value) mutable {
        values[held] = value * unit_of(held);
        ceres::Problem least_squares;
        least_squares.AddResidualBlock(
            new ceres::AutoDiffCostFunction<FilmResiduals, ceres::DYNAMIC, 1, 1, 1>(
                new FilmResiduals{&problem}, problem.residual_count()),
            nullptr, &values[0], &values[1], &values[2]);
        for (size_t j = 0; j < names.size(); ++j) {
            if (!free[j]) {
                least_squares.SetParameterBlockConstant(&values[j]);
                continue;
            }
            const FilmBound bound = film_bound(names[j], largest_thickness_nm);
            least_squares.SetParameterLowerBound(&values[j], 0, bound.lower * unit_of(j));
            least_squares.SetParameterUpperBound(&values[j], 0, bound.upper * unit_of(j));
        }
        ceres::Solver::Options options;
        options.linear_solver_type = ceres::DENSE_QR;
        options.logging_type = ceres::SILENT;
        options.num_threads = 1;
        options.max_num_iterations = 100;
        options.function_tolerance = 1e-10;
        options.parameter_tolerance = 1e-12;
        ceres::Solver::Summary summary;
        ceres::Solve(options, &least_squares, &summary);
        const bool usable = summary.IsSolutionUsable() && std::isfinite(summary.final_cost);
        return usable ? 2 * summary.final_cost : std::numeric_limits<double>::infinity();
    };
}

}  // namespace drude
