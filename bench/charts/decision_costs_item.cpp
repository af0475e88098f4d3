// What --explain says models cost, measured.
#include <fmt/format.h>

#include <random>

#include "base/progress.h"
#include "bench/charts/defaults_item.h"
#include "bench/charts/experiment.h"
#include "materials/film_stack.h"
#include "materials/film_table.h"
#include "render/batch_tracer.h"
#include "render/decision_costs.h"
#include "render/transport_choice.h"

namespace drude {

namespace {

constexpr int widths[] = {4, 8, 16, spectral_bins};
constexpr Transport transports[] = {Transport::scalar, Transport::intensity, Transport::stokes};

// Seconds of the samples alone: what a render takes beside them is taken off.
double sample_seconds(const Scene& scene, Transport transport, int wavelengths, int samples) {
    const auto seconds = [&](int spp) {
        RenderOptions options;
        options.transport = transport;
        options.wavelengths = wavelengths;
        options.samples_per_pixel = spp;
        options.threads = 1;
        options.quiet = true;
        const double start = thread_seconds();
        render(scene, options);
        return thread_seconds() - start;
    };
    return seconds(samples) - seconds(1);
}

BenchTable transport_table(const BenchOptions& options) {
    const int size = options.quick ? 16 : 40, samples = options.quick ? 33 : 65;
    const int rounds = options.seeds > 0 ? options.seeds : options.quick ? 1 : 3;
    const std::vector<std::string> names = {"half-sphere", "cornell-metals", "two-metals"};
    std::vector<Scene> scenes;
    for (const std::string& name : names) scenes.push_back(small_scene(name, size));
    struct Task {
        size_t scene, transport, width;
    };
    std::vector<Task> tasks;
    for (size_t s = 0; s < scenes.size(); ++s) {
        for (size_t t = 0; t < 3; ++t) {
            for (size_t w = 0; w < 4; ++w) tasks.push_back({s, t, w});
        }
    }
    std::vector<double> seconds[3][3][4];
    std::mt19937_64 random(2);
    Progress progress("costs", tasks.size() * static_cast<size_t>(rounds), options.quiet);
    for (int round = 0; round < rounds; ++round) {
        for (size_t i = tasks.size(); i > 1; --i) std::swap(tasks[i - 1], tasks[random() % i]);
        for (const Task& task : tasks) {
            seconds[task.scene][task.transport][task.width].push_back(sample_seconds(
                scenes[task.scene], transports[task.transport], widths[task.width], samples));
            progress.step();
        }
    }
    BenchTable table;
    table.id = "decision-costs";
    table.caption = fmt::format(
        "Processor time of a sample over that of scalar transport with 8 wavelengths: medians of "
        "{} shuffled rounds, half-sphere, box of metals, two metals ({} pixels on the longer "
        "side), their median, and what --explain states.",
        rounds, size);
    table.columns = {"transport",  "wavelengths", "half-sphere", "cornell-metals",
                     "two-metals", "median",      "stated"};
    for (size_t t = 0; t < 3; ++t) {
        for (size_t w = 0; w < 4; ++w) {
            std::vector<double> ratios;
            std::vector<std::string> row = {std::string(transport_name(transports[t])),
                                            fmt::format("{}", widths[w])};
            for (auto& scene : seconds) {
                ratios.push_back(median(scene[t][w]) / median(scene[0][1]));
                row.push_back(fmt::format("{:.2f}", ratios.back()));
            }
            row.push_back(fmt::format("{:.2f}", median(ratios)));
            row.push_back(fmt::format("{:.2f}", transport_cost(transports[t]) *
                                                    wavelengths_cost(transports[t], widths[w])));
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

// Nanoseconds of one call; the sum of what it returns keeps it from being left out.
template <class Call>
double nanoseconds(int calls, const Call& call) {
    std::vector<double> rounds;
    volatile float sink = 0;
    for (int round = 0; round < 7; ++round) {
        Packet<8> total(0.0f);
        const double start = thread_seconds();
        for (int i = 0; i < calls; ++i) {
            const Reflection<Packet<8>> r =
                call(0.02f + 0.96f * static_cast<float>(i % 997) / 997.0f, i % 50);
            total += r.Rs + r.Rp + r.C + r.S;
        }
        rounds.push_back((thread_seconds() - start) * 1e9 / calls);
        sink = sink + sum(total);
    }
    return median(rounds);
}

BenchTable reflection_table(const BenchOptions& options) {
    using P = Packet<8>;
    const int calls = options.quick ? 100000 : 2000000;
    Material material = find_material("Cu-McPeak");
    material.layers = {{published_set("Al2O3-Malitson-o"), 60, 0}};
    const FilmTable films(material, 8);
    const P n(0.3f), k(3.0f), film(1.77f), zero(0.0f), nm(550.0f), thickness(60.0f);
    const double bare = nanoseconds(calls, [&](float cosine, int phase) {
        return reflect(ComplexIndex<P>{n + P(1e-3f * static_cast<float>(phase)), k}, P(cosine));
    });
    const double looked_up =
        nanoseconds(calls, [&](float cosine, int phase) { return films.at<8>(cosine, phase); });
    const double formula = nanoseconds(calls, [&](float cosine, int phase) {
        const ThinFilm<P> layer{{film, zero}, thickness + P(static_cast<float>(phase))};
        return reflect(&layer, 1, ComplexIndex<P>{n, k}, P(cosine), nm);
    });
    BenchTable table;
    table.id = "reflection-costs";
    table.caption =
        "Nanoseconds of one reflection at 8 wavelengths, in single precision: off bare metal by "
        "formula, off a film of 60 nm from its table, off the same by formula without averages.";
    table.columns = {"reflection", "ns", "stated"};
    const auto row = [&](const char* name, double measured, double stated) {
        table.rows.push_back({name, fmt::format("{:.1f}", measured), fmt::format("{:g}", stated)});
    };
    row("bare metal, formula", bare, bare_ns);
    row("film, table", looked_up, film_table_ns);
    row("film, formula", formula, film_formula_ns);
    return table;
}

}  // namespace

BenchResult run_decision_costs(const BenchOptions& options) {
    BenchResult result;
    result.tables = {transport_table(options), reflection_table(options)};
    return result;
}

}  // namespace drude
