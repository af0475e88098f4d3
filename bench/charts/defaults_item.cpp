#include "bench/charts/defaults_item.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "base/error.h"
#include "base/progress.h"
#include "bench/charts/bench_items.h"
#include "bench/charts/experiment.h"
#include "image/compare.h"
#include "materials/embedded_tables.h"
#include "render/batch_tracer.h"
#include "render/bounce_choice.h"
#include "render/light_choice.h"
#include "render/transport_choice.h"
#include "scene/resolution.h"

namespace drude {

namespace {

struct Run {
    RenderResult result;
    double seconds = 0;  // of this thread
};

struct Compared {
    std::string scene;
    RenderSummary cheap, rich;
    BounceChoice bounces;
    LightChoice lights;
    std::vector<double> cheap_seconds, rich_seconds;
    std::vector<double> cheap_error, rich_error;
    Comparison comparison;
};

Run run_once(const Scene& scene, RenderOptions options, int samples, uint64_t seed) {
    options.samples_per_pixel = samples;
    options.seed = seed;
    options.threads = 1;
    options.quiet = true;
    const double start = thread_seconds();
    Run run;
    run.result = render(scene, options);
    run.seconds = thread_seconds() - start;
    return run;
}

std::string seconds_text(double seconds) {
    return fmt::format("{:.3g}", seconds);
}

double mean_of(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

ChartPoint point_of(const std::string& scene, const std::vector<double>& seconds,
                    const std::vector<double>& errors, bool automatic) {
    ChartPoint point;
    point.setting = scene;
    point.cost = median(seconds);
    point.error = mean_of(errors);
    double squares = 0;
    for (const double error : errors) squares += (error - point.error) * (error - point.error);
    const auto n = static_cast<double>(errors.size());
    if (n > 1) point.error_sigma = std::sqrt(squares / (n * (n - 1)));
    point.automatic = automatic;
    return point;
}

// Where polarisers cross, a picture is black but for what rounding leaves, which differs between
// transports and is no noise: a millionth of the picture's mean is granted to every pixel.
void grant_rounding(Image* image) {
    for (const char* channel : {"R", "G", "B"}) {
        double sum = 0;
        for (const float value : image->at(channel, "picture").data) {
            sum += static_cast<double>(value);
        }
        const double rounding = 1e-6 * sum / static_cast<double>(image->pixels());
        for (Channel& variance : image->channels) {
            if (variance.name != variance_name(channel)) continue;
            for (float& value : variance.data) {
                value += static_cast<float>(rounding * rounding);
            }
        }
    }
}

BenchTable table_of(const std::vector<Compared>& all) {
    BenchTable table;
    table.id = "defaults-scenes";
    table.caption =
        "What is chosen by itself against the richest model of the same picture, at the same "
        "number of samples: medians of the processor time of one thread, relative errors that the "
        "pictures' own variances tell, and Welch's test of the two pictures (same where p >= "
        "0.001; a millionth of the mean is granted to rounding). Gain: time times squared error, "
        "richest over default.";
    table.columns = {"scene",      "transport",  "wavelengths", "reflections",   "lights",
                     "default, s", "richest, s", "time ratio",  "default error", "richest error",
                     "gain",       "p",          "same"};
    for (const Compared& one : all) {
        const double cheap = median(one.cheap_seconds), rich = median(one.rich_seconds);
        const double cheap_error = mean_of(one.cheap_error), rich_error = mean_of(one.rich_error);
        const double gain = rich * rich_error * rich_error / (cheap * cheap_error * cheap_error);
        table.rows.push_back(
            {one.scene, std::string(transport_name(one.cheap.transport)),
             fmt::format("{}", one.cheap.wavelengths), fmt::format("{}", one.bounces.reflections),
             one.lights.any ? "sampled" : "by lobes", seconds_text(cheap), seconds_text(rich),
             fmt::format("{:.2f}", rich / cheap), fmt::format("{:.3g}", cheap_error),
             fmt::format("{:.3g}", rich_error), fmt::format("{:.2f}", gain),
             fmt::format("{:.3g}", one.comparison.noise ? one.comparison.noise->p_min : 1),
             one.comparison.same ? "yes" : "NO"});
    }
    return table;
}

std::vector<std::string> findings_of(const std::vector<Compared>& all,
                                     const std::vector<std::string>& left_out) {
    double cheap = 0, rich = 0;
    size_t same = 0;
    for (const Compared& one : all) {
        cheap += median(one.cheap_seconds);
        rich += median(one.rich_seconds);
        same += one.comparison.same;
    }
    std::vector<std::string> findings;
    findings.push_back(fmt::format(
        "The default draws the same picture as the richest model within noise in {} of {} scenes, "
        "in {:.3g} s instead of {:.3g} s: {:.2f} times faster in total.",
        same, all.size(), cheap, rich, rich / cheap));
    for (const Compared& one : all) {
        if (!one.comparison.same) {
            findings.push_back(fmt::format("{} differs: {}", one.scene, one.comparison.reason));
        }
    }
    for (const std::string& reason : left_out) findings.push_back("Left out: " + reason);
    return findings;
}

}  // namespace

RenderOptions richest_options() {
    RenderOptions richest;
    richest.transport = Transport::stokes;
    richest.wavelengths = spectral_bins;
    richest.films = FilmUse::keep;
    richest.mirror_below = 0;
    richest.sample_every_light = true;
    richest.trace_every_ray = true;
    return richest;
}

Scene small_scene(const std::string& name, int size) {
    for (const EmbeddedTable& scene : embedded_scenes()) {
        if (scene.name != name) continue;
        Scene small = parse_scene(std::string(scene.text), "scenes/" + name + ".pbrt");
        const double scale =
            static_cast<double>(size) / std::max(1, std::max(small.film.width, small.film.height));
        const auto scaled = [&](int pixels) {
            return std::max(8, static_cast<int>(std::lround(pixels * scale)));
        };
        set_resolution(fmt::format("{}x{}", scaled(small.film.width), scaled(small.film.height)),
                       "size", &small);
        return small;
    }
    user_error("found the scene '{}', expected one of scenes/", name);
}

BenchResult run_defaults(const BenchOptions& options) {
    const int size = options.quick ? 24 : 64, samples = options.quick ? 128 : 256;
    const int seeds = options.seeds > 0 ? options.seeds : options.quick ? 1 : 3;
    std::vector<Compared> all;
    std::vector<Scene> scenes;
    std::vector<std::string> left_out;
    for (const EmbeddedTable& embedded : embedded_scenes()) {
        try {
            scenes.push_back(small_scene(std::string(embedded.name), size));
        } catch (const Error& error) {
            if (error.cause() != Cause::user) throw;
            left_out.push_back(fmt::format("{} ({})", embedded.name, error.message()));
            continue;
        }
        Compared one;
        one.scene = embedded.name;
        one.bounces = bounce_choice(scenes.back());
        one.lights = light_choice(scenes.back(), {});
        all.push_back(std::move(one));
    }
    struct Task {
        size_t scene;
        bool rich;
        int seed;
    };
    std::vector<Task> tasks;
    for (size_t i = 0; i < all.size(); ++i) {
        for (int seed = 1; seed <= seeds; ++seed) {
            tasks.push_back({i, false, seed});
            tasks.push_back({i, true, seed});
        }
    }
    std::mt19937_64 random(1);
    for (size_t i = tasks.size(); i > 1; --i) std::swap(tasks[i - 1], tasks[random() % i]);
    // The pictures of the first seed are compared.
    std::vector<std::optional<RenderResult>> cheap(all.size()), rich(all.size());
    Progress progress("defaults", tasks.size(), options.quiet);
    for (const Task& task : tasks) {
        Compared& one = all[task.scene];
        // Of other random numbers, so that noise is compared with noise.
        const auto seed = 2 * static_cast<uint64_t>(task.seed) + (task.rich ? 1 : 0);
        Run run = run_once(scenes[task.scene], task.rich ? richest_options() : RenderOptions{},
                           samples, seed);
        (task.rich ? one.rich_seconds : one.cheap_seconds).push_back(run.seconds);
        (task.rich ? one.rich_error : one.cheap_error).push_back(run.result.error.value_or(0));
        (task.rich ? one.rich : one.cheap) = static_cast<const RenderSummary&>(run.result);
        if (task.seed == 1) (task.rich ? rich : cheap)[task.scene] = std::move(run.result);
        progress.step();
    }
    for (size_t i = 0; i < all.size(); ++i) {
        CompareOptions how;
        // The stated model is part of a picture's name; the scene is one.
        how.any_scene = true;
        how.threads = 1;
        grant_rounding(&cheap[i]->image);
        grant_rounding(&rich[i]->image);
        all[i].comparison =
            compare_images(cheap[i]->image, rich[i]->image, "default", "richest", how);
    }
    Chart chart;
    chart.id = "defaults";
    chart.title = "What is chosen by itself, and the richest of everything";
    chart.cost = "processor time (s)";
    chart.error = "relative error of R, G, B";
    chart.caption = fmt::format(
        "The scenes of scenes/ at {} pixels on the longer side, {} samples a pixel, {} seeds, "
        "order shuffled; one thread. Richest: Stokes transport, 40 wavelengths, every light "
        "sampled, every ray traced, no lobe a mirror, every film kept; the scene's maxdepth.",
        size, samples, seeds);
    ChartCurve by_default{"default", {}, false}, richest{"richest", {}, false};
    for (const Compared& one : all) {
        by_default.points.push_back(point_of(one.scene, one.cheap_seconds, one.cheap_error, true));
        richest.points.push_back(point_of(one.scene, one.rich_seconds, one.rich_error, false));
    }
    chart.curves = {by_default, richest};
    chart.findings = findings_of(all, left_out);
    BenchResult result;
    result.charts.push_back(std::move(chart));
    result.tables.push_back(table_of(all));
    BenchResult costs = run_decision_costs(options);
    for (BenchTable& table : costs.tables) result.tables.push_back(std::move(table));
    return result;
}

BenchItem defaults_item() {
    return {"defaults", "No more model than a scene needs",
            "what is chosen by itself against the richest of everything, on the scenes of scenes/",
            run_defaults};
}

}  // namespace drude
