// Chart 7: seconds of measuring against the error of Psi and Delta.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/progress.h"
#include "bench/charts/bench_items.h"
#include "bench/charts/capture_experiment.h"
#include "bench/charts/experiment.h"
#include "bench/charts/five_metals.h"
#include "device/virtual/virtual_bench.h"

namespace drude {

namespace {

struct NamedRecipe {
    std::string curve, setting;
    Recipe recipe;
    bool automatic = false;
};

// Angles of incidence follow each other, so one stands for all. Between two recipes of a curve one
// number differs.
std::vector<NamedRecipe> recipes(bool quick) {
    std::vector<NamedRecipe> all;
    const auto add = [&](const std::string& curve, const std::string& setting,
                         const std::function<void(Recipe*)>& change) {
        Recipe recipe;
        recipe.angles_deg = {70};
        const std::string usual = format_recipe(recipe);
        change(&recipe);
        all.push_back({curve, setting, recipe, format_recipe(recipe) == usual});
    };
    const std::vector<int> averages =
        quick ? std::vector<int>{1, 4, 16} : std::vector<int>{1, 2, 4, 8, 16, 32};
    const std::vector<int> steps =
        quick ? std::vector<int>{9, 24, 96} : std::vector<int>{7, 9, 12, 24, 48, 96, 192};
    for (const int n : averages) {
        add("averages: 24 steps, 2 cycles, 2 zones", fmt::format("{} frames a step", n),
            [n](Recipe* r) { r->averages = n; });
    }
    for (const int n : steps) {
        add("steps: 4 frames, 2 cycles, 2 zones", fmt::format("{} steps", n),
            [n](Recipe* r) { r->steps = n; });
    }
    for (const int n : averages) {
        add("averages: 24 steps, 1 cycle, 2 zones", fmt::format("{} frames a step", n),
            [n](Recipe* r) { r->averages = n, r->cycles = 1; });
    }
    for (const int n : averages) {
        add("averages: 24 steps, 2 cycles, 1 zone", fmt::format("{} frames a step", n),
            [n](Recipe* r) { r->averages = n, r->zones_deg = {45}; });
    }
    for (const int n : steps) {
        add("steps: 1 frame, 1 cycle, 1 zone", fmt::format("{} steps", n),
            [n](Recipe* r) { r->steps = n, r->averages = 1, r->cycles = 1, r->zones_deg = {45}; });
    }
    const std::vector<int> darks =
        quick ? std::vector<int>{16, 256} : std::vector<int>{4, 16, 64, 256};
    for (const int n : darks) {
        add("dark frames: 24 steps, 4 frames, 2 cycles, 2 zones", fmt::format("{} dark frames", n),
            [n](Recipe* r) { r->dark_frames = n; });
    }
    return all;
}

struct BenchKind {
    std::string id, name, caption;
    VirtualBenchSettings (*settings)(uint64_t seed);
};

const std::vector<BenchKind>& benches() {
    static const std::vector<BenchKind> all = {
        {"noise", "noise alone", "Photon noise, read noise and dark; everything else is exact",
         noise_only_bench_settings},
        {"ordinary", "ordinary parts",
         "A bench of ordinary parts: noise, drift, offsets, eccentric mounts that miss by 0.05 "
         "degrees, polarisers that leak; its calibration is exact",
         ordinary_bench_settings}};
    return all;
}

// By recipe and seed: the metals together.
using Outcomes = std::vector<std::vector<CaptureOutcome>>;

Outcomes run_all(const std::vector<NamedRecipe>& named, const BenchKind& bench, int seeds,
                 size_t metals, bool quiet) {
    Outcomes outcomes(named.size(), std::vector<CaptureOutcome>(static_cast<size_t>(seeds)));
    std::vector<Method> methods;
    for (size_t i = 0; i < named.size(); ++i) {
        methods.push_back(
            {"", {{"", [&, i](uint64_t seed) {
                       CaptureOutcome sum;
                       for (size_t m = 0; m < metals; ++m) {
                           const CaptureOutcome one = capture_outcome(
                               five_metals()[m].set, bench.settings(seed), named[i].recipe);
                           const double share = 1 / static_cast<double>(metals);
                           sum.seconds += share * one.seconds;
                           sum.moving_s += share * one.moving_s;
                           sum.integrating_s += share * one.integrating_s;
                           sum.psi_error_deg += share * std::pow(one.psi_error_deg, 2);
                           sum.delta_error_deg += share * std::pow(one.delta_error_deg, 2);
                           sum.psi_pull += share * std::pow(one.psi_pull, 2);
                           sum.delta_pull += share * std::pow(one.delta_pull, 2);
                           sum.rows += one.rows;
                       }
                       for (double* square : {&sum.psi_error_deg, &sum.delta_error_deg,
                                              &sum.psi_pull, &sum.delta_pull}) {
                           *square = std::sqrt(*square);
                       }
                       outcomes[i][seed - 1] = sum;
                       return Measured{1, 0};
                   }}}});
    }
    Progress progress("sweeps, " + bench.name, named.size() * static_cast<size_t>(seeds), quiet);
    run_shuffled(methods, seeds, 1, [&] { progress.step(); });
    return outcomes;
}

ChartPoint point_of(const NamedRecipe& named, const std::vector<CaptureOutcome>& outcomes,
                    double CaptureOutcome::*error, double CaptureOutcome::*pull) {
    ChartPoint point;
    point.setting = named.setting;
    point.automatic = named.automatic;
    const auto n = static_cast<double>(outcomes.size());
    std::vector<double> seconds;
    double squares = 0, pulls = 0;
    for (const CaptureOutcome& o : outcomes) {
        seconds.push_back(o.seconds);
        point.error += o.*error / n;
        pulls += o.*pull / n;
    }
    for (const CaptureOutcome& o : outcomes) squares += std::pow(o.*error - point.error, 2);
    if (outcomes.size() > 1) point.error_sigma = std::sqrt(squares / (n * (n - 1)));
    point.cost = median(std::move(seconds));
    point.note = fmt::format("{:.2f} times the stated sigma", pulls);
    return point;
}

// Where the reduction's sigmas are furthest from the errors.
std::string worst_sigma(const std::vector<NamedRecipe>& named, const Outcomes& outcomes,
                        double CaptureOutcome::*pull) {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    size_t at = 0;
    for (size_t i = 0; i < named.size(); ++i) {
        double mean = 0;
        for (const CaptureOutcome& o : outcomes[i]) {
            mean += o.*pull / static_cast<double>(outcomes[i].size());
        }
        least = std::min(least, mean);
        if (mean > most) most = mean, at = i;
    }
    return fmt::format("Errors are {:.2f} to {:.2f} times the stated sigmas, most with {} ({}).",
                       least, most, named[at].setting, named[at].curve);
}

Chart chart_of(const std::vector<NamedRecipe>& named, const Outcomes& outcomes,
               const BenchKind& bench, bool psi, int seeds, size_t metals) {
    const auto error = psi ? &CaptureOutcome::psi_error_deg : &CaptureOutcome::delta_error_deg;
    const auto pull = psi ? &CaptureOutcome::psi_pull : &CaptureOutcome::delta_pull;
    Chart chart;
    chart.id = fmt::format("capture-{}-{}", bench.id, psi ? "psi" : "delta");
    chart.title =
        fmt::format("Capture: error of {} on a bench with {}", psi ? "Psi" : "Delta", bench.name);
    chart.cost = "measuring an angle of incidence (s, by the bench's clock)";
    chart.error = fmt::format("rms error of {} (degrees)", psi ? "Psi" : "Delta");
    chart.caption = fmt::format(
        "{}. The virtual bench at 70 degrees of incidence, 2048 pixels in bins of 5 nm from 380 to "
        "780 nm, automatic exposure, 16 dark frames but where a curve says another number; its "
        "time counts moves, frames, discarded "
        "frames and darks. Root mean square over the rows and {} metals, mean over {} seeds. The "
        "notes compare the errors with the sigmas that the reduction states, what all wavelengths "
        "share included.",
        bench.caption, metals, seeds);
    for (size_t i = 0; i < named.size(); ++i) {
        if (chart.curves.empty() || chart.curves.back().method != named[i].curve) {
            chart.curves.push_back({named[i].curve, {}});
        }
        chart.curves.back().points.push_back(point_of(named[i], outcomes[i], error, pull));
    }
    const double wanted = psi ? 0.05 : 0.1;
    for (const ChartCurve& curve : chart.curves) {
        const ChartPoint* enough = nullptr;
        for (const ChartPoint& p : curve.points) {
            if (p.error <= wanted && (!enough || p.cost < enough->cost)) enough = &p;
        }
        const ChartPoint& last = curve.points.back();
        chart.findings.push_back(
            fmt::format("{}: {}; {:.2g} degrees after {:.0f} s ({}), slope {:.2f}.", curve.method,
                        enough ? fmt::format("{:g} degrees within {:.0f} s ({})", wanted,
                                             enough->cost, enough->setting)
                               : fmt::format("{:g} degrees are not reached", wanted),
                        last.error, last.cost, last.setting, log_slope(curve)));
    }
    chart.findings.push_back(worst_sigma(named, outcomes, pull));
    const auto usual = std::find_if(named.begin(), named.end(),
                                    [](const NamedRecipe& recipe) { return recipe.automatic; });
    const std::vector<CaptureOutcome>& sweeps =
        outcomes[static_cast<size_t>(usual - named.begin())];
    const ChartPoint point = point_of(*usual, sweeps, error, pull);
    ChartPoint best = point;
    for (const ChartPoint& p : pareto_front(chart)) {
        if (p.cost <= point.cost) best = p;
    }
    chart.findings.push_back(fmt::format(
        "The default recipe takes {:.0f} s an angle for {:.2g} degrees, {:.0f} % of them moving "
        "and "
        "{:.0f} % integrating; the least error that any recipe has in that time is {:.2g}.",
        point.cost, point.error, 100 * sweeps[0].moving_s / sweeps[0].seconds,
        100 * sweeps[0].integrating_s / sweeps[0].seconds, best.error));
    return chart;
}

BenchResult run(const BenchOptions& options) {
    const int seeds = options.seeds > 0 ? options.seeds : options.quick ? 2 : 5;
    const size_t metals = options.quick ? 1 : five_metals().size();
    const std::vector<NamedRecipe> named = recipes(options.quick);
    BenchResult result;
    for (const BenchKind& bench : benches()) {
        const Outcomes outcomes = run_all(named, bench, seeds, metals, options.quiet);
        for (const bool psi : {true, false}) {
            result.charts.push_back(chart_of(named, outcomes, bench, psi, seeds, metals));
        }
    }
    return result;
}

}  // namespace

BenchItem capture_item() {
    return {"capture", "Capture: seconds of measuring",
            "steps, cycles, zones, averages on the virtual bench: error of Psi and Delta", run};
}

}  // namespace drude
