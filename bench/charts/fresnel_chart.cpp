#include "bench/charts/fresnel_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/charts/bench_items.h"
#include "bench/charts/experiment.h"

namespace drude {

namespace {

constexpr const char* conditions =
    "Packets of 8 wavelengths in float, constants or tables fetched for a random phase and angle "
    "(sin^2 uniform), one evaluation after the other without waiting for the last; processor time, "
    "medians of {} runs in shuffled order over copper, silver, gold, aluminium and zinc. The "
    "reference is the closed form in double over the visible half of a sphere and 380 to 779 nm; "
    "errors are root mean squares over the five metals. ";

// Mean error of the five metals, and each by itself.
struct MethodErrors {
    std::vector<FresnelError> metals;
    // Root mean square over the metals.
    double rms(double FresnelError::*member) const {
        double squares = 0;
        for (const FresnelError& e : metals) squares += e.*member * e.*member;
        return std::sqrt(squares / static_cast<double>(metals.size()));
    }
    const FresnelError& worst(double FresnelError::*member, std::string* name) const {
        const auto found = std::max_element(
            metals.begin(), metals.end(),
            [&](const FresnelError& a, const FresnelError& b) { return a.*member < b.*member; });
        *name = five_metals()[static_cast<size_t>(found - metals.begin())].name;
        return *found;
    }
};

struct Experiment {
    std::vector<DenseIndex> metals;
    std::vector<std::vector<FresnelMethod>> methods;  // by metal
    std::vector<MethodErrors> errors;                 // by method
    std::vector<double> reflectance_ns, pair_ns;      // by method; 0: has no pair
    double loop_ns = 0, full_ns = 0;
};

Experiment experiment(int runs) {
    Experiment e;
    for (const NamedMetal& metal : five_metals()) {
        e.metals.push_back(dense(published_set(metal.set)));
        e.methods.push_back(fresnel_methods(e.metals.back()));
    }
    const size_t count = e.methods[0].size();
    for (size_t m = 0; m < count; ++m) {
        MethodErrors errors;
        for (size_t i = 0; i < e.metals.size(); ++i) {
            errors.metals.push_back(fresnel_error(e.methods[i][m], e.metals[i]));
        }
        e.errors.push_back(std::move(errors));
    }
    // Seeds go round the metals.
    const auto metal_of = [](uint64_t seed) { return static_cast<size_t>(seed) % 5; };
    std::vector<Method> timed;
    const auto add = [&](const std::function<double(uint64_t)>& ns) {
        timed.push_back({"", {{"", [ns](uint64_t seed) { return Measured{ns(seed), 0}; }}}});
    };
    for (size_t m = 0; m < count; ++m) {
        add([&, m](uint64_t s) {
            return e.methods[metal_of(s)][m].reflectance_ns(FresnelInputs(s));
        });
        if (!e.methods[0][m].pair) continue;
        add([&, m](uint64_t s) { return e.methods[metal_of(s)][m].pair_ns(FresnelInputs(s)); });
    }
    add([&](uint64_t s) { return fresnel_loop_ns(e.metals[metal_of(s)], FresnelInputs(s)); });
    add([&](uint64_t s) { return full_reflection_ns(e.metals[metal_of(s)], FresnelInputs(s)); });
    const std::vector<ChartCurve> curves = run_shuffled(timed, runs);
    size_t next = 0;
    const auto cost = [&] { return curves[next++].points[0].cost; };
    for (size_t m = 0; m < count; ++m) {
        e.reflectance_ns.push_back(cost());
        e.pair_ns.push_back(e.methods[0][m].pair ? cost() : 0);
    }
    e.loop_ns = cost();
    e.full_ns = cost();
    return e;
}

// Methods of one name, one after the other, are a curve.
Chart chart_of(const Experiment& e, const std::vector<double>& ns, double FresnelError::*member) {
    Chart chart;
    chart.cost = "processor time a packet of 8 wavelengths (ns)";
    for (size_t m = 0; m < ns.size(); ++m) {
        if (!(ns[m] > 0)) continue;
        const FresnelMethod& method = e.methods[0][m];
        if (chart.curves.empty() || chart.curves.back().method != method.name) {
            chart.curves.push_back({method.name, {}});
        }
        ChartPoint point;
        point.setting = method.setting;
        point.cost = ns[m];
        point.error = e.errors[m].rms(member);
        point.automatic = method.automatic;
        point.note =
            fmt::format("{:.1f} kB of tables a metal", static_cast<double>(method.bytes) / 1000);
        chart.curves.back().points.push_back(std::move(point));
    }
    return chart;
}

std::string full_name(const FresnelMethod& method) {
    return method.name == "table over cos" ? method.name + ", " + method.setting : method.name;
}

// The cheapest table that is as good as pbrt-v2's approximation, and what it costs.
std::string table_as_good(const Experiment& e, double FresnelError::*member) {
    constexpr size_t other = 1;
    for (size_t m = 0; m < e.errors.size(); ++m) {
        if (e.methods[0][m].name != "table over cos") continue;
        if (e.errors[m].rms(member) > e.errors[other].rms(member)) continue;
        return fmt::format(
            "A table of {} ({:.0f} kB a metal) is as good as pbrt-v2's approximation in {:.2f} "
            "times its time, {:.2f} times that of the exact form.",
            e.methods[0][m].setting, static_cast<double>(e.methods[0][m].bytes) / 1000,
            e.reflectance_ns[m] / e.reflectance_ns[other],
            e.reflectance_ns[m] / e.reflectance_ns[0]);
    }
    return "No table up to the largest is as good as pbrt-v2's approximation.";
}

Chart reflectance_chart(const Experiment& e, int runs) {
    Chart chart = chart_of(e, e.reflectance_ns, &FresnelError::rms);
    chart.id = "fresnel-reflectance";
    chart.title = "Fresnel: reflectance of unpolarised light";
    chart.error = "rms error of the reflectance";
    chart.caption = fmt::format(conditions, runs);
    chart.findings.push_back(fmt::format(
        "Exact costs {:.2f} ns a packet, pbrt-v2's approximation {:.2f}, Schlick {:.2f}, with "
        "Lazanyi's term {:.2f}; the loop and two fetched constants alone {:.2f}.",
        e.reflectance_ns[0], e.reflectance_ns[1], e.reflectance_ns[2], e.reflectance_ns[3],
        e.loop_ns));
    for (size_t m = 0; m < 4; ++m) {
        std::string metal;
        const FresnelError& worst = e.errors[m].worst(&FresnelError::worst, &metal);
        chart.findings.push_back(fmt::format("{}: worst error {:.2g}, on {} at {:.0f} degrees.",
                                             full_name(e.methods[0][m]), worst.worst, metal,
                                             worst.worst_angle_deg));
    }
    chart.findings.push_back(table_as_good(e, &FresnelError::rms));
    return chart;
}

Chart psi_chart(const Experiment& e, int runs) {
    Chart chart = chart_of(e, e.pair_ns, &FresnelError::rms_psi_deg);
    chart.id = "fresnel-psi";
    chart.title = "Fresnel: Psi, from Rs and Rp";
    chart.error = "rms error of Psi (degrees)";
    chart.caption = fmt::format(conditions, runs) +
                    "Schlick has one reflectance for s and p, hence no Psi, with Lazanyi's term or "
                    "without; only the exact form has Delta.";
    std::string metal;
    const FresnelError& worst = e.errors[1].worst(&FresnelError::rms_psi_deg, &metal);
    chart.findings.push_back(fmt::format(
        "pbrt-v2's approximation is off by {:.2g} degrees of Psi (rms) on {}, {:.0f} times what "
        "an ellipsometer of 0.05 degrees sees.",
        worst.rms_psi_deg, metal, worst.rms_psi_deg / 0.05));
    chart.findings.push_back(
        fmt::format("Taken as 45 degrees, as a method without Psi has it, it is off by {:.2g}.",
                    e.errors[2].rms(&FresnelError::rms_psi_deg)));
    chart.findings.push_back(
        fmt::format("All four numbers of the reflection, Delta with them, cost {:.2f} ns against "
                    "{:.2f} of Rs and Rp.",
                    e.full_ns, e.pair_ns[0]));
    return chart;
}

Chart picture_chart(const Experiment& e, int runs) {
    Chart chart = chart_of(e, e.reflectance_ns, &FresnelError::mean_delta_e);
    chart.id = "fresnel-picture";
    chart.title = "Fresnel: the picture of a polished sphere under a white sky";
    chart.error = "mean colour error (CIEDE2000)";
    chart.caption = fmt::format(conditions, runs) +
                    "The picture is integrated exactly (sky of constant D65, which is white); 1 "
                    "is about a just noticeable difference.";
    for (size_t m = 1; m < 4; ++m) {
        std::string metal;
        const FresnelError& worst = e.errors[m].worst(&FresnelError::mean_delta_e, &metal);
        chart.findings.push_back(
            fmt::format("{}: {:.2g} on the mean of a picture of {}, {:.2g} in its worst ring: {}.",
                        full_name(e.methods[0][m]), worst.mean_delta_e, metal, worst.worst_delta_e,
                        worst.worst_delta_e < 1 ? "not to be seen" : "to be seen"));
    }
    chart.findings.push_back(table_as_good(e, &FresnelError::mean_delta_e));
    return chart;
}

BenchTable metal_table(const Experiment& e) {
    BenchTable table;
    table.id = "fresnel-metals";
    table.caption =
        "Every method on every metal: error of the unpolarised reflectance (root mean square, "
        "largest and where), of Psi in degrees, and of the sphere's picture (CIEDE2000, relative "
        "root mean square of R, G, B).";
    table.columns = {"method",  "metal",        "rms of R",      "worst of R",  "at (deg)",
                     "rms Psi", "mean Delta E", "worst Delta E", "picture rmse"};
    for (size_t m = 0; m < e.errors.size(); ++m) {
        for (size_t i = 0; i < e.metals.size(); ++i) {
            const FresnelError& error = e.errors[m].metals[i];
            table.rows.push_back(
                {full_name(e.methods[0][m]), five_metals()[i].name,
                 fmt::format("{:.2g}", error.rms), fmt::format("{:.2g}", error.worst),
                 fmt::format("{:.0f}", error.worst_angle_deg),
                 e.methods[0][m].pair ? fmt::format("{:.2g}", error.rms_psi_deg) : "none",
                 fmt::format("{:.2g}", error.mean_delta_e),
                 fmt::format("{:.2g}", error.worst_delta_e),
                 fmt::format("{:.2g}", error.relative_rmse)});
        }
    }
    return table;
}

BenchResult run(const BenchOptions& options) {
    const int runs = options.seeds > 0 ? options.seeds : options.quick ? 15 : 101;
    const Experiment e = experiment(runs);
    return {{reflectance_chart(e, runs), psi_chart(e, runs), picture_chart(e, runs)},
            {},
            {metal_table(e)}};
}

}  // namespace

BenchItem fresnel_item() {
    return {"fresnel", "Fresnel: exact, approximate, tabulated",
            "reflectance of metals: error of R, Psi and pictures against nanoseconds", run};
}

}  // namespace drude
