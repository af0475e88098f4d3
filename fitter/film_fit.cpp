#include "fitter/film_fit.h"

#include <ceres/jet.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/executor.h"
#include "fitter/film_search.h"
#include "fitter/film_solver.h"
#include "fitter/fit_data.h"
#include "fitter/identifiability.h"
#include "fitter/roughness.h"

namespace drude {

namespace {

constexpr size_t starts_refined = 8, averaged_starts = 3;
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

void set_common(const FilmSolution& solution, const FreeFilmParameters& free,
                const Identifiability& known, double sigma_scale, const FilmRange& range,
                FitResult* result) {
    size_t column = 0;
    for (size_t j = 0; j < film_parameter_count; ++j) {
        if (!free[j]) continue;
        const FilmParameterInfo& info = film_parameters()[j];
        FittedParameter parameter;
        parameter.name = info.name;
        parameter.unit = info.unit;
        // Beyond its range a standard deviation says that nothing is known: what rounding leaves of
        // a vanishing derivative still has a rank.
        parameter.sigma = known.sigma[column] * info.scale * sigma_scale;
        parameter.identifiable =
            known.identifiable[column] && !(known.sigma[column] > range.upper[j] - range.lower[j]);
        if (!parameter.identifiable) parameter.sigma = not_known;
        parameter.value = parameter.identifiable ? solution.values[j] * info.scale : not_known;
        const double margin = 1e-9 * (range.upper[j] - range.lower[j]);
        parameter.at_bound = solution.values[j] <= range.lower[j] + margin ||
                             solution.values[j] >= range.upper[j] - margin;
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
            film_index(problem.centre(i).material, ceres::Jet<double, 1>(solution.values[1], 0));
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

void set_layer(const FilmProblem& problem, const FilmSolution& solution, const FitOptions& options,
               FitResult* result) {
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
    const auto add = [&](double nm, const Index& dense, const FittedPoint& nearest) {
        const auto index = film_index(dense, solution.values[1]);
        constants.wavelength_nm.push_back(nm);
        constants.n.push_back(index.n);
        constants.k.push_back(index.k);
        constants.sigma_n.push_back(nearest.sigma_n);
        constants.sigma_k.push_back(nearest.sigma_k);
    };
    // As far as the slit reaches.
    const BandNode& first = problem.bands.front().front();
    const BandNode& last = problem.bands.back().back();
    const auto& points = result->points;
    if (first.wavelength_nm < points.front().wavelength_nm) {
        add(first.wavelength_nm, first.material, points.front());
    }
    for (size_t i = 0; i < points.size(); ++i) {
        add(points[i].wavelength_nm, problem.centre(i).material, points[i]);
    }
    if (last.wavelength_nm > points.back().wavelength_nm) {
        add(last.wavelength_nm, last.material, points.back());
    }
    if (solution.values[4] > 0) {
        result->layers.push_back(roughness_layer(constants, solution.values[4]));
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

void warn(FitResult* result, const FitOptions& options) {
    const bool unweighted = options.unweighted;
    if (options.film.spread_nm.given()) {
        result->warnings.emplace_back(
            "the material holds the mean thickness: its spread belongs to this beam, and is not "
            "written");
    }
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
    const double reduced = result->chi2_reduced(), scatter = 3 * chi2_scatter(*result, options);
    if (reduced > 1 + scatter) {
        result->warnings.push_back(fmt::format(
            "reduced chi-square {:.3g}, expected 1 +- {:.2g}: other constants of film or "
            "substrate, "
            "an uneven film, a wide bandwidth, a wrong angle of incidence, or standard deviations "
            "stated too small",
            reduced, scatter));
    }
}

// From every start, best first.
std::vector<FilmSolution> solve_all(const FilmProblem& problem,
                                    const std::vector<FilmValues>& starts,
                                    const FreeFilmParameters& free, const FitOptions& options) {
    const FilmRange range = film_range(problem, options);
    if (options.film.spread_nm.value > range.upper[3]) {
        user_error(
            "found a thickness spread of {} nm, expected at most {:.4g}: beyond, no fringe of the "
            "measured wavelengths is left",
            options.film.spread_nm.value, range.upper[3]);
    }
    std::vector<FilmSolution> solutions(starts.size());
    parallel_for(starts.size(), options.threads,
                 [&](size_t i) { solutions[i] = solve_film(problem, starts[i], free, range); });
    std::stable_sort(solutions.begin(), solutions.end(),
                     [](const FilmSolution& a, const FilmSolution& b) {
                         if (a.converged != b.converged) return a.converged;
                         return a.chi2 < b.chi2;
                     });
    return solutions;
}

// An average costs a hundred reflections a datum: only the starts that do best without it are worth
// it, and the slit is divided as finely as films of their thickness ask for.
FilmProblem prepare_average(const Measurement& measurement, const FilmProblem& coherent,
                            const FitOptions& options, std::vector<FilmValues>* starts) {
    FreeFilmParameters free = free_film_parameters(options);
    free[3] = free[4] = false;
    const std::vector<FilmSolution> even = solve_all(coherent, *starts, free, options);
    FitOptions as_thick = options;
    as_thick.film.largest_thickness_nm = 1;
    starts->clear();
    for (size_t i = 0; i < std::min(averaged_starts, even.size()); ++i) {
        const FilmValues& from = even[i].values;
        starts->push_back(film_start({from[0], from[1], 0}, coherent, options));
        as_thick.film.largest_thickness_nm =
            std::max(as_thick.film.largest_thickness_nm, 1.2 * from[0]);
    }
    return make_film_problem(measurement, as_thick);
}

}  // namespace

FitResult fit_film(const Measurement& measurement, const FitOptions& options) {
    const FilmProblem coherent = make_coherent_film_problem(measurement, options);
    const bool averaged = options.film.bandwidth_nm > 0 || options.film.spread_nm.given();
    FilmProblem problem = averaged ? coherent : make_film_problem(measurement, options);
    const FreeFilmParameters free = free_film_parameters(options);
    const FilmRange range = film_range(problem, options);
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
    result.parameters = static_cast<int>(std::count(free.begin(), free.end(), true));

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
              : search_film(coherent, porosities, options.film.largest_thickness_nm, starts_refined,
                            options.threads);
    std::vector<FilmValues> values;
    for (const FilmStart& start : starts) values.push_back(film_start(start, problem, options));
    if (averaged) problem = prepare_average(measurement, coherent, options, &values);
    const std::vector<FilmSolution> solutions = solve_all(problem, values, free, options);
    if (solutions.empty() || !solutions.front().converged) {
        throw Error(Cause::answer_is_no,
                    fmt::format("no fit: least squares converged from none of {} starts",
                                solutions.size()));
    }
    const FilmSolution& best = solutions.front();
    std::vector<double> residuals;
    const std::vector<double> jacobian = film_jacobian(problem, best, free, &residuals);
    const Identifiability known = analyse_jacobian(jacobian, result.data, result.parameters);
    // Beyond the range that was searched a standard deviation says that nothing is known: what
    // rounding leaves of a vanishing derivative still has a rank.
    if (jacobian.empty() || !known.identifiable[0] ||
        known.sigma[0] > options.film.largest_thickness_nm) {
        throw Error(
            Cause::answer_is_no,
            fmt::format("no fit: {} data do not determine the thickness of the film", result.data));
    }
    for (const double residual : residuals) result.chi2 += residual * residual;
    const double scale = std::sqrt(noise_variance(result, options));
    set_common(best, free, known, scale, range, &result);
    set_points(problem, best, free[1] ? known.sigma[1] * scale : 0, residuals, &result);
    set_layer(problem, best, options, &result);
    result.thickness_spread_nm = best.values[3];
    result.bandwidth_nm = options.film.bandwidth_nm;
    set_rival(solutions, &result);
    std::vector<double> ends;
    for (const FilmSolution& solution : solutions) {
        ends.push_back(solution.converged ? solution.chi2 : not_known);
    }
    result.starts = count_starts(ends);
    warn(&result, options);
    return result;
}

}  // namespace drude
