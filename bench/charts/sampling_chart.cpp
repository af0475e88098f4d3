// Chart 3: how paths look for light, how facets are chosen, and what points they are chosen by.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/progress.h"
#include "bench/charts/bench_items.h"
#include "bench/charts/chart_scenes.h"
#include "bench/charts/experiment.h"
#include "bench/charts/traced_picture.h"
#include "render/transport_choice.h"

namespace drude {

namespace {

using Directions = SamplingStrategy::Directions;

constexpr int wavelengths = 8;
constexpr uint64_t reference_seed = 900002;

struct Way {
    std::string name;
    SamplingStrategy strategy;
    int batch = 16;  // points of a net; 0: all samples are one net
    bool automatic = false;
};

struct Subject {
    std::string id, title;
    Scene scene;
    std::vector<Way> ways;
    std::vector<int> samples;
    int reference_samples;
    // Whether the chart is drawn over samples instead of time.
    bool over_samples = false;
};

const SamplingStrategy usual;

std::vector<Way> ways_under_sky() {
    return {{"lobes alone", {Directions::lobe, true, true}},
            {"lights alone", {Directions::light, false, true}},
            {"both (MIS)", {Directions::both, false, true}},
            {"both, sky compensated", usual, 16, true}};
}
std::vector<Way> ways_under_lamps() {
    return {{"lobes alone", {Directions::lobe, true, true}},
            {"lights alone", {Directions::light, false, true}},
            {"both (MIS)", usual, 16, true}};
}
std::vector<Way> ways_of_normals() {
    return {{"half vectors", {Directions::both, true, false}},
            {"visible normals", usual, 16, true},
            {"half vectors, lobes alone", {Directions::lobe, true, false}},
            {"visible normals, lobes alone", {Directions::lobe, true, true}}};
}
std::vector<Way> ways_of_points() {
    return {
        {"independent", usual, 1}, {"nets of 16", usual, 16, true}, {"one net of all", usual, 0}};
}

std::string copper(double beta, const std::string& lobe_and_masking) {
    return fmt::format("Material \"conductor\" \"string material\" \"Cu\" {} \"float beta\" {}",
                       lobe_and_masking, beta);
}
const std::string smith = "\"string lobe\" \"trowbridge-reitz\" \"string masking\" \"smith\"";
const std::string groove = "\"string lobe\" \"blinn-phong\" \"string masking\" \"v-groove\"";

std::vector<Subject> subjects(bool quick) {
    const auto pick = [quick](int a, int b) { return quick ? a : b; };
    const std::vector<int> samples =
        quick ? std::vector<int>{16, 64} : std::vector<int>{16, 64, 256};
    const int size = pick(16, 32), box = pick(8, 16), reference = pick(1024, 8192);
    const auto dome = [size](const std::string& material) {
        return half_sphere_in_courtyard(size, size, material);
    };
    std::vector<Subject> all;
    for (const double beta : {0.02, 0.2, 0.6}) {
        all.push_back({fmt::format("sky-{}", static_cast<int>(std::lround(100 * beta))),
                       fmt::format("copper of beta {} in the courtyard", beta),
                       dome(copper(beta, smith)), ways_under_sky(), samples, reference});
    }
    all.push_back({"lamps", "plates of aluminium under three lamps", plates_under_lamps(size, size),
                   ways_under_lamps(), samples, reference});
    all.push_back({"normals-smith", "copper of beta 0.6, Smith's masking", dome(copper(0.6, smith)),
                   ways_of_normals(), samples, reference});
    all.push_back({"normals-groove", "copper of beta 0.6, v-grooves", dome(copper(0.6, groove)),
                   ways_of_normals(), samples, reference});
    all.push_back({"points-sky", "points: copper of beta 0.2 in the courtyard",
                   dome(copper(0.2, smith)), ways_of_points(), samples, reference, true});
    all.push_back({"points-box", "points: a closed box of metals",
                   chart_scene("cornell-metals", box, box), ways_of_points(), samples,
                   pick(512, 2048), true});
    return all;
}

// The sampling-strategies of one scene, each with lights that sample for it.
struct Experiment {
    Chart chart;
    std::vector<ChartCurve> over_samples, over_time;
};

// Runs are made once: `seconds` keeps what they cost in time where the chart is over samples.
Experiment experiment(const Subject& subject, int seeds, Progress* progress) {
    const TracedScene exact(subject.scene);
    const Transport transport = automatic_transport(subject.scene).transport;
    const ReferencePicture reference =
        trace_reference(*make_batch_tracer(transport, wavelengths, exact.setup(reference_seed)),
                        subject.scene.film, 1, subject.reference_samples);
    progress->step();
    std::vector<std::unique_ptr<TracedScene>> scenes;
    std::vector<Method> methods;
    for (const Way& way : subject.ways) {
        scenes.push_back(std::make_unique<TracedScene>(subject.scene, way.strategy));
        Method method{way.name, {}};
        for (const int samples : subject.samples) {
            const TracedScene* scene = scenes.back().get();
            const int batch = way.batch > 0 ? way.batch : std::min(samples, largest_batch);
            const auto run = [&reference, scene, transport, samples, batch](uint64_t seed) {
                const auto tracer = make_batch_tracer(transport, wavelengths, scene->setup(seed));
                const TracedPicture picture =
                    trace_picture(*tracer, scene->scene().film, 1, samples, batch);
                return Measured{picture.seconds, relative_rmse(picture, reference)};
            };
            method.settings.push_back({fmt::format("{} spp", samples), run, way.automatic});
        }
        methods.push_back(std::move(method));
    }
    Experiment e;
    e.over_time = run_shuffled(methods, seeds, 1, [&] { progress->step(); });
    e.over_samples = e.over_time;
    for (ChartCurve& curve : e.over_samples) {
        for (size_t i = 0; i < curve.points.size(); ++i) {
            curve.points[i].note = fmt::format("{:.4g} s", curve.points[i].cost);
            curve.points[i].cost = subject.samples[i];
        }
    }
    e.chart.id = "sampling-" + subject.id;
    e.chart.title = "Sampling: " + subject.title;
    e.chart.cost = subject.over_samples ? "samples a pixel" : "processor time (s)";
    e.chart.error = "relative RMSE";
    e.chart.curves = subject.over_samples ? e.over_samples : e.over_time;
    e.chart.caption = fmt::format(
        "{} x {} pixels, transport {}, {} wavelengths a path, {} seeds; the reference is the usual "
        "sampling with {} samples a pixel of another seed. Error as of the transport charts: "
        "squared differences of R, G, B over the squared colour and a floor, without the "
        "reference's own noise. Samples come in nets of 16 points where nothing else is said.",
        subject.scene.film.width, subject.scene.film.height, transport_name(transport), wavelengths,
        seeds, reference.samples);
    return e;
}

const Way& usual_way(const Subject& subject) {
    return *std::find_if(subject.ways.begin(), subject.ways.end(),
                         [](const Way& w) { return w.automatic; });
}

// The time in which this curve has the error of the other, over that of the other: from the most
// samples of both, with errors that fall as one over the root of time.
double time_ratio(const ChartCurve& curve, const ChartCurve& other) {
    const ChartPoint &a = curve.points.back(), &b = other.points.back();
    return a.cost / b.cost * std::pow(a.error / b.error, 2);
}

const ChartCurve& curve_of(const std::vector<ChartCurve>& curves, const std::string& method) {
    return *std::find_if(curves.begin(), curves.end(),
                         [&](const ChartCurve& c) { return c.method == method; });
}

void add_findings(const Subject& subject, Experiment* e) {
    const std::string usual_name = usual_way(subject).name;
    const ChartCurve& best = curve_of(e->over_time, usual_name);
    for (size_t i = 0; i < subject.ways.size(); ++i) {
        const ChartCurve& over_samples = e->over_samples[i];
        std::string text =
            fmt::format("{}: error {:.3g} with {} samples a pixel, falling as samples^{:.2f}",
                        subject.ways[i].name, over_samples.points.back().error,
                        subject.samples.back(), log_slope(over_samples));
        if (subject.ways[i].name != usual_name) {
            text += fmt::format("; takes {:.3g} times the time of {} for its error",
                                time_ratio(e->over_time[i], best), usual_name);
        } else {
            text += ", the usual way";
        }
        e->chart.findings.push_back(text + ".");
    }
}

void add_rows(const Subject& subject, const Experiment& e, BenchTable* table) {
    const ChartCurve& best = curve_of(e.over_time, usual_way(subject).name);
    for (size_t i = 0; i < subject.ways.size(); ++i) {
        const ChartPoint& last = e.over_time[i].points.back();
        table->rows.push_back(
            {subject.title, subject.ways[i].name, subject.ways[i].automatic ? "usual" : "",
             fmt::format("{}", subject.samples.back()), fmt::format("{:.3g}", last.cost),
             fmt::format("{:.3g}", last.error), fmt::format("{:.2g}", last.error_sigma),
             fmt::format("{:.2f}", log_slope(e.over_samples[i])),
             fmt::format("{:.2f}", time_ratio(e.over_time[i], best))});
    }
}

BenchResult run(const BenchOptions& options) {
    const std::vector<Subject> all = subjects(options.quick);
    const int seeds = options.seeds > 0 ? options.seeds : (options.quick ? 2 : 4);
    size_t steps = 0;
    for (const Subject& s : all) {
        steps += 1 + s.ways.size() * s.samples.size() * static_cast<size_t>(seeds);
    }
    Progress progress("sampling", steps, options.quiet);
    BenchResult result;
    BenchTable table;
    table.id = "sampling-summary";
    table.caption =
        "Ways of sampling: error and time at the most samples, the slope of log error over log "
        "samples (independent samples: -0.5), and the time that each takes for the error of the "
        "usual way.";
    table.columns = {"scene", "way",      "",
                     "spp",   "time (s)", "error",
                     "sigma", "slope",    "time for the same error"};
    for (const Subject& subject : all) {
        Experiment e = experiment(subject, seeds, &progress);
        add_findings(subject, &e);
        add_rows(subject, e, &table);
        result.charts.push_back(std::move(e.chart));
    }
    result.tables.push_back(std::move(table));
    return result;
}

}  // namespace

BenchItem sampling_item() {
    return {"sampling", "Sampling: where paths look for light, and by which points",
            "lobes, lights, both; visible normals; nets of points: error against samples and time",
            run};
}

}  // namespace drude
