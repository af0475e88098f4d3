#include "cli/fit_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/numbers.h"
#include "cli/decision_output.h"
#include "cli/fit_statistics_output.h"
#include "cli/json_output.h"

namespace drude {

namespace {

using nlohmann::ordered_json;

template <class Value>
ordered_json column(const FitResult& fit, Value FittedPoint::*member) {
    ordered_json values = ordered_json::array();
    for (const FittedPoint& point : fit.points) values.push_back(point.*member);
    return values;
}

ordered_json parameter(const FitResult& fit, const char* name) {
    size_t identified = 0;
    for (const FittedPoint& point : fit.points) identified += point.identifiable ? 1 : 0;
    return {{"name", name},
            {"per_wavelength", true},
            {"identifiable", identified == fit.points.size()},
            {"wavelengths", identified}};
}

bool every_wavelength_by_itself(const FitResult& fit) {
    return fit.substrate.wavelength_nm.empty() && fit.dispersion.empty();
}

ordered_json parameters(const FitResult& fit) {
    ordered_json list = ordered_json::array();
    for (const FittedParameter& p : fit.common) {
        list.push_back({{"name", p.name},
                        {"unit", p.unit},
                        {"per_wavelength", false},
                        {"identifiable", p.identifiable},
                        {"value", p.value},
                        {"sigma", p.sigma},
                        {"at_bound", p.at_bound}});
    }
    // The n and k of a film follow from its porosity, those of a formula from its parameters.
    if (every_wavelength_by_itself(fit)) {
        list.push_back(parameter(fit, "n"));
        list.push_back(parameter(fit, "k"));
    }
    return list;
}

ordered_json layers(const FitResult& fit) {
    ordered_json list = ordered_json::array();
    for (const FilmLayer& layer : fit.layers) {
        list.push_back({{"material", layer.constants.name}, {"thickness_nm", layer.thickness_nm}});
    }
    return list;
}

ordered_json common_error_list(const std::vector<CommonError>& errors) {
    ordered_json list = ordered_json::array();
    for (const CommonError& error : errors) {
        list.push_back({{"angle_deg", error.angle_deg},
                        {"sigma_psi_deg", error.sigma_psi_deg},
                        {"sigma_delta_deg", error.sigma_delta_deg}});
    }
    return list;
}

// Why neighbouring wavelengths deviate alike, and by how much.
void print_common_errors(const std::vector<CommonError>& errors) {
    if (errors.empty()) return;
    double psi = 0, delta = 0;
    for (const CommonError& error : errors) {
        psi = std::max(psi, error.sigma_psi_deg);
        delta = std::max(delta, error.sigma_delta_deg);
    }
    fmt::print(
        "weighed by the noise and by what the wavelengths of an angle share (sigma_common_deg: "
        "Psi up to {:.2g}, Delta up to {:.2g} degrees); n and k of neighbours deviate alike\n",
        psi, delta);
}

void print_table(const FitResult& fit) {
    fmt::print("{:>10}  {:>10} {:>9}  {:>10} {:>9}  {:>8}  {:>9}\n", "nm", "n", "+-", "k", "+-",
               "chi2/dof", "condition");
    for (const FittedPoint& point : fit.points) {
        if (!point.identifiable) {
            fmt::print("{:>10}  not determined\n", format_double(point.wavelength_nm));
            continue;
        }
        const int dof = every_wavelength_by_itself(fit) ? point.data - 2 : point.data;
        fmt::print("{:>10}  {:>10.5f} {:>9.5f}  {:>10.5f} {:>9.5f}  {:>8}  {:>9.3g}\n",
                   format_double(point.wavelength_nm), point.n, point.sigma_n, point.k,
                   point.sigma_k, dof > 0 ? fmt::format("{:.3f}", point.chi2 / dof) : "-",
                   point.condition);
    }
}

ordered_json ladder(const FitResult& fit) {
    ordered_json list = ordered_json::array();
    for (const LadderRung& rung : fit.ladder) {
        ordered_json one = {{"model", rung.model}, {"taken", rung.taken}};
        if (rung.data > 0) {
            one["data"] = rung.data;
            one["parameters"] = rung.parameters;
            one["chi2_reduced"] = rung.chi2_reduced;
            one["bic"] = rung.bic;
        }
        if (!rung.taken) one["objection"] = rung.objection;
        list.push_back(std::move(one));
    }
    return list;
}

std::string number_or_dash(double value, int digits) {
    return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "-";
}

void print_ladder(const FitResult& fit) {
    fmt::print("{:<26}{:>10}{:>12}{:>14}\n", "model", "parameters", "chi2/dof", "BIC");
    for (const LadderRung& rung : fit.ladder) {
        const std::string verdict = rung.taken ? "taken" : "not taken: " + rung.objection;
        if (rung.data > 0) {
            fmt::print("{:<26}{:>10}{:>12}{:>14}  {}\n", rung.model, rung.parameters,
                       number_or_dash(rung.chi2_reduced, 4), number_or_dash(rung.bic, 6), verdict);
        } else {
            fmt::print("{:<26}{:>36}  {}\n", rung.model, "", verdict);
        }
    }
}

void add_lobes(const LobeFitResult& result, ordered_json* document) {
    ordered_json list = ordered_json::array();
    for (const FittedLobe& lobe : result.lobes) {
        // What is at most an upper bound has no value.
        ordered_json one = {{"lobe", lobe_name(lobe.lobe)}, {"masking", "v-groove"}};
        if (lobe.narrower_than_aperture) {
            one["beta"] = nullptr;
            one["sigma_beta"] = nullptr;
            one["upper_bound"] = lobe.upper_bound;
        } else {
            one["beta"] = lobe.beta;
            one["sigma_beta"] = lobe.sigma_beta;
            one["upper_bound"] = nullptr;
        }
        one["chi2"] = lobe.chi2;
        one["tied"] = lobe.tied;
        one["at_bound"] = lobe.at_bound;
        list.push_back(std::move(one));
    }
    (*document)["lobes"] = std::move(list);
    (*document)["lobe_data"] = result.data;
    (*document)["lobe_dof"] = result.dof();
    (*document)["lobe_warnings"] = result.warnings;
}

}  // namespace

void print_fit_json(const FitReport& report, const Material& material, const std::string& output,
                    const LobeFitResult* lobes) {
    const FitResult& fit = report.fit;
    ordered_json document = {{"model", fit.model},
                             {"estimator", fit.estimator},
                             {"name", material.name},
                             {"measurement", material.provenance.measurement},
                             {"measurement_sha256", material.provenance.measurement_sha256},
                             {"angles_deg", report.measurement.angles()},
                             {"wavelengths_nm", column(fit, &FittedPoint::wavelength_nm)},
                             {"n", column(fit, &FittedPoint::n)},
                             {"k", column(fit, &FittedPoint::k)},
                             {"sigma_n", column(fit, &FittedPoint::sigma_n)},
                             {"sigma_k", column(fit, &FittedPoint::sigma_k)},
                             {"correlation", column(fit, &FittedPoint::correlation)},
                             {"identifiable", column(fit, &FittedPoint::identifiable)},
                             {"chi2", column(fit, &FittedPoint::chi2)},
                             {"data", column(fit, &FittedPoint::data)},
                             {"condition", column(fit, &FittedPoint::condition)},
                             {"spread_n", column(fit, &FittedPoint::spread_n)},
                             {"spread_k", column(fit, &FittedPoint::spread_k)},
                             {"chi2_total", fit.chi2},
                             {"dof", fit.dof()},
                             {"chi2_reduced", fit.chi2_reduced()},
                             {"parameters", parameters(fit)},
                             {"pseudo", fit.layers.empty()},
                             {"layers", layers(fit)},
                             {"warnings", fit.warnings}};
    if (fit.dof() > 0) document["chi2_scatter"] = chi2_scatter(fit, report.options);
    if (!report.common_errors.empty()) {
        document["common_errors"] = common_error_list(report.common_errors);
    }
    if (!fit.dispersion.empty()) document["dispersion"] = fit.dispersion;
    if (!fit.ladder.empty()) document["ladder"] = ladder(fit);
    if (!fit.substrate.wavelength_nm.empty()) document["substrate"] = fit.substrate.name;
    if (fit.rival_thickness_nm > 0) {
        document["rival"] = {{"thickness_nm", fit.rival_thickness_nm},
                             {"chi2_excess", fit.rival_chi2_excess}};
    }
    if (!report.decisions.empty()) document["decisions"] = decisions_json(report.decisions);
    add_statistics(report, &document);
    if (lobes) add_lobes(*lobes, &document);
    document["output"] = output.empty() ? ordered_json(nullptr) : ordered_json(output);
    print_json_document(document);
}

void print_fit_text(const FitReport& report, bool with_table) {
    const FitResult& fit = report.fit;
    const bool unweighted = report.options.unweighted;
    if (with_table) print_table(fit);
    if (!fit.ladder.empty()) print_ladder(fit);
    const bool film = !fit.substrate.wavelength_nm.empty();
    const auto determined = std::count_if(fit.points.begin(), fit.points.end(),
                                          [](const FittedPoint& p) { return p.identifiable; });
    fmt::print("{}: {} model, estimator {}: {} at {} of {} wavelengths, {:g} to {:g} nm\n",
               report.name, fit.model, fit.estimator, what_was_fitted(fit), determined,
               fit.points.size(), fit.points.front().wavelength_nm,
               fit.points.back().wavelength_nm);
    if (!fit.dispersion.empty()) fmt::print("n and k follow {}\n", fit.dispersion);
    for (const FittedParameter& p : fit.common) {
        if (!p.identifiable) {
            fmt::print("{} not determined\n", p.name);
            continue;
        }
        fmt::print("{} {:.6g} +- {:.2g}{}{}{}\n", p.name, p.value, p.sigma,
                   p.unit.empty() ? "" : " ", p.unit, p.at_bound ? " (at its bound)" : "");
    }
    if (film && fit.rival_thickness_nm > 0) {
        fmt::print("next best thickness {:.6g} nm, chi-square {:.3g} more\n",
                   fit.rival_thickness_nm, fit.rival_chi2_excess);
    }
    if (unweighted && fit.dof() > 0) {
        fmt::print("root mean square of the residuals {:.4f} degrees\n",
                   std::sqrt(fit.chi2 / fit.data));
    } else if (!fit.robust.empty() && fit.dof() > 0) {
        fmt::print("sum of {} losses over {} degrees of freedom {:.4f}; {} rows down-weighted\n",
                   fit.robust, fit.dof(), fit.chi2_reduced(), fit.rows_down_weighted);
    } else if (fit.dof() > 0) {
        fmt::print("reduced chi-square {:.4f} with {} degrees of freedom (1 +- {:.2g} expected)\n",
                   fit.chi2_reduced(), fit.dof(), chi2_scatter(fit, report.options));
    }
    print_common_errors(report.common_errors);
    print_statistics(report, with_table);
    print_decisions(report.decisions);
}

void print_lobe_json(const LobeFitResult& lobes, const Material& material,
                     const std::string& output) {
    ordered_json document = {{"model", "lobe"},
                             {"name", material.name},
                             {"measurement", material.provenance.measurement},
                             {"measurement_sha256", material.provenance.measurement_sha256}};
    add_lobes(lobes, &document);
    document["output"] = output.empty() ? ordered_json(nullptr) : ordered_json(output);
    print_json_document(document);
}

void print_lobe_text(const LobeFitResult& lobes) {
    fmt::print("{:<18}{:>10}  {:>9}  {:>12}\n", "lobe", "beta", "+-", "chi-square");
    for (const FittedLobe& lobe : lobes.lobes) {
        if (lobe.narrower_than_aperture) {
            fmt::print("{:<18}{:>10}  {:>9}  {:>12.2f}{}\n", lobe_name(lobe.lobe),
                       fmt::format("< {:.5f}", lobe.upper_bound), "", lobe.chi2,
                       lobe.tied ? "  tied" : "");
        } else {
            fmt::print("{:<18}{:>10.5f}  {:>9.2g}  {:>12.2f}{}\n", lobe_name(lobe.lobe), lobe.beta,
                       lobe.sigma_beta, lobe.chi2, lobe.tied ? "  tied" : "");
        }
    }
    fmt::print(
        "{} data, {} degrees of freedom; lobes within {:g} of the best chi-square are tied\n",
        lobes.data, lobes.dof(), lobe_tie);
}

}  // namespace drude
