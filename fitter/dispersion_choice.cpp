#include "fitter/dispersion_choice.h"

#include <cmath>
#include <optional>

#include "base/error.h"
#include "fitter/model_ladder.h"

namespace drude {

namespace {

LadderRung rung_of(const std::string& name, const FitResult& fit, bool unweighted) {
    LadderRung rung;
    rung.model = name;
    rung.data = fit.data;
    rung.parameters = fit.parameters;
    rung.chi2_reduced = fit.chi2_reduced();
    rung.bic = bayesian_criterion(fit, unweighted);
    return rung;
}

struct ExpectedChi2 {
    double value = 1, scatter = 0;
};

// Of a formula that holds. A reduced chi-square below 1 says that standard deviations are stated
// too large, nothing against a fit; where that of the points does, it is what the noise comes to.
ExpectedChi2 expected_chi2(const FitResult& points, const FitResult& formula,
                           const FitOptions& options) {
    const double scatter = chi2_scatter(formula, options);
    if (!(points.dof() > 0)) return {1, scatter};
    const double noise = points.chi2_reduced(), of_points = chi2_scatter(points, options);
    if (!(noise < 1 - 3 * of_points)) return {1, scatter};
    return {noise, noise * std::hypot(scatter, of_points)};
}

std::string objection(const FitResult& points, const FitResult& formula,
                      const FitOptions& options) {
    if (formula.data < points.data) {
        return fmt::format("it explains {} data, fewer than {}", formula.data, points.data);
    }
    if (!(formula.dof() > 0)) return "it has as many parameters as data";
    if (!options.unweighted) {
        const auto [expected, scatter] = expected_chi2(points, formula, options);
        if (formula.chi2_reduced() > expected + 3 * scatter) {
            return fmt::format("its reduced chi-square is {:.4g}, above {:.4g} + {:.2g}",
                               formula.chi2_reduced(), expected, 3 * scatter);
        }
    }
    const double gain = bayesian_criterion(points, options.unweighted) -
                        bayesian_criterion(formula, options.unweighted);
    if (std::isnan(gain)) {
        return "n and k point by point leave no residuals, and without standard deviations nothing "
               "else says how large those of the formula may be";
    }
    return gain > ladder_bic_gain ? "" : small_gain(gain);
}

}  // namespace

FitResult fit_dispersion_if_it_holds(const Measurement& measurement, const FitOptions& options) {
    FitOptions by_points = options, by_formula = options;
    by_points.dispersion.clear();
    by_formula.dispersion = "compact";
    FitResult points = fit_measurement(measurement, by_points);
    LadderRung first = rung_of("point by point", points, options.unweighted), second;
    second.model = "compact formula";
    std::optional<FitResult> formula;
    try {
        formula = fit_measurement(measurement, by_formula);
        second = rung_of(formula->dispersion, *formula, options.unweighted);
        second.objection = objection(points, *formula, options);
    } catch (const Error& error) {
        if (error.cause() != Cause::answer_is_no) throw;
        second.objection = error.message();
    }
    second.taken = second.objection.empty();
    first.taken = true;  // as the first rung of every ladder
    FitResult& taken = second.taken ? *formula : points;
    taken.ladder = {std::move(first), std::move(second)};
    return std::move(taken);
}

}  // namespace drude
