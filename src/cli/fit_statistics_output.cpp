#include "cli/fit_statistics_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/numbers.h"
#include "fitter/robust_fit.h"

namespace drude {

namespace {

using nlohmann::ordered_json;

const char* chosen_by(LiteratureComparison::Choice choice) {
    switch (choice) {
        case LiteratureComparison::Choice::asked_for:
            return "option";
        case LiteratureComparison::Choice::sample_header:
            return "sample";
        case LiteratureComparison::Choice::nearest:
            break;
    }
    return "nearest";
}

ordered_json literature_json(const LiteratureComparison& literature) {
    ordered_json sets = ordered_json::array();
    for (const LiteratureSet& set : literature.sets) {
        sets.push_back({{"name", set.name},
                        {"kind", set.kind},
                        {"rms_dn", set.distance.rms_dn},
                        {"rms_dk", set.distance.rms_dk},
                        {"wavelengths", set.distance.wavelengths}});
    }
    const LiteratureEnvelope& envelope = literature.envelope;
    ordered_json document;
    document["material"] =
        literature.material.empty() ? ordered_json(nullptr) : ordered_json(literature.material);
    document["chosen_by"] = chosen_by(literature.choice);
    document["nearest"] =
        literature.sets.empty() ? ordered_json(nullptr) : ordered_json(literature.nearest());
    document["sets"] = std::move(sets);
    document["envelope"] = {{"wavelengths_nm", envelope.wavelength_nm},
                            {"n_low", envelope.n_low},
                            {"n_high", envelope.n_high},
                            {"k_low", envelope.k_low},
                            {"k_high", envelope.k_high},
                            {"sets", envelope.sets}};
    return document;
}

ordered_json scatter_json(const Scatter& scatter) {
    return {{"draws", scatter.draws},
            {"mean", scatter.mean},
            {"sigma", scatter.sigma},
            {"quantiles", scatter.quantiles}};
}

ordered_json bootstrap_json(const FitReport& report) {
    const BootstrapResult& result = *report.bootstrap;
    ordered_json parameters = ordered_json::array(), points = ordered_json::array();
    for (size_t i = 0; i < result.common.size(); ++i) {
        ordered_json one = {{"name", report.fit.common[i].name},
                            {"unit", report.fit.common[i].unit}};
        one.update(scatter_json(result.common[i]));
        parameters.push_back(std::move(one));
    }
    for (const BootstrapPoint& point : result.points) {
        points.push_back({{"wavelength_nm", point.wavelength_nm},
                          {"n", scatter_json(point.n)},
                          {"k", scatter_json(point.k)}});
    }
    return {{"draws", result.draws},
            {"failures", result.failures},
            {"seed", result.seed},
            {"quantiles", bootstrap_quantiles},
            {"parameters", std::move(parameters)},
            {"points", std::move(points)}};
}

ordered_json profile_json(const ProfileResult& result) {
    ordered_json parameters = ordered_json::array();
    for (const ProfiledParameter& p : result.parameters) {
        ordered_json intervals = ordered_json::array();
        for (size_t i = 0; i < profile_rises.size(); ++i) {
            intervals.push_back({{"rise", profile_rises[i]},
                                 {"lower", p.intervals[i].lower},
                                 {"upper", p.intervals[i].upper},
                                 {"lower_open", std::isnan(p.intervals[i].lower)},
                                 {"upper_open", std::isnan(p.intervals[i].upper)}});
        }
        ordered_json one = {{"name", p.name}, {"unit", p.unit}};
        one["wavelength_nm"] =
            p.wavelength_nm > 0 ? ordered_json(p.wavelength_nm) : ordered_json(nullptr);
        one["value"] = p.value;
        one["sigma"] = p.sigma;
        one["intervals"] = std::move(intervals);
        parameters.push_back(std::move(one));
    }
    return parameters;
}

void print_literature(const LiteratureComparison& literature) {
    if (literature.sets.empty()) {
        if (!literature.material.empty()) {
            fmt::print("no published set of {} covers the fitted wavelengths\n",
                       literature.material);
        }
        return;
    }
    switch (literature.choice) {
        case LiteratureComparison::Choice::asked_for:
            fmt::print("published sets of {}, nearest first\n", literature.material);
            break;
        case LiteratureComparison::Choice::sample_header:
            fmt::print("published sets of {}, which the sample is called, nearest first\n",
                       literature.material);
            break;
        case LiteratureComparison::Choice::nearest:
            fmt::print("nearest published: {} (arithmetic, no identification of the sample)\n",
                       literature.nearest());
            break;
    }
    for (const LiteratureSet& set : literature.sets) {
        fmt::print("  {:<24}rms dn {:.4f}  rms dk {:.4f}{}\n", set.name, set.distance.rms_dn,
                   set.distance.rms_dk,
                   set.distance.wavelengths == literature.wavelengths
                       ? ""
                       : fmt::format("  at {} of {} wavelengths", set.distance.wavelengths,
                                     literature.wavelengths));
    }
}

// Middle value of the ratios of the draws' sigmas to the fit's.
double median_ratio(const BootstrapResult& result, const FitResult& fit,
                    Scatter BootstrapPoint::*of, double FittedPoint::*sigma) {
    std::vector<double> ratios;
    size_t i = 0;
    for (const FittedPoint& point : fit.points) {
        if (!point.identifiable || i == result.points.size()) continue;
        const double ratio = (result.points[i++].*of).sigma / (point.*sigma);
        if (std::isfinite(ratio)) ratios.push_back(ratio);
    }
    if (ratios.empty()) return std::nan("");
    std::sort(ratios.begin(), ratios.end());
    return ratios[ratios.size() / 2];
}

void print_bootstrap(const FitReport& report, bool every_wavelength) {
    const BootstrapResult& result = *report.bootstrap;
    fmt::print("bootstrap: {} draws with seed {}, {} refused\n", result.draws, result.seed,
               result.failures);
    if (!every_wavelength && !result.points.empty()) {
        const double n =
            median_ratio(result, report.fit, &BootstrapPoint::n, &FittedPoint::sigma_n);
        const double k =
            median_ratio(result, report.fit, &BootstrapPoint::k, &FittedPoint::sigma_k);
        if (std::isfinite(n) && std::isfinite(k)) {
            fmt::print(
                "  scatter over standard deviation of the fit, median over wavelengths: n "
                "{:.3f}, k {:.3f}\n",
                n, k);
        }
        if (result.common.empty()) return;
    }
    fmt::print("  {:<18}{:>10}{:>12}{:>12}{:>12}{:>12}{:>12}\n", "", "nm", "+-", "2.5 %", "16 %",
               "84 %", "97.5 %");
    const auto line = [](const std::string& name, const std::string& nm, const Scatter& s) {
        fmt::print("  {:<18}{:>10}{:>12.3g}{:>12.6g}{:>12.6g}{:>12.6g}{:>12.6g}\n", name, nm,
                   s.sigma, s.quantiles[0], s.quantiles[1], s.quantiles[2], s.quantiles[3]);
    };
    for (size_t i = 0; i < result.common.size(); ++i) {
        line(report.fit.common[i].name, "", result.common[i]);
    }
    if (!every_wavelength) return;
    for (const BootstrapPoint& point : result.points) {
        const std::string nm = format_double(point.wavelength_nm);
        line("n", nm, point.n);
        line("k", nm, point.k);
    }
}

// Of hundreds of wavelengths only where the table of them is asked for.
void print_profile(const ProfileResult& result, bool every_wavelength) {
    constexpr size_t few = 24;
    const bool all = every_wavelength || result.parameters.size() <= few;
    fmt::print("profile likelihood: where chi-square rises by 1 and by 3.84\n");
    const bool rows =
        all || std::any_of(result.parameters.begin(), result.parameters.end(),
                           [](const ProfiledParameter& p) { return p.wavelength_nm == 0; });
    if (rows) {
        fmt::print("  {:<18}{:>10}{:>12}{:>12}{:>12}{:>12}{:>12}\n", "", "nm", "value", "-3.84",
                   "-1", "+1", "+3.84");
    }
    const auto end = [](double value) {
        return std::isnan(value) ? std::string("open") : fmt::format("{:.6g}", value);
    };
    size_t open = 0, left_out = 0;
    for (const ProfiledParameter& p : result.parameters) {
        if (!all && p.wavelength_nm > 0) {
            ++left_out;
            for (const ProfileInterval& i : p.intervals) {
                open += std::isnan(i.lower) || std::isnan(i.upper) ? 1 : 0;
            }
            continue;
        }
        fmt::print("  {:<18}{:>10}{:>12.6g}{:>12}{:>12}{:>12}{:>12}\n", p.name,
                   p.wavelength_nm > 0 ? format_double(p.wavelength_nm) : "", p.value,
                   end(p.intervals[1].lower), end(p.intervals[0].lower), end(p.intervals[0].upper),
                   end(p.intervals[1].upper));
    }
    if (left_out > 0) {
        fmt::print("  n and k: {} profiles, {} intervals open on a side (--json, --html)\n",
                   left_out, open);
    }
}

ordered_json substrates_json(const FitReport& report) {
    ordered_json list = ordered_json::array();
    for (const SubstrateAlternative& other : report.substrates) {
        list.push_back({{"name", other.name},
                        {"first_nm", other.first_nm},
                        {"last_nm", other.last_nm},
                        {"thickness_nm", other.thickness.value},
                        {"sigma_nm", other.thickness.sigma},
                        {"same_range_nm", other.same_range.value}});
    }
    return list;
}

void print_substrates(const FitReport& report) {
    for (const SubstrateAlternative& other : report.substrates) {
        fmt::print("on {} instead, {:g} to {:g} nm: thickness {:.6g} +- {:.2g} nm ({:.6g} on {})\n",
                   other.name, other.first_nm, other.last_nm, other.thickness.value,
                   other.thickness.sigma, other.same_range.value, report.fit.substrate.name);
    }
}

}  // namespace

void add_statistics(const FitReport& report, ordered_json* document) {
    if (!report.fit.robust.empty()) {
        (*document)["robust"] = {{"loss", report.fit.robust},
                                 {"constant", robust_constant(report.fit.robust)},
                                 {"rows_down_weighted", report.fit.rows_down_weighted}};
    }
    (*document)["literature"] =
        report.literature ? literature_json(*report.literature) : ordered_json(nullptr);
    if (report.fit.model == "film") (*document)["other_substrates"] = substrates_json(report);
    if (report.bootstrap) (*document)["bootstrap"] = bootstrap_json(report);
    if (report.profile) (*document)["profile"] = profile_json(*report.profile);
}

void print_statistics(const FitReport& report, bool every_wavelength) {
    if (report.literature) print_literature(*report.literature);
    print_substrates(report);
    if (report.profile) print_profile(*report.profile, every_wavelength);
    if (report.bootstrap) print_bootstrap(report, every_wavelength);
}

}  // namespace drude
