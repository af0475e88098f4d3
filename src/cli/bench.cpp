// drude bench: speed against accuracy and stability, as CSV, SVG and one page.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "base/error.h"
#include "base/files.h"
#include "bench/charts/bench_items.h"
#include "bench/charts/bench_page.h"
#include "cli/command_list.h"
#include "cli/json_output.h"

namespace drude {

namespace {

using Json = nlohmann::ordered_json;

struct Options {
    std::vector<std::string> items, with;
    std::string output;
    bool quick = false, list = false;
    int seeds = 0;
};

std::vector<const BenchItem*> chosen_items(const std::vector<std::string>& names) {
    std::vector<const BenchItem*> chosen;
    for (const std::string& name : names) {
        std::string known;
        const BenchItem* found = nullptr;
        for (const BenchItem& item : bench_items()) {
            known += (known.empty() ? "" : ", ") + item.name;
            if (item.name == name) found = &item;
        }
        if (!found) user_error("found '{}', expected some of {}", name, known);
        chosen.push_back(found);
    }
    if (!names.empty()) return chosen;
    for (const BenchItem& item : bench_items()) chosen.push_back(&item);
    return chosen;
}

// What other programs measured joins the charts of the same id; what is left makes its own.
void join(std::vector<MeasuredPoint>* points, BenchResult* result) {
    for (Chart& chart : result->charts) {
        add_points(*points, &chart);
        points->erase(std::remove_if(points->begin(), points->end(),
                                     [&](const MeasuredPoint& p) { return p.chart == chart.id; }),
                      points->end());
    }
}

BenchSection section_of(const std::vector<MeasuredPoint>& points) {
    BenchSection section{"peers", "Other programs", "What other programs measured here.", {}, 0};
    for (const MeasuredPoint& point : points) {
        auto& charts = section.result.charts;
        if (std::none_of(charts.begin(), charts.end(),
                         [&](const Chart& c) { return c.id == point.chart; })) {
            Chart chart;
            chart.id = chart.title = point.chart;
            chart.cost = "time (s)";
            chart.error = "error, as the script defines it";
            add_points(points, &chart);
            charts.push_back(std::move(chart));
        }
    }
    return section;
}

bool all_hold(const BenchResult& result) {
    return std::all_of(result.maps.begin(), result.maps.end(),
                       [](const StabilityMap& map) { return judge(map).holds(map); });
}

Json to_json(const BenchSection& section, const std::vector<std::string>& files) {
    Json json = {{"item", section.name},
                 {"seconds", section.seconds},
                 {"files", files},
                 {"findings", Json::array()},
                 {"maps", Json::array()}};
    for (const Chart& chart : section.result.charts) {
        for (const std::string& finding : chart.findings) {
            json["findings"].push_back({{"chart", chart.id}, {"text", finding}});
        }
    }
    for (const StabilityMap& map : section.result.maps) {
        const MapVerdict verdict = judge(map);
        json["maps"].push_back({{"map", map.id},
                                {"holds", verdict.holds(map)},
                                {"worst", verdict.worst_inside},
                                {"worst_at", verdict.worst_at},
                                {"bound", map.bound},
                                {"domain", map.domain}});
    }
    return json;
}

void print(const BenchSection& section) {
    fmt::print("{} ({:.1f} s)\n", section.title, section.seconds);
    for (const Chart& chart : section.result.charts) {
        fmt::print("  {}\n", chart.title);
        for (const std::string& finding : chart.findings) fmt::print("    {}\n", finding);
    }
    for (const StabilityMap& map : section.result.maps) {
        const MapVerdict verdict = judge(map);
        fmt::print("  {}: {}, largest error {:.3g} of {:.3g} allowed\n", map.title,
                   verdict.holds(map) ? "holds" : "DOES NOT HOLD", verdict.worst_inside, map.bound);
    }
    for (const BenchTable& table : section.result.tables) fmt::print("  {}\n", table.caption);
}

int list(bool json) {
    if (json) {
        Json document = Json::array();
        for (const BenchItem& item : bench_items()) {
            document.push_back({{"item", item.name}, {"summary", item.summary}});
        }
        print_json_document(document);
        return 0;
    }
    for (const BenchItem& item : bench_items()) fmt::print("{:<12} {}\n", item.name, item.summary);
    return 0;
}

int run(const Options& options, const CommonOptions& common) {
    if (options.list) return list(common.json);
    if (options.output.empty()) user_error("expected --output FOLDER, where the page is written");
    if (options.seeds < 0) user_error("--seeds: found {}, expected 1 or more", options.seeds);
    const std::vector<const BenchItem*> items = chosen_items(options.items);
    std::vector<MeasuredPoint> points;
    for (const std::string& path : options.with) {
        const std::vector<MeasuredPoint> more = read_points(path);
        points.insert(points.end(), more.begin(), more.end());
    }
    std::vector<BenchSection> sections;
    Json document = {{"folder", options.output}, {"items", Json::array()}};
    bool hold = true;
    const auto finish = [&](BenchSection section) {
        const std::vector<std::string> files = write_bench_files(options.output, section.result);
        hold = hold && all_hold(section.result);
        if (!common.json) print(section);
        document["items"].push_back(to_json(section, files));
        sections.push_back(std::move(section));
        // After each item: what is measured stays, whatever happens to the next.
        write_file(options.output + "/index.html", bench_page(sections));
    };
    for (const BenchItem* item : items) {
        const auto begun = std::chrono::steady_clock::now();
        BenchSection section{item->name, item->title, item->summary, {}, 0};
        section.result = item->run({options.quick, options.seeds, common.quiet});
        section.seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
        join(&points, &section.result);
        finish(std::move(section));
    }
    if (!points.empty()) finish(section_of(points));
    if (common.json) print_json_document(document);
    return hold ? 0 : 1;
}

}  // namespace

Command bench_command() {
    Command command;
    command.name = "bench";
    command.summary = "Chart speed against accuracy, and map where methods stay stable";
    command.description =
        "Measures on this machine and writes, into FOLDER, a CSV and an SVG for every chart and "
        "map, and index.html with all of them.\n\n"
        "A chart shows what each method costs (processor time of one thread, medians, in shuffled "
        "order) and how wrong it is against a converged reference, with error bars over seeds, the "
        "Pareto front and a ring around what is picked by default. A map shows the error of the "
        "fast path against double precision over the parameters where methods break, the domain "
        "within which a bound is kept, and where the program refuses to answer; the exit status "
        "is 1 where a map's domain does not hold.\n\n"
        "--with adds what other programs measured to the charts they belong to: CSV files that "
        "the scripts of bench/peers write. Points of a chart that is not measured here make one of "
        "their own, their cost in seconds.";
    command.example =
        "drude bench --list\n"
        "drude bench fresnel -o bench-out --quick\n"
        "drude bench -o bench-out";
    command.declare = [](OptionSet& set, const CommonOptions& common) {
        const auto options = std::make_shared<Options>();
        set.positionals("ITEM", options->items, "what to measure; everything by default", 0);
        set.option("-o,--output", options->output, "the folder to write");
        set.flag("--quick", options->quick, "seconds instead of minutes, with rougher figures");
        set.option("--seeds", options->seeds, "runs a point (default: each item's own number)");
        set.option("--with", options->with, "a CSV of points measured by other programs");
        set.flag("--list", options->list, "name the items and end");
        return [options, &common] { return run(*options, common); };
    };
    return command;
}

}  // namespace drude
