#include "bench/charts/bench_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/files.h"
#include "bench/charts/csv.h"
#include "bench/charts/machine.h"
#include "report/page.h"

namespace drude {

namespace {

std::string number(double value) {
    return std::isfinite(value) ? fmt::format("{:.4g}", value) : "–";
}

void show(const Chart& chart, Page* page) {
    page->heading(chart.title);
    page->svg(chart_svg(chart), chart.caption);
    page->list(chart.findings);
    PageTable table;
    table.columns = {"method", "setting", chart.cost, chart.error, "± of it", "", "note"};
    table.numeric = {false, false, true, true, true, false, false};
    for (const ChartCurve& curve : chart.curves) {
        for (const ChartPoint& p : curve.points) {
            table.rows.push_back({curve.method, p.setting, number(p.cost), number(p.error),
                                  p.error_sigma > 0 ? number(p.error_sigma) : "",
                                  p.automatic ? "default" : "", p.note});
        }
    }
    page->details("All points", table);
}

std::string verdict_sentence(const StabilityMap& map) {
    const MapVerdict verdict = judge(map);
    std::string text =
        fmt::format("Domain: {}. Largest error within it {:.3g} (at {}), bound {:.3g}: {}.",
                    map.domain, verdict.worst_inside, verdict.worst_at, map.bound,
                    verdict.worst_inside <= map.bound ? "kept" : "NOT kept");
    if (verdict.refused_inside > 0) {
        text += fmt::format(" {} cells within it are REFUSED.", verdict.refused_inside);
    }
    if (verdict.silent_outside > 0) {
        text += fmt::format(" {} cells outside are worse than the bound and NOTHING is said.",
                            verdict.silent_outside);
    }
    return map.outside.empty() ? text : text + " Outside: " + map.outside + ".";
}

void show(const StabilityMap& map, Page* page) {
    page->heading(map.title);
    page->svg(map_svg(map), map.caption);
    const std::string sentence = verdict_sentence(map);
    if (judge(map).holds(map)) {
        page->paragraph(sentence);
    } else {
        page->note(sentence);
    }
}

void show(const BenchTable& table, Page* page) {
    PageTable shown;
    shown.caption = table.caption;
    shown.columns = table.columns;
    shown.rows = table.rows;
    for (size_t c = 0; c < table.columns.size(); ++c) {
        bool numeric = !table.rows.empty();
        for (const auto& row : table.rows) {
            const char first = c < row.size() && !row[c].empty() ? row[c][0] : ' ';
            numeric &= (first >= '0' && first <= '9') || first == '-' || first == ' ';
        }
        shown.numeric.push_back(numeric);
    }
    page->table(shown);
}

// On its own a plot takes black or white for its text by the reader's preference.
std::string standalone(std::string svg) {
    svg.insert(svg.find('>') + 1,
               "<style>svg{color:#111}@media(prefers-color-scheme:dark){svg{color:#ddd}}</style>");
    return svg;
}

}  // namespace

std::string bench_page(const std::vector<BenchSection>& sections) {
    Page page("Speed against accuracy");
    page.banner("drude " DRUDE_VERSION,
                "What every method costs and how wrong it is, where methods stay stable, and what "
                "the defaults leave out.");
    page.section("Machine", "machine");
    page.facts(machine_facts());
    for (const BenchSection& section : sections) {
        page.section(section.title, section.name);
        page.paragraph(fmt::format("{} Measured in {:.0f} s: drude bench {}", section.summary,
                                   section.seconds, section.name));
        for (const Chart& chart : section.result.charts) show(chart, &page);
        for (const StabilityMap& map : section.result.maps) show(map, &page);
        for (const BenchTable& table : section.result.tables) show(table, &page);
    }
    return page.html();
}

std::vector<std::string> write_bench_files(const std::string& folder, const BenchResult& result) {
    make_folder(folder);
    std::vector<std::string> files;
    const auto write = [&](const std::string& name, const std::string& text) {
        if (std::find(files.begin(), files.end(), name) != files.end()) {
            throw std::logic_error("two results are called " + name);
        }
        write_file(folder + "/" + name, text);
        files.push_back(name);
    };
    for (const Chart& chart : result.charts) {
        write(chart.id + ".csv", chart_csv(chart));
        write(chart.id + ".svg", standalone(chart_svg(chart)));
    }
    for (const StabilityMap& map : result.maps) {
        write(map.id + ".csv", map_csv(map));
        write(map.id + ".svg", standalone(map_svg(map)));
    }
    for (const BenchTable& table : result.tables) {
        std::string text = csv_line(table.columns);
        for (const auto& row : table.rows) text += csv_line(row);
        write(table.id + ".csv", text);
    }
    return files;
}

}  // namespace drude
