#include "bench/charts/fit_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/progress.h"
#include "bench/charts/experiment.h"
#include "bench/charts/five_metals.h"

namespace drude {

const std::vector<FitProcedure>& fit_procedures() {
    static const std::vector<FitProcedure> all = {
        {"Psi and Delta, point by point", "psi-delta", ""},
        {"Psi and Delta, dispersion", "psi-delta", "drude+2cp"},
        {"Psi alone, point by point", "rho2", ""},
        {"Psi alone, dispersion", "rho2", "drude+2cp"}};
    return all;
}

namespace {

std::vector<FitRuns> make_settings(bool quick) {
    std::vector<FitRuns> all;
    for (const FitProcedure& procedure : fit_procedures()) {
        if (quick && !procedure.dispersion.empty()) continue;
        FitSetting base;
        base.estimator = procedure.estimator;
        base.dispersion = procedure.dispersion;
        const auto add = [&](const std::string& varied, const FitSetting& setting) {
            all.push_back({setting, varied, {}});
        };
        add("", base);
        for (const std::vector<double>& angles :
             {std::vector<double>{70}, {60, 75}, {45, 50, 60, 70, 75, 80}}) {
            FitSetting setting = base;
            setting.angles_deg = angles;
            add("angles", setting);
        }
        for (const int count : {5, 11, 21, 81}) {
            FitSetting setting = base;
            setting.wavelengths = count;
            add("wavelengths", setting);
        }
        for (const double noise : {0.1, 10.0, 100.0}) {
            FitSetting setting = base;
            setting.noise = noise;
            add("noise", setting);
        }
    }
    return all;
}

void run_all(std::vector<FitRuns>* all, int seeds, bool quiet) {
    std::vector<Method> methods;
    for (FitRuns& fitted : *all) {
        fitted.outcomes.resize(static_cast<size_t>(seeds));
        methods.push_back({"", {{"", [&fitted](uint64_t seed) {
                                     auto& outcomes = fitted.outcomes[seed - 1];
                                     for (const NamedMetal& metal : five_metals()) {
                                         outcomes.push_back(fit_outcome(published_set(metal.set),
                                                                        fitted.setting, seed));
                                     }
                                     return Measured{1, 0};
                                 }}}});
    }
    Progress progress("fits", all->size() * static_cast<size_t>(seeds), quiet);
    run_shuffled(methods, seeds, 1, [&] { progress.step(); });
}

// Names of the metals that some seed had no answer for.
std::string refused(const FitRuns& fitted) {
    std::string names;
    for (size_t m = 0; m < five_metals().size(); ++m) {
        for (const auto& outcomes : fitted.outcomes) {
            if (outcomes[m].refused.empty()) continue;
            names += (names.empty() ? "" : ", ") + five_metals()[m].name;
            break;
        }
    }
    return names;
}

double cost_of(const FitSetting& setting, const std::string& varied) {
    return varied == "noise" ? setting.sigma_psi_deg() : setting.data();
}

}  // namespace

std::vector<FitRuns> run_fits(bool quick, int seeds, bool quiet) {
    std::vector<FitRuns> all = make_settings(quick);
    run_all(&all, seeds, quiet);
    return all;
}

double fit_constants_error(const FitOutcome& outcome) {
    return outcome.constants_error;
}
FitFigure fit_delta_e(size_t scene) {
    return [scene](const FitOutcome& outcome) { return outcome.pictures[scene].mean_delta_e; };
}

ChartPoint fit_point_of(const FitRuns& fitted, const FitFigure& figure) {
    ChartPoint point;
    const auto seeds = static_cast<double>(fitted.outcomes.size());
    std::vector<double> means, seconds;
    double left_out = 0;
    for (const auto& outcomes : fitted.outcomes) {
        double sum = 0, time = 0;
        for (const FitOutcome& outcome : outcomes) {
            sum += figure(outcome) / static_cast<double>(outcomes.size());
            time += outcome.seconds / static_cast<double>(outcomes.size());
            left_out += outcome.refused_share / (static_cast<double>(outcomes.size()) * seeds);
        }
        means.push_back(sum);
        seconds.push_back(time);
        point.error += sum / seeds;
    }
    double squares = 0;
    for (const double mean : means) squares += (mean - point.error) * (mean - point.error);
    if (means.size() > 1) point.error_sigma = std::sqrt(squares / (seeds * (seeds - 1)));
    point.note = fmt::format("{:.3g} ms a fit", 1000 * median(seconds));
    point.cost = median(seconds);
    if (left_out > 0) {
        point.note += fmt::format("; {:.2g} % of the wavelengths refused", 100 * left_out);
    }
    const std::string without = refused(fitted);
    if (!without.empty()) {
        point.error = std::numeric_limits<double>::quiet_NaN();
        point.error_sigma = 0;
        point.note = "refused: " + without;
    }
    return point;
}

std::string fit_setting_name(const FitSetting& setting, const std::string& varied) {
    if (varied == "angles") {
        return setting.angles_deg.size() == 1 ? "1 angle"
                                              : fmt::format("{} angles", setting.angles_deg.size());
    }
    if (varied == "wavelengths") return fmt::format("{} wavelengths", setting.wavelengths);
    return fmt::format("{:g} deg of Psi", setting.sigma_psi_deg());
}

std::vector<ChartCurve> fit_curves(const std::vector<FitRuns>& all, const std::string& varied,
                                   const FitFigure& figure) {
    std::vector<ChartCurve> curves;
    for (const FitProcedure& procedure : fit_procedures()) {
        ChartCurve curve{procedure.name, {}};
        for (const FitRuns& fitted : all) {
            if (!procedure.is_of(fitted.setting)) continue;
            if (!fitted.varied.empty() && fitted.varied != varied) continue;
            ChartPoint point = fit_point_of(fitted, figure);
            point.setting = fit_setting_name(fitted.setting, varied);
            point.cost = cost_of(fitted.setting, varied);
            point.automatic = procedure.estimator == "psi-delta" && procedure.dispersion.empty() &&
                              fitted.setting.angles_deg.size() == 6 && varied == "angles";
            curve.points.push_back(std::move(point));
        }
        std::sort(curve.points.begin(), curve.points.end(),
                  [](const ChartPoint& a, const ChartPoint& b) { return a.cost < b.cost; });
        if (!curve.points.empty()) curves.push_back(std::move(curve));
    }
    return curves;
}

}  // namespace drude
