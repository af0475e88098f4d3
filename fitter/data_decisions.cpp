#include "fitter/data_decisions.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "fitter/angle_choice.h"
#include "fitter/model_curve.h"
#include "fitter/robust_choice.h"

namespace drude {

namespace {

std::string list_of(const std::vector<double>& angles) {
    return fmt::format("{:g}", fmt::join(angles, ", "));
}

DecisionFigure rows_of(size_t angles) {
    return {static_cast<double>(angles), "rows a wavelength", "computed"};
}

DecisionFigure sigma_figure(double sigma, bool film, const std::string& basis) {
    if (!std::isfinite(sigma)) {
        return {std::nullopt, "", film ? "no fit converges" : "n and k are not determined"};
    }
    return {sigma,
            film ? "nm, standard deviation of the thickness" : "standard deviation of n + ik",
            basis};
}

// What the fit that was made states of itself.
DecisionFigure own_sigma(const FitResult& fit) {
    const bool film = fit.model == "film";
    return sigma_figure(
        sigma_of_fit(fit), film,
        film ? "computed: the fit's own" : "computed: the fit's own, median over the wavelengths");
}

// A formula, or an offset that all wavelengths share, has other standard deviations than what
// follows from every wavelength by itself.
bool shares_parameters(const FitResult& fit) {
    return fit.model != "film" && !fit.common.empty();
}

// Of the information that angles hold, with what it is to be compared.
DecisionFigure information_figure(double sigma, double sigma_of_all, const FitResult& fit) {
    DecisionFigure figure = sigma_figure(
        sigma, false, "computed: information at the fitted n and k, median over the wavelengths");
    if (figure.value && shares_parameters(fit)) {
        figure.unit += fmt::format(" point by point, where all have {:.3g}", sigma_of_all);
    }
    return figure;
}

}  // namespace

ModelDecision angle_decision(const Measurement& measurement, const FitOptions& options,
                             const FitResult& fit) {
    const AngleChoice chosen = angle_choice(measurement, options, fit);
    const bool film = fit.model == "film";
    const size_t count = chosen.all.angles_deg.size(), needed = chosen.needed.angles_deg.size();
    ModelDecision decision;
    decision.name = "angles";
    decision.choice = fmt::format("all {}: {} degrees", count, list_of(chosen.all.angles_deg));
    const std::string what =
        shares_parameters(fit) ? "standard deviation point by point" : "standard deviation";
    if (needed < count) {
        decision.reason = fmt::format(
            "a measured angle costs nothing more; {} ({} degrees) would do with {:g} times the {} "
            "at most",
            needed, list_of(chosen.needed.angles_deg), enough_sigma, what);
    } else if (count == 1) {
        decision.reason = "there is no other";
    } else {
        decision.reason =
            fmt::format("with fewer the {} is more than {:g} times as large", what, enough_sigma);
    }
    decision.cost = rows_of(count);
    decision.error = own_sigma(fit);
    const auto figure = [&](const AngleSet& set) {
        return film ? sigma_figure(set.sigma, true, "computed: a fit of these angles alone")
                    : information_figure(set.sigma, chosen.all.sigma, fit);
    };
    for (const AngleSet& set : chosen.best) {
        if (set.angles_deg.size() == count) continue;
        decision.alternatives.push_back(
            {fmt::format("the best {}: {}", set.angles_deg.size(), list_of(set.angles_deg)),
             rows_of(set.angles_deg.size()), figure(set)});
    }
    if (film && needed + 1 < count) {
        decision.alternatives.push_back({fmt::format("{} alone", list_of(chosen.needed.angles_deg)),
                                         rows_of(needed), figure(chosen.needed)});
    }
    for (size_t a = 0; a < chosen.without.size(); ++a) {
        decision.alternatives.push_back({fmt::format("without {:g}", chosen.all.angles_deg[a]),
                                         rows_of(count - 1), figure(chosen.without[a])});
    }
    decision.override_option = "--angles LIST";
    return decision;
}

ModelDecision estimator_decision(const Measurement& measurement, const FitOptions& options,
                                 const FitResult& fit) {
    ModelDecision decision;
    decision.name = "estimator";
    decision.choice = fit.estimator;
    decision.asked = options.estimator != "psi-delta";
    decision.reason = decision.asked ? "asked for"
                                     : "Delta is measured with Psi, and with it every angle by "
                                       "itself determines n and k";
    decision.override_option = "--estimator psi-delta|rho2|inversion";
    const auto residuals = [](bool both) -> DecisionFigure {
        return {both ? 2.0 : 1.0, "data a row", "computed"};
    };
    decision.cost = residuals(fit.estimator != "rho2");
    decision.error = own_sigma(fit);
    if (fit.model == "film") return decision;
    const double sigma = sigma_of_all_angles(measurement, options, fit);
    for (const std::string other : {"psi-delta", "rho2"}) {
        if (other == fit.estimator) continue;
        // The information of the other estimator at the n and k of this one.
        FitResult as_other = fit;
        as_other.estimator = other;
        decision.alternatives.push_back(
            {other, residuals(other != "rho2"),
             information_figure(sigma_of_all_angles(measurement, options, as_other), sigma, fit)});
    }
    return decision;
}

ModelDecision robust_decision(const Measurement& measurement, const FitOptions& options,
                              const FitResult& fit) {
    ModelDecision decision;
    decision.name = "robust";
    decision.choice = fit.robust.empty() ? "none" : fit.robust;
    decision.asked = options.robust != "none" && options.robust != "auto";
    decision.override_option = "--robust none|huber|cauchy|tukey|auto";
    if (!fit.robust.empty()) {
        decision.reason = decision.asked ? "asked for" : "rows are far from the model";
        decision.cost = {1 / 0.93, "times the variance on clean data", "theory: robust_fit.h"};
        decision.error = {static_cast<double>(fit.rows_down_weighted),
                          "rows that count for less than half", "computed"};
        return decision;
    }
    const RobustChoice chosen = robust_choice(fit, measurement, options);
    decision.reason = chosen.loss == "none"
                          ? chosen.reason
                          : fmt::format("not asked for; --robust auto would take {}: {}",
                                        chosen.loss, chosen.reason);
    decision.cost = {1, "times the variance on clean data", "theory: least squares"};
    decision.error = {static_cast<double>(chosen.far),
                      fmt::format("rows far from the model, of {}", chosen.rows),
                      fmt::format("computed; Gaussian errors bring {:.2g}", chosen.expected_far)};
    decision.alternatives.push_back(
        {"tukey",
         {1 / 0.93, "times the variance on clean data", "theory: robust_fit.h"},
         {0, "rows far from the model that count", "theory: their weight is 0"}});
    return decision;
}

}  // namespace drude
