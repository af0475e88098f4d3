#include "bench/charts/transport_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/executor.h"
#include "base/progress.h"
#include "bench/charts/bench_items.h"
#include "bench/charts/chart_scenes.h"
#include "bench/charts/experiment.h"
#include "image/student.h"
#include "render/transport_choice.h"

namespace drude {

namespace {

constexpr Transport transports[] = {Transport::scalar, Transport::intensity, Transport::stokes};
constexpr int wavelengths = 8;
constexpr uint64_t reference_seed = 900001, pair_seed = 1000;

int rows_of(Transport transport) {
    return transport == Transport::stokes ? 4 : 1;
}

struct Subject {
    std::string id, title;
    Scene scene;
    std::vector<int> samples;
    int reference_samples, seeds;
};

std::vector<Subject> subjects(bool quick) {
    const auto pick = [quick](int a, int b) { return quick ? a : b; };
    const std::vector<int> many =
        quick ? std::vector<int>{16, 64} : std::vector<int>{16, 64, 256, 512};
    const std::vector<int> few = quick ? std::vector<int>{16, 64} : std::vector<int>{16, 64, 256};
    const int size = pick(20, 40);
    const auto half_sphere = [size] {
        return half_sphere_in_courtyard(
            size, size,
            "Material \"conductor\" \"string material\" \"Cu\" \"string lobe\" "
            "\"trowbridge-reitz\" \"string masking\" \"v-groove\" \"float beta\" 0.2");
    };
    const int seeds = pick(2, 3);
    std::vector<Subject> all;
    all.push_back({"half-sphere", "a copper half-sphere in the courtyard", half_sphere(), many,
                   pick(512, 4096), seeds});
    all.push_back({"teapot-plaster", "a gold teapot on plaster", teapot_on_plaster(size, size),
                   many, pick(256, 2048), seeds});
    all.push_back({"teapot-metal", "a gold teapot on rough aluminium", teapot_on_metal(size, size),
                   few, pick(256, 2048), seeds});
    all.push_back({"box", "a closed box of metals",
                   chart_scene("cornell-metals", pick(10, 24), pick(10, 24)), few, pick(256, 2048),
                   seeds});
    all.push_back({"polarisers", "pairs of polarisers before a panel",
                   chart_scene("crossed-polarisers", size, size * 3 / 4), many, pick(512, 4096),
                   seeds});
    return all;
}

struct Figures {
    Chart chart;
    TransportBias bias[3];
    double cost[3]{}, error[3]{};  // at the most samples
    double stokes_error[4]{};      // of the rows S0..S3, over S0
    int most = 0;
    Transport automatic = Transport::scalar;
    std::string reason;
};

Chart chart_of(const Subject& subject, const TracedScene& scene, const ReferencePicture& reference,
               Transport automatic, int seeds, Progress* progress) {
    std::vector<Method> methods;
    for (const Transport transport : transports) {
        Method method{std::string(transport_name(transport)), {}};
        for (const int samples : subject.samples) {
            const auto run = [&, transport, samples](uint64_t seed) {
                const auto tracer = make_batch_tracer(transport, wavelengths, scene.setup(seed));
                const TracedPicture picture =
                    trace_picture(*tracer, scene.scene().film, rows_of(transport), samples);
                return Measured{picture.seconds, relative_rmse(picture, reference)};
            };
            method.settings.push_back(
                {fmt::format("{} spp", samples), run, transport == automatic});
        }
        methods.push_back(std::move(method));
    }
    Chart chart;
    chart.id = "transport-" + subject.id;
    chart.title = "Transport: " + subject.title;
    chart.cost = "processor time (s)";
    chart.error = "relative RMSE of S0";
    chart.curves = run_shuffled(methods, seeds, 1, [&] { progress->step(); });
    return chart;
}

std::string caption_of(const Subject& subject, const ReferencePicture& reference, int seeds) {
    return fmt::format(
        "{} x {} pixels, {} wavelengths a path, {} seeds; the reference is stokes with {} samples "
        "a pixel of another seed. Error: root of the mean over the pixels of the squared error of "
        "R, G, B of S0 over R^2 + G^2 + B^2 + (a tenth of the mean length)^2, without the "
        "reference's own noise. Processor time of one thread.",
        subject.scene.film.width, subject.scene.film.height, wavelengths, seeds, reference.samples);
}

std::string signed_percent(double value, double sigma) {
    return fmt::format("{:+.3g} +- {:.2g} %", 100 * value, 100 * sigma);
}

void add_findings(const Figures& f, Chart* chart) {
    chart->findings.push_back(
        fmt::format("With {} samples a pixel intensity costs {:.2f} and stokes {:.2f} times the "
                    "processor time of scalar.",
                    f.most, f.cost[1] / f.cost[0], f.cost[2] / f.cost[0]));
    chart->findings.push_back(
        fmt::format("auto takes {}: {}.", transport_name(f.automatic), f.reason));
    const TransportBias& bias = f.bias[0];
    if (bias.is_exact()) {
        chart->findings.push_back(
            bias.largest > 0
                ? fmt::format("scalar is exact here: with the same samples no pixel differs from "
                              "stokes by more than {:.1e} of the picture's mean.",
                              bias.largest)
                : std::string("scalar is exact here: with the same samples every pixel has the "
                              "value that stokes gives it, to the bit."));
        return;
    }
    chart->findings.push_back(fmt::format(
        "scalar leaves the picture's mean off by {}{}.", signed_percent(bias.mean, bias.sigma),
        std::abs(bias.mean) < bias.chance * bias.sigma ? ", which may be chance" : ""));
    if (!(bias.rms > 0)) {
        chart->findings.emplace_back("What scalar does to single pixels is lost in their noise.");
        return;
    }
    // Noise falls as one over the root of the samples; here it meets the bias.
    chart->findings.emplace_back(
        fmt::format("Pixels are off by {:.3g} % (root mean square), as much as the noise of {:.2g} "
                    "samples a pixel.",
                    100 * bias.rms, f.most * std::pow(f.error[1] / bias.rms, 2)));
}

Figures figures_of(const Subject& subject, int seeds, Progress* progress) {
    const TracedScene scene(subject.scene);
    const auto exact =
        make_batch_tracer(Transport::stokes, wavelengths, scene.setup(reference_seed));
    const ReferencePicture reference =
        trace_reference(*exact, scene.scene().film, 4, subject.reference_samples);
    progress->step();
    Figures f;
    const TransportChoice choice = automatic_transport(scene.scene());
    f.automatic = choice.transport;
    f.reason = choice.reason;
    f.most = subject.samples.back();
    f.chart = chart_of(subject, scene, reference, choice.transport, seeds, progress);
    f.chart.caption = caption_of(subject, reference, seeds);
    for (size_t t = 0; t < 3; ++t) {
        f.bias[t] = transport_bias(scene, transports[t], subject.samples.back(), std::max(seeds, 2),
                                   pair_seed, reference);
        f.cost[t] = f.chart.curves[t].points.back().cost;
        f.error[t] = f.chart.curves[t].points.back().error;
        progress->step();
    }
    const auto tracer = make_batch_tracer(Transport::stokes, wavelengths, scene.setup(pair_seed));
    const TracedPicture picture =
        trace_picture(*tracer, scene.scene().film, 4, subject.samples.back());
    for (int row = 0; row < 4; ++row) {
        f.stokes_error[row] = relative_rmse(picture, reference, row);
    }
    add_findings(f, &f.chart);
    return f;
}

std::vector<std::vector<std::string>> rows_of_table(const Subject& subject, const Figures& f) {
    std::vector<std::vector<std::string>> rows;
    for (size_t t = 0; t < 3; ++t) {
        const TransportBias& bias = f.bias[t];
        std::string stokes = "not carried";
        if (transports[t] == Transport::stokes) {
            stokes = fmt::format("{:.3g}, {:.3g}, {:.3g}", f.stokes_error[1], f.stokes_error[2],
                                 f.stokes_error[3]);
        }
        rows.push_back({subject.title, std::string(transport_name(transports[t])),
                        transports[t] == f.automatic ? "auto" : "", fmt::format("{}", f.most),
                        fmt::format("{:.3g}", f.cost[t]),
                        fmt::format("{:.2f}", f.cost[t] / f.cost[0]),
                        fmt::format("{:.3g}", f.error[t]),
                        bias.is_exact() ? "0" : signed_percent(bias.mean, bias.sigma),
                        fmt::format("{:.3g}", bias.is_exact() ? 0 : 100 * bias.rms), stokes});
    }
    return rows;
}

BenchResult run(const BenchOptions& options) {
    const std::vector<Subject> all = subjects(options.quick);
    size_t steps = 0;
    for (const Subject& s : all) {
        const int seeds = options.seeds > 0 ? options.seeds : s.seeds;
        steps += 4 + 3 * s.samples.size() * static_cast<size_t>(seeds);
    }
    Progress progress("transport", steps, options.quiet);
    BenchResult result;
    BenchTable table;
    table.id = "transport-summary";
    table.caption =
        "Cost, error and bias of the transports; bias is that of the picture's mean and of its "
        "pixels (root mean square) against stokes with the same samples; errors of S1, S2, S3 are "
        "over S0.";
    table.columns = {"scene",         "transport",          "choice",      "spp",
                     "time (s)",      "of scalar",          "error of S0", "bias of the mean",
                     "of pixels (%)", "error of S1, S2, S3"};
    for (const Subject& subject : all) {
        const int seeds = options.seeds > 0 ? options.seeds : subject.seeds;
        Figures f = figures_of(subject, seeds, &progress);
        for (auto& row : rows_of_table(subject, f)) table.rows.push_back(std::move(row));
        result.charts.push_back(std::move(f.chart));
    }
    result.tables.push_back(std::move(table));
    return result;
}

}  // namespace

TransportBias transport_bias(const TracedScene& scene, Transport transport, int samples, int seeds,
                             uint64_t first_seed, const ReferencePicture& reference) {
    const Film& film = scene.scene().film;
    // Differences of either half of the seeds, on top of the reference's halves: their product has
    // no noise in common.
    TracedPicture half[2] = {reference.first, reference.second};
    const int in_half[2] = {(seeds + 1) / 2, seeds / 2};
    std::vector<double> shift;
    TransportBias bias;
    for (int s = 0; s < seeds; ++s) {
        TracedPicture pair[2];
        const Transport kinds[2] = {transport, Transport::stokes};
        parallel_for(2, 0, [&](size_t i) {
            const auto tracer = make_batch_tracer(
                kinds[i], wavelengths, scene.setup(first_seed + static_cast<uint64_t>(s)));
            pair[i] = trace_picture(*tracer, film, rows_of(kinds[i]), samples);
        });
        const double mean = mean_value(pair[1]);
        shift.push_back((mean_value(pair[0]) - mean) / mean);
        TracedPicture& sum = half[s % 2];
        for (size_t p = 0; p < sum.pixels(); ++p) {
            for (size_t c = 0; c < 3; ++c) {
                const double difference = pair[0].at(p)[c] - pair[1].at(p)[c];
                bias.largest = std::max(bias.largest, std::abs(difference) / mean);
                sum.values[p * static_cast<size_t>(sum.rows) * 3 + c] +=
                    difference / in_half[s % 2];
            }
        }
    }
    for (const double s : shift) bias.mean += s / seeds;
    bias.chance = student_quantile(0.0027, seeds - 1);
    double squares = 0;
    for (const double s : shift) squares += (s - bias.mean) * (s - bias.mean);
    bias.sigma = std::sqrt(squares / (static_cast<double>(seeds) * (seeds - 1)));
    bias.rms = std::sqrt(std::max(0.0, relative_product(half[0], half[1], reference)));
    return bias;
}

BenchItem transport_item() {
    return {"transport", "Transport: one number, a row or a matrix a wavelength",
            "scalar, intensity and stokes: error of S0 against time on five scenes", run};
}

}  // namespace drude
