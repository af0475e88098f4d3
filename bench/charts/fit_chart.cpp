// Chart 6: how good a measurement has to be for a given scene.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/charts/bench_items.h"
#include "bench/charts/experiment.h"
#include "bench/charts/fit_runs.h"
#include "bench/charts/five_metals.h"

namespace drude {

namespace {

std::string caption(const std::string& varied, int seeds) {
    const std::string rest =
        varied == "angles" ? "41 wavelengths from 380 to 780 nm, noise of 0.05 and 0.1 degrees"
        : varied == "wavelengths"
            ? "65, 70 and 75 degrees, noise of 0.05 and 0.1 degrees"
            : "65, 70 and 75 degrees, 41 wavelengths from 380 to 780 nm, noise "
              "of Delta twice that of Psi";
    return fmt::format(
        "Simulated measurements of copper, silver, gold, aluminium and zinc: {}; mean over the "
        "metals and {} seeds of the noise. Dispersion: free electrons and two critical points. A "
        "point is missing where one of the metals is refused.",
        rest, seeds);
}

const char* cost_label(const std::string& varied) {
    return varied == "noise" ? "noise of Psi (degrees)" : "measured numbers";
}

// "... up to 0.3 degrees": where a curve passes 1, on straight lines in logarithms.
std::string below_one(const ChartCurve& curve) {
    double last = 0;
    for (size_t i = 0; i < curve.points.size(); ++i) {
        const ChartPoint& b = curve.points[i];
        if (!(b.error < 1)) {
            if (i == 0) return "never";
            const ChartPoint& a = curve.points[i - 1];
            if (!std::isfinite(b.error) || !(a.error > 0)) {
                return fmt::format("up to {:.2g} degrees of Psi, the largest noise with an answer",
                                   last);
            }
            const double t = std::log(1 / a.error) / std::log(b.error / a.error);
            return fmt::format("up to {:.2g} degrees of Psi",
                               a.cost * std::pow(b.cost / a.cost, t));
        }
        last = b.cost;
    }
    return fmt::format("up to {:.2g} degrees of Psi and beyond", last);
}

Chart constants_chart(const std::vector<FitRuns>& all, const std::string& varied, int seeds) {
    Chart chart;
    chart.id = "fit-" + varied + "-constants";
    chart.title = varied == "noise" ? "Fit: error of n and k against the noise"
                                    : "Fit: error of n and k against the number of " + varied;
    chart.cost = cost_label(varied);
    chart.is_cost = varied != "noise";
    chart.error = "relative error of n + ik (rms)";
    chart.caption = caption(varied, seeds);
    chart.curves = fit_curves(all, varied, fit_constants_error);
    for (const ChartCurve& curve : chart.curves) {
        const ChartPoint &first = curve.points.front(), &last = curve.points.back();
        const auto text = [](const ChartPoint& p) {
            return std::isfinite(p.error) ? fmt::format("{:.2g} ({})", p.error, p.setting)
                                          : fmt::format("{} ({})", p.note, p.setting);
        };
        chart.findings.push_back(
            fmt::format("{}: from {} to {}.", curve.method, text(first), text(last)));
    }
    return chart;
}

Chart picture_chart(const std::vector<FitRuns>& all, const std::string& varied, size_t scene,
                    int seeds) {
    Chart chart;
    const std::string name = fit_scene_name(fit_scenes[scene]);
    std::string id = name;
    std::replace(id.begin(), id.end(), ' ', '-');
    chart.id = "fit-" + varied + "-" + id;
    chart.title = fmt::format("Fit: picture of a sphere ({}) against the {}", name,
                              varied == "noise" ? "noise" : "number of " + varied);
    chart.cost = cost_label(varied);
    chart.is_cost = varied != "noise";
    chart.error = "mean colour error (CIEDE2000)";
    chart.caption = caption(varied, seeds) +
                    " The picture is integrated exactly, its brightest ring is white, and 1 is "
                    "about a just noticeable difference.";
    if (fit_scenes[scene] == FitScene::bounces) {
        chart.caption += " Five reflections at one angle: (Rs^5 + Rp^5)/2.";
    } else if (fit_scenes[scene] == FitScene::crossed) {
        chart.caption += " Between crossed polarisers, where Delta counts: (A + C)/2.";
    }
    chart.curves = fit_curves(all, varied, fit_delta_e(scene));
    for (const ChartCurve& curve : chart.curves) {
        if (varied == "noise") {
            chart.findings.push_back(fmt::format("{}: not to be seen (mean below 1) {}.",
                                                 curve.method, below_one(curve)));
            continue;
        }
        const ChartPoint* least = nullptr;
        for (const ChartPoint& p : curve.points) {
            if (p.error < 1 && !least) least = &p;
        }
        chart.findings.push_back(
            least ? fmt::format("{}: mean error below 1 from {} on ({:.2g}).", curve.method,
                                least->setting, least->error)
                  : fmt::format("{}: no setting has a mean error below 1.", curve.method));
    }
    return chart;
}

Chart time_chart(const std::vector<FitRuns>& all, int seeds) {
    Chart chart;
    chart.id = "fit-time";
    chart.title = "Fit: processor time against the error of n and k";
    chart.cost = "processor time of a fit (s)";
    chart.error = "relative error of n + ik (rms)";
    chart.caption = caption("wavelengths", seeds) +
                    " One curve a procedure, its points the numbers of wavelengths; medians of the "
                    "time of a fit with its standard deviations, on one thread.";
    for (const FitProcedure& procedure : fit_procedures()) {
        ChartCurve curve{procedure.name, {}};
        for (const FitRuns& fitted : all) {
            if (!procedure.is_of(fitted.setting)) continue;
            if (!fitted.varied.empty() && fitted.varied != "wavelengths") continue;
            ChartPoint point = fit_point_of(fitted, fit_constants_error);
            point.setting = fit_setting_name(fitted.setting, "wavelengths");
            point.automatic = procedure.estimator == "psi-delta" && procedure.dispersion.empty();
            curve.points.push_back(std::move(point));
        }
        std::sort(curve.points.begin(), curve.points.end(),
                  [](const ChartPoint& a, const ChartPoint& b) { return a.cost < b.cost; });
        if (curve.points.empty()) continue;
        const ChartPoint& last = curve.points.back();
        chart.findings.push_back(fmt::format("{}: {:.3g} ms for {}, error {:.2g}.", curve.method,
                                             1000 * last.cost, last.setting, last.error));
        chart.curves.push_back(std::move(curve));
    }
    return chart;
}

// Psi and Delta point by point: what each noise does to each metal in each scene.
BenchTable scene_table(const std::vector<FitRuns>& all) {
    BenchTable table;
    table.id = "fit-scenes";
    table.caption =
        "How good a measurement has to be: Psi and Delta at 65, 70 and 75 degrees and 41 "
        "wavelengths, fitted point by point. Mean colour error (CIEDE2000), and log10 of the mean "
        "absolute difference of linear R, G, B, of the sphere's picture in each scene.";
    table.columns = {"noise of Psi (deg)", "metal", "error of n + ik"};
    for (const FitScene scene : fit_scenes) {
        table.columns.push_back(fmt::format("{}: Delta E", fit_scene_name(scene)));
        table.columns.push_back(fmt::format("{}: log10", fit_scene_name(scene)));
    }
    std::vector<const FitRuns*> rows;
    for (const FitRuns& fitted : all) {
        if (!fit_procedures()[0].is_of(fitted.setting)) continue;
        if (fitted.varied.empty() || fitted.varied == "noise") rows.push_back(&fitted);
    }
    std::sort(rows.begin(), rows.end(), [](const FitRuns* a, const FitRuns* b) {
        return a->setting.noise < b->setting.noise;
    });
    for (const FitRuns* fitted : rows) {
        for (size_t m = 0; m < five_metals().size(); ++m) {
            std::vector<std::string> row = {fmt::format("{:g}", fitted->setting.sigma_psi_deg()),
                                            five_metals()[m].name};
            const auto mean = [&](const FitFigure& figure) {
                double sum = 0;
                for (const auto& outcomes : fitted->outcomes) {
                    if (!outcomes[m].refused.empty()) return std::string("refused");
                    sum += figure(outcomes[m]) / static_cast<double>(fitted->outcomes.size());
                }
                return fmt::format("{:.2g}", sum);
            };
            row.push_back(mean(fit_constants_error));
            for (size_t s = 0; s < fit_scenes.size(); ++s) {
                row.push_back(mean(fit_delta_e(s)));
                row.push_back(
                    mean([s](const FitOutcome& o) { return o.pictures[s].log10_difference; }));
            }
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

BenchResult run(const BenchOptions& options) {
    const int seeds = options.seeds > 0 ? options.seeds : options.quick ? 2 : 3;
    const std::vector<FitRuns> all = run_fits(options.quick, seeds, options.quiet);
    BenchResult result;
    for (const std::string varied : {"angles", "wavelengths", "noise"}) {
        result.charts.push_back(constants_chart(all, varied, seeds));
        result.charts.push_back(picture_chart(all, varied, 0, seeds));
    }
    for (const size_t scene : {size_t{1}, size_t{2}}) {
        result.charts.push_back(picture_chart(all, "noise", scene, seeds));
    }
    result.charts.push_back(time_chart(all, seeds));
    result.tables.push_back(scene_table(all));
    return result;
}

}  // namespace

BenchItem fit_item() {
    return {"fit", "Fit: how good a measurement has to be",
            "estimators, angles, wavelengths, models and noise: error of n, k and of pictures",
            run};
}

}  // namespace drude
