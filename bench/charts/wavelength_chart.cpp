// Chart 2: how many wavelengths a path carries, and spectra against three channels.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/progress.h"
#include "bench/charts/bench_items.h"
#include "bench/charts/chart_scenes.h"
#include "bench/charts/colour_error.h"
#include "bench/charts/experiment.h"
#include "bench/charts/illuminants.h"
#include "bench/charts/one_wavelength.h"
#include "bench/charts/rgb_error_table.h"
#include "bench/charts/rgb_metal.h"
#include "render/transport_choice.h"
#include "render/wavelength_choice.h"

namespace drude {

namespace {

constexpr int counts[] = {1, 4, 8, 16, spectral_bins};
constexpr uint64_t reference_seed = 900003;

struct Subject {
    std::string id, title;
    Scene scene;
    std::vector<int> samples;
    int reference_samples;
    // Of metals in one light: three channels too, whose picture is times this colour of the light.
    // Those of one wavelength and of three channels have the transport scalar alone.
    std::optional<RGB> light = std::nullopt;
    bool always_scalar = true;
    Transport transport() const {
        return always_scalar ? Transport::scalar : automatic_transport(scene).transport;
    }
};

// On the scene's metals.
void add_film(const std::string& set, double nanometres, Scene* scene) {
    for (SurfaceMaterial& material : scene->materials) {
        if (auto* metal = std::get_if<ConductorMaterial>(&material)) {
            metal->surface.layers = {{published_set(set), nanometres, 0}};
        }
    }
}

std::vector<Subject> subjects(bool quick) {
    const auto pick = [quick](int a, int b) { return quick ? a : b; };
    const int width = pick(16, 32), height = pick(12, 24), reference = pick(512, 4096);
    const std::vector<int> samples =
        quick ? std::vector<int>{16, 64} : std::vector<int>{16, 64, 256};
    // Long enough to see where three channels stop getting better.
    const std::vector<int> many = quick ? samples : std::vector<int>{16, 64, 256, 1024};
    std::vector<Subject> all;
    for (const ChartIlluminant& light : chart_illuminants()) {
        all.push_back({"metals-" + light.id, "metals in " + light.name,
                       metals_in_light(width, height, light.spectrum), many, 2 * reference,
                       xyz_to_rgb(light.white())});
    }
    const auto courtyard = [&](const std::string& id, const std::string& title,
                               const std::string& material) {
        all.push_back({id, title + " in the courtyard",
                       sphere_in_courtyard(height, height, material), samples, reference});
    };
    courtyard("copper", "polished copper",
              "Material \"conductor\" \"string material\" \"Cu\" \"string lobe\" \"blinn-phong\" "
              "\"string masking\" \"v-groove\" \"float beta\" 0.011774");
    courtyard("glass", "flint glass, which disperses",
              "Material \"dielectric\" \"spectrum eta\" \"glass-SF11\"");
    courtyard("film", "aluminium under 400 nm of its oxide",
              "Material \"conductor\" \"string material\" \"Al\" \"string lobe\" "
              "\"trowbridge-reitz\" \"float beta\" 0.02");
    all.push_back(all.back());
    add_film("Al2O3", 400, &all[all.size() - 2].scene);
    all.back().id = "thick-film";
    all.back().title = "aluminium under 3000 nm of its oxide in the courtyard";
    add_film("Al2O3", 3000, &all.back().scene);
    all.push_back({"teapot", "a gold teapot on plaster", teapot_on_plaster(height, height), samples,
                   reference / 2, std::nullopt, false});
    all.push_back({"box", "a closed box of metals",
                   chart_scene("cornell-metals", height / 2, height / 2), samples, reference / 2,
                   std::nullopt, false});
    return all;
}

// A tracer of `count` wavelengths a path.
std::unique_ptr<BatchTracer> tracer_of(int count, Transport transport, const TracerSetup& setup) {
    return count == 1 ? make_one_wavelength_tracer(setup)
                      : make_batch_tracer(transport, count, setup);
}

std::string method_name(int count) {
    return count == 1 ? "1 wavelength" : fmt::format("{} wavelengths", count);
}

struct Experiment {
    Chart chart;
    int automatic = 8;
    std::string reason;
};

struct View {
    TracedPicture reference;
    double white;  // the luminance that counts as white
    double error(const TracedPicture& picture) const {
        return mean_delta_e(picture, reference, white);
    }
};

Method spectral_method(int count, Transport transport, const TracedScene& scene, const View& view,
                       const std::vector<int>& samples, bool automatic) {
    Method method{method_name(count), {}};
    for (const int spp : samples) {
        const auto run = [&scene, &view, count, transport, spp](uint64_t seed) {
            const auto tracer = tracer_of(count, transport, scene.setup(seed));
            const TracedPicture picture = trace_picture(*tracer, scene.scene().film, 1, spp);
            return Measured{picture.seconds, view.error(picture)};
        };
        method.settings.push_back({fmt::format("{} spp", spp), run, automatic});
    }
    return method;
}

Method rgb_method(RgbMetal way, const TracedScene& scene, const ColourMatching& observer,
                  const View& view, const RGB& light, const std::vector<int>& samples) {
    Method method{std::string(rgb_metal_name(way)), {}};
    for (const int spp : samples) {
        const auto run = [&scene, &view, &observer, light, spp](uint64_t seed) {
            const auto tracer =
                make_batch_tracer(Transport::scalar, 4, scene.setup(seed, observer));
            TracedPicture picture = trace_picture(*tracer, scene.scene().film, 1, spp);
            for (size_t i = 0; i < picture.values.size(); ++i) picture.values[i] *= light[i % 3];
            return Measured{picture.seconds, view.error(picture)};
        };
        method.settings.push_back({fmt::format("{} spp", spp), run, false});
    }
    return method;
}

// The time in which a curve reaches the error of another, over that of the other: at the most
// samples of both, with errors that fall as one over the root of time.
double time_ratio(const ChartCurve& curve, const ChartCurve& other) {
    const ChartPoint &a = curve.points.back(), &b = other.points.back();
    return a.cost / b.cost * std::pow(a.error / b.error, 2);
}

bool has_curve(const Chart& chart, int count) {
    return std::any_of(chart.curves.begin(), chart.curves.end(),
                       [&](const ChartCurve& c) { return c.method == method_name(count); });
}

const ChartCurve& curve_of(const Chart& chart, int count) {
    return *std::find_if(chart.curves.begin(), chart.curves.end(),
                         [&](const ChartCurve& c) { return c.method == method_name(count); });
}

void add_findings(const Subject& subject, Experiment* e) {
    const std::vector<int>& samples = subject.samples;
    Chart& chart = e->chart;
    const ChartCurve& usual = curve_of(chart, e->automatic);
    std::string text =
        fmt::format("With {} samples a pixel, error and time for the error of {}:", samples.back(),
                    method_name(e->automatic));
    const char* separator = "";
    for (const int count : counts) {
        if (!has_curve(chart, count)) continue;
        const ChartCurve& curve = curve_of(chart, count);
        text +=
            fmt::format("{} {}: Delta E {:.3g}, {:.2f} times the time", separator,
                        method_name(count), curve.points.back().error, time_ratio(curve, usual));
        separator = ";";
    }
    chart.findings.push_back(text + ".");
    chart.findings.push_back(
        fmt::format("auto takes {}: {}.", method_name(e->automatic), e->reason));
    if (!subject.light) return;
    for (const ChartCurve& curve : chart.curves) {
        if (curve.method.rfind("RGB", 0) != 0) continue;
        const ChartPoint& last = curve.points.back();
        const auto overtakes =
            std::find_if(usual.points.begin(), usual.points.end(),
                         [&](const ChartPoint& p) { return p.error < last.error; });
        chart.findings.push_back(fmt::format(
            "{}: Delta E {:.3g} with {} samples a pixel, at {:.2f} times the cost of {}{}.",
            curve.method, last.error, samples.back(), last.cost / usual.points.back().cost,
            usual.method,
            overtakes == usual.points.end()
                ? ", which does not get there"
                : fmt::format(", which is below that from {} on", overtakes->setting)));
    }
}

Experiment experiment(const Subject& subject, int seeds, Progress* progress) {
    const std::vector<int>& samples = subject.samples;
    const TracedScene scene(subject.scene);
    const Transport transport = subject.transport();
    const ReferencePicture halves =
        trace_reference(*tracer_of(spectral_bins, transport, scene.setup(reference_seed)),
                        subject.scene.film, 1, subject.reference_samples);
    View view{mean_picture(halves), 0};
    view.white = bright_luminance(view.reference);
    progress->step();

    Experiment e;
    const WavelengthChoice choice = cheapest_exact_wavelengths(subject.scene, RenderOptions());
    e.automatic = choice.wavelengths;
    e.reason = choice.reason;
    std::vector<Method> methods;
    for (const int count : counts) {
        if (count == 1 && transport != Transport::scalar) continue;
        methods.push_back(
            spectral_method(count, transport, scene, view, samples, count == choice.wavelengths));
    }
    const ColourMatching observer = rgb_observer();
    std::vector<std::unique_ptr<TracedScene>> in_channels;
    if (subject.light) {
        for (const RgbMetal way : all_rgb_metals) {
            if (way == RgbMetal::schlick) continue;
            in_channels.push_back(std::make_unique<TracedScene>(rgb_scene(subject.scene, way)));
            methods.push_back(
                rgb_method(way, *in_channels.back(), observer, view, *subject.light, samples));
        }
    }
    Chart& chart = e.chart;
    chart.id = "wavelengths-" + subject.id;
    chart.title = "Wavelengths: " + subject.title;
    chart.cost = "processor time (s)";
    chart.error = "mean Delta E 2000";
    chart.curves = run_shuffled(methods, seeds, 1, [&] { progress->step(); });
    chart.caption = fmt::format(
        "{} x {} pixels, transport {}, {} seeds; the reference has {} wavelengths a path, {} "
        "samples a pixel and another seed. Error: CIEDE2000 of each pixel against the reference, "
        "averaged; white is that of sRGB (D65) at the luminance that 99 % of the reference's "
        "pixels stay below; the reference's own noise is not taken off. 1 wavelength is a tracer "
        "of "
        "its own on plain floats.",
        subject.scene.film.width, subject.scene.film.height, transport_name(transport), seeds,
        spectral_bins, halves.samples);
    if (subject.light) {
        chart.caption +=
            " RGB: three channels of one packet of four, lights white, the picture times the "
            "light's colour.";
    }
    add_findings(subject, &e);
    return e;
}

// What decides how many wavelengths a light needs.
BenchTable phase_table() {
    BenchTable table;
    table.id = "wavelengths-phases";
    table.caption =
        "Standard deviation of the colour of a light over the phases of a path's wavelengths, "
        "relative to the colour.";
    table.columns = {"light"};
    for (const int count : counts) table.columns.push_back(method_name(count));
    for (const ChartIlluminant& light : chart_illuminants()) {
        std::vector<std::string> row = {light.name};
        for (const int count : counts) {
            row.push_back(fmt::format("{:.3g}", phase_noise(light.spectrum, count)));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

BenchResult run(const BenchOptions& options) {
    const std::vector<Subject> all = subjects(options.quick);
    const int seeds = options.seeds > 0 ? options.seeds : (options.quick ? 2 : 4);
    size_t steps = 0;
    for (const Subject& s : all) {
        steps += 1 + (std::size(counts) + (s.light ? 3 : 0)) * s.samples.size() *
                         static_cast<size_t>(seeds);
    }
    Progress progress("wavelengths", steps, options.quiet);
    BenchResult result;
    BenchTable table;
    table.id = "wavelengths-summary";
    table.caption =
        "Wavelengths a path: mean Delta E 2000 with the most samples, and in parentheses the time "
        "for the error that 8 wavelengths have.";
    table.columns = {"scene", "spp", "auto"};
    for (const int count : counts) table.columns.push_back(method_name(count));
    for (const Subject& subject : all) {
        Experiment e = experiment(subject, seeds, &progress);
        std::vector<std::string> row = {subject.title, fmt::format("{}", subject.samples.back()),
                                        fmt::format("{}", e.automatic)};
        for (const int count : counts) {
            if (!has_curve(e.chart, count)) {
                row.emplace_back();
                continue;
            }
            const ChartCurve& curve = curve_of(e.chart, count);
            row.push_back(fmt::format("{:.3g} ({:.2f})", curve.points.back().error,
                                      time_ratio(curve, curve_of(e.chart, 8))));
        }
        table.rows.push_back(std::move(row));
        result.charts.push_back(std::move(e.chart));
    }
    result.tables.push_back(std::move(table));
    result.tables.push_back(phase_table());
    result.tables.push_back(rgb_error_table());
    return result;
}

}  // namespace

BenchItem wavelength_item() {
    return {"wavelengths", "Wavelengths a path, and spectra against RGB",
            "1 to 40 wavelengths, and metals in three channels: Delta E 2000 against time", run};
}

}  // namespace drude
