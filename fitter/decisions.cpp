#include "fitter/decisions.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "fitter/angle_choice.h"
#include "fitter/data_decisions.h"
#include "fitter/dispersion_choice.h"
#include "fitter/model_curve.h"
#include "fitter/model_ladder.h"

namespace drude {

namespace {

constexpr const char* parameters_unit = "parameters";

DecisionFigure parameters_of(int parameters, int data) {
    if (data == 0) return {std::nullopt, "", "could not be fitted"};
    return {static_cast<double>(parameters), parameters_unit,
            fmt::format("computed: fitted to {} data", data)};
}

DecisionFigure misfit_of(double chi2_reduced, double bic, int data, bool unweighted) {
    if (data == 0) return {std::nullopt, "", "could not be fitted"};
    const std::string criterion = std::isnan(bic) ? "" : fmt::format("; BIC {:.6g}", bic);
    if (!std::isfinite(chi2_reduced)) {
        return {std::nullopt, "", "as many parameters as data" + criterion};
    }
    return {chi2_reduced, unweighted ? "square degrees a degree of freedom" : "reduced chi-square",
            "computed from this measurement" + criterion};
}

DecisionAlternative alternative_of(const LadderRung& rung, bool unweighted) {
    const std::string name =
        rung.objection.empty() ? rung.model : fmt::format("{} ({})", rung.model, rung.objection);
    return {name, parameters_of(rung.parameters, rung.data),
            misfit_of(rung.chi2_reduced, rung.bic, rung.data, unweighted)};
}

void set_figures(const FitResult& fit, const FitOptions& options, ModelDecision* decision) {
    decision->cost = parameters_of(fit.parameters, fit.data);
    decision->error = misfit_of(fit.chi2_reduced(), bayesian_criterion(fit, options.unweighted),
                                fit.data, options.unweighted);
}

// A fit that may be refused; `why` is then the reason.
std::optional<FitResult> try_fit(const Measurement& measurement, const FitOptions& options,
                                 std::string* why) {
    try {
        return fit_measurement(measurement, options);
    } catch (const Error& error) {
        if (error.cause() != Cause::answer_is_no) throw;
        *why = error.message();
        return std::nullopt;
    }
}

bool belongs_to_formula(const LadderRung& rung) {
    return rung.model.rfind("n, k: ", 0) == 0;
}

ModelDecision model_decision(const Measurement& measurement, const FitOptions& options,
                             const FitResult& fit) {
    ModelDecision decision;
    decision.name = "film or bare";
    decision.choice = fit.model;
    if (fit.find("angle offset") != nullptr) decision.choice += " + angle offset";
    if (fit.find("thickness spread") != nullptr) decision.choice += " + spread";
    decision.override_option = "--model bulk|overlayer|film|auto";
    set_figures(fit, options, &decision);
    if (options.model == "auto") {
        decision.reason = fmt::format(
            "the smallest model of the ladder: a larger one is taken where BIC falls by more than "
            "{:g}{}",
            ladder_bic_gain, options.unweighted ? "" : " and chi-square falls, or is not above 1");
        for (const LadderRung& rung : fit.ladder) {
            if (!belongs_to_formula(rung) && rung.model != decision.choice) {
                decision.alternatives.push_back(alternative_of(rung, options.unweighted));
            }
        }
        return decision;
    }
    decision.asked = options.model != "bulk";
    decision.reason = decision.asked ? "asked for"
                                     : "what is not asked for is a bare surface: n and k take up "
                                       "whatever lies on it";
    if (options.estimator == "inversion" || !fit.robust.empty()) return decision;
    FitOptions automatic = options;
    automatic.model = "auto";
    automatic.fit_angle_offset = false;
    automatic.robust = "none";
    std::string why;
    if (const auto ladder = try_fit(measurement, automatic, &why)) {
        if (ladder->model != fit.model) {
            decision.reason += fmt::format("; --model auto would take {}", ladder->model);
        }
        for (const LadderRung& rung : ladder->ladder) {
            if (!belongs_to_formula(rung) && rung.model != fit.model) {
                decision.alternatives.push_back(alternative_of(rung, options.unweighted));
            }
        }
    }
    return decision;
}

ModelDecision dispersion_decision(const Measurement& measurement, const FitOptions& options,
                                  const FitResult& fit) {
    ModelDecision decision;
    decision.name = "point by point or formula";
    decision.override_option = "--dispersion auto|compact|drude+2cp|...";
    set_figures(fit, options, &decision);
    if (fit.model == "film") {
        decision.choice = "formula of the film's mixture";
        decision.reason = "the materials of a film are known, its porosity mixes them";
        return decision;
    }
    decision.choice = fit.dispersion.empty() ? "point by point" : fit.dispersion;
    decision.asked = !options.dispersion.empty() && options.dispersion != "auto";
    const std::string rule =
        fmt::format("a formula is taken where BIC falls by more than {:g}{}", ladder_bic_gain,
                    options.unweighted ? "" : " and its chi-square is not above 1");
    decision.reason = decision.asked                 ? "asked for"
                      : options.dispersion == "auto" ? rule
                                                     : "without a formula every wavelength stands "
                                                       "for itself, which is never wrong";
    const std::string given = options.dispersion;
    if (options.estimator == "inversion" || !fit.robust.empty()) return decision;
    FitOptions other = options_taken(options, fit);
    other.dispersion = "auto";
    other.dispersion_start.clear();
    other.robust = "none";
    std::string why;
    if (const auto compared = try_fit(measurement, other, &why)) {
        if (given != "auto" && compared->dispersion != fit.dispersion) {
            decision.reason +=
                fmt::format("; --dispersion auto would take {}",
                            compared->dispersion.empty() ? "point by point" : compared->dispersion);
        }
        for (const LadderRung& rung : compared->ladder) {
            if (rung.model != decision.choice) {
                decision.alternatives.push_back(alternative_of(rung, options.unweighted));
            }
        }
    }
    return decision;
}

std::string starts_that_meet(const StartCount& starts) {
    return fmt::format("{} of {} starts end within 1e-6 of the lowest chi-square{}", starts.in_best,
                       starts.refined,
                       starts.next_chi2_excess > 0
                           ? fmt::format(", the next {:.3g} above it", starts.next_chi2_excess)
                           : "");
}

std::string why_these_starts(const FitOptions& options, const FitResult& fit) {
    if (!fit.dispersion.empty()) {
        return fit.starts.refined > 1
                   ? "a formula starts from n and k point by point, several starts are refined"
                   : "this formula has one start: where an earlier fit of it ended, or the only "
                     "one that "
                     "the search found";
    }
    if (fit.estimator == "inversion") return "n and k of every angle are a closed form";
    if (!options.overlayers.empty() || fit.estimator == "rho2") {
        return "below layers, and where Psi alone fits poorly, n and k may have several minima: "
               "metals and dielectrics of every sort are starts, too";
    }
    return "a closed form starts beside the minimum of every wavelength";
}

// What tells whether the search found the lowest: where the other starts end.
DecisionFigure ends_of(const FitResult& fit) {
    const auto searches =
        fit.dispersion.empty()
            ? std::count_if(fit.points.begin(), fit.points.end(),
                            [](const FittedPoint& point) {
                                return point.identifiable && point.starts.refined > 0;
                            })
            : 1;
    if (fit.starts.refined == 0) return {std::nullopt, "", "there is nothing to search for"};
    if (fit.starts.refined <= searches) {
        return {std::nullopt, "", "one start each: there is no other to compare with"};
    }
    return {static_cast<double>(fit.starts.refined - fit.starts.in_best),
            "starts that end above the lowest chi-square",
            "computed: " + starts_that_meet(fit.starts)};
}

ModelDecision search_decision(const FitOptions& options, const FitResult& fit) {
    ModelDecision decision;
    decision.name = "global search";
    decision.override_option = "--max-thickness NM";
    decision.cost = {static_cast<double>(fit.starts.refined), "starts refined",
                     "computed: those that converged"};
    if (fit.model != "film") {
        decision.choice = "none";
        decision.reason = why_these_starts(options, fit);
        decision.error = ends_of(fit);
        decision.override_option = "none";
        return decision;
    }
    decision.choice = fmt::format("thickness up to {:g} nm", options.film.largest_thickness_nm);
    decision.reason = "chi-square has a minimum for every fringe; their spectrum gives the starts";
    const std::string unit = "likelihood of the next best thickness over that of the best";
    if (fit.rival_thickness_nm > 0) {
        // Odds of the two minima for equal priors, of the noise that the residuals show where no
        // other is stated.
        const double noise = noise_variance(fit, options);
        decision.error = {
            std::exp(-0.5 * std::min(1400.0, fit.rival_chi2_excess / noise)), unit,
            fmt::format("computed: {:.6g} nm, chi-square {:.3g} more; {}", fit.rival_thickness_nm,
                        fit.rival_chi2_excess, starts_that_meet(fit.starts))};
    } else {
        decision.error = {
            0, unit, "computed: the search met no other minimum; " + starts_that_meet(fit.starts)};
    }
    return decision;
}

ModelDecision substrate_decision(const FitResult& fit,
                                 const std::vector<SubstrateAlternative>& substrates) {
    ModelDecision decision;
    decision.name = "substrate";
    decision.override_option = "--substrate MATERIAL";
    decision.cost = {0, parameters_unit, "a substrate is known, not fitted"};
    if (fit.model != "film") {
        decision.choice = "none";
        decision.reason = "what is fitted is the bottom";
        decision.error = {0, "nm of thickness", "there is no film"};
        return decision;
    }
    decision.choice = fit.substrate.name;
    decision.asked = true;
    decision.reason = "named; the thickness depends on it as the other sets of its material show";
    double largest = 0;
    for (const SubstrateAlternative& other : substrates) {
        const double shift = other.thickness.value - other.same_range.value;
        largest = std::max(largest, std::abs(shift));
        decision.alternatives.push_back(
            {fmt::format("{} ({:g} to {:g} nm)", other.name, other.first_nm, other.last_nm),
             {0, parameters_unit, "known"},
             {shift, "nm of thickness", "computed: both fitted over these wavelengths"}});
    }
    const double sigma = fit.common.empty() ? std::nan("") : fit.common.front().sigma;
    decision.error = {substrates.empty() ? std::optional<double>{} : largest, "nm of thickness",
                      substrates.empty()
                          ? "no other published set of this material covers the range"
                          : fmt::format("computed: the largest shift by another set; the data's "
                                        "own standard deviation is {:.2g} nm",
                                        sigma)};
    return decision;
}

}  // namespace

std::vector<ModelDecision> decisions(const Measurement& measurement, const FitOptions& options,
                                     const FitResult& fit,
                                     const std::vector<SubstrateAlternative>& substrates) {
    return {model_decision(measurement, options, fit),
            dispersion_decision(measurement, options, fit),
            angle_decision(measurement, options, fit),
            estimator_decision(measurement, options, fit),
            robust_decision(measurement, options, fit),
            substrate_decision(fit, substrates),
            search_decision(options, fit)};
}

}  // namespace drude
