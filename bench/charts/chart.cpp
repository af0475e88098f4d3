#include "bench/charts/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/error.h"
#include "base/files.h"
#include "base/numbers.h"
#include "bench/charts/csv.h"
#include "report/svg_plot.h"

namespace drude {

namespace {

constexpr int front_colour = 7;  // the palette's grey

const std::vector<std::string>& columns() {
    static const std::vector<std::string> all = {"chart",     "method", "setting",
                                                 "cost",      "error",  "error_sigma",
                                                 "automatic", "pareto", "note"};
    return all;
}

bool takes_part(const ChartPoint& p) {
    return p.cost > 0 && std::isfinite(p.cost) && p.error >= 0 && std::isfinite(p.error);
}

bool beats(const ChartPoint& a, const ChartPoint& b) {
    return a.cost <= b.cost && a.error <= b.error && (a.cost < b.cost || a.error < b.error);
}

bool is_on_front(const Chart& chart, const ChartPoint& point) {
    if (!takes_part(point)) return false;
    for (const ChartCurve& curve : chart.curves) {
        for (const ChartPoint& other : curve.points) {
            if (takes_part(other) && beats(other, point)) return false;
        }
    }
    return true;
}

Series front_line(const Chart& chart) {
    Series front;
    front.name = "Pareto front";
    front.colour = front_colour;
    front.width = 7;
    front.opacity = 0.22;
    for (const ChartPoint& p : pareto_front(chart)) {
        if (!(p.error > 0)) continue;
        // Between two points one has the nearer cheaper one's error: a stair, not a slope.
        if (!front.x.empty()) {
            front.x.push_back(p.cost);
            front.y.push_back(front.y.back());
        }
        front.x.push_back(p.cost);
        front.y.push_back(p.error);
    }
    return front;
}

}  // namespace

std::vector<ChartPoint> pareto_front(const Chart& chart) {
    std::vector<ChartPoint> front;
    for (const ChartCurve& curve : chart.curves) {
        for (const ChartPoint& p : curve.points) {
            if (is_on_front(chart, p)) front.push_back(p);
        }
    }
    std::stable_sort(front.begin(), front.end(), [](const ChartPoint& a, const ChartPoint& b) {
        return a.cost < b.cost || (a.cost == b.cost && a.error > b.error);
    });
    return front;
}

double log_slope(const ChartCurve& curve) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (const ChartPoint& p : curve.points) {
        if (!takes_part(p) || p.error == 0) continue;
        const double x = std::log(p.cost), y = std::log(p.error);
        n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    const double spread = n * sxx - sx * sx;
    if (n < 2 || !(spread > 1e-12 * n * sxx)) return std::numeric_limits<double>::quiet_NaN();
    return (n * sxy - sx * sy) / spread;
}

std::string chart_svg(const Chart& chart) {
    Plot plot;
    plot.title = chart.title;
    plot.description = chart.caption;
    plot.id = chart.id;
    plot.width = 640;
    plot.height = 400;
    plot.x = {chart.cost, true, {}, {}};
    double cheapest = std::numeric_limits<double>::infinity(), dearest = 0;
    for (const ChartCurve& curve : chart.curves) {
        for (const ChartPoint& p : curve.points) {
            if (!takes_part(p)) continue;
            cheapest = std::min(cheapest, p.cost);
            dearest = std::max(dearest, p.cost);
        }
    }
    if (dearest > 0) {  // room for the rings and bars of the outermost points
        const double margin = std::pow(dearest / cheapest, 0.03) * 1.01;
        plot.x.low = cheapest / margin;
        plot.x.high = dearest * margin;
    }
    plot.y = {chart.error, true, {}, {}};
    if (chart.is_cost) plot.series.push_back(front_line(chart));
    Series rings;
    rings.name = "what is picked by default";
    rings.mark = Mark::rings;
    rings.width = 7.5;
    rings.colour = front_colour;
    std::string exact;
    int colour = 0;
    for (const ChartCurve& curve : chart.curves) {
        Series line, points;
        (curve.joined ? line : points).name = curve.method;
        line.colour = points.colour = colour++ % front_colour;
        line.dashed = colour > front_colour;
        points.mark = Mark::points;
        points.width = 3;
        for (const ChartPoint& p : curve.points) {
            if (takes_part(p) && p.error == 0) {
                exact +=
                    fmt::format("{}{} ({})", exact.empty() ? "" : ", ", curve.method, p.setting);
                continue;
            }
            line.x.push_back(p.cost);
            line.y.push_back(p.error);
            points.error.push_back(p.error_sigma);
            if (p.automatic) {
                rings.x.push_back(p.cost);
                rings.y.push_back(p.error);
            }
        }
        points.x = line.x;
        points.y = line.y;
        if (curve.joined) plot.series.push_back(std::move(line));
        plot.series.push_back(std::move(points));
    }
    if (!exact.empty()) {
        Series words;  // only its name is to be seen
        words.name = "error 0: " + exact;
        words.colour = front_colour;
        words.opacity = 0;
        plot.series.push_back(std::move(words));
    }
    if (!rings.x.empty()) plot.series.push_back(std::move(rings));
    return svg_plot(plot);
}

std::string chart_csv(const Chart& chart) {
    std::string text = csv_line(columns());
    for (const ChartCurve& curve : chart.curves) {
        for (const ChartPoint& p : curve.points) {
            text += csv_line({chart.id, curve.method, p.setting, format_double(p.cost),
                              format_double(p.error), format_double(p.error_sigma),
                              p.automatic ? "1" : "0",
                              chart.is_cost && is_on_front(chart, p) ? "1" : "0", p.note});
        }
    }
    return text;
}

std::vector<MeasuredPoint> read_points(const std::string& path) {
    const std::vector<CsvRecord> records = csv_records(read_file(path), path);
    if (records.empty() || records[0].fields != columns()) {
        user_error_at({path, 1, 0}, "expected the columns {}", [] {
            std::string line = csv_line(columns());
            line.pop_back();
            return line;
        }());
    }
    std::vector<MeasuredPoint> points;
    for (size_t i = 1; i < records.size(); ++i) {
        const auto& [line, fields] = records[i];
        const Place place{path, line, 0};
        if (fields.size() != columns().size()) {
            user_error_at(place, "found {} fields, expected {}", fields.size(), columns().size());
        }
        const auto number = [&, &row = fields](size_t column) {
            const auto value = parse_double(row[column]);
            if (!value) {
                user_error_at(place, "{}: found '{}', expected a number", columns()[column],
                              row[column]);
            }
            return *value;
        };
        MeasuredPoint point;
        point.chart = fields[0];
        point.method = fields[1];
        point.point = {fields[2], number(3), number(4), number(5), fields[6] == "1", fields[8]};
        points.push_back(std::move(point));
    }
    return points;
}

void add_points(const std::vector<MeasuredPoint>& points, Chart* chart) {
    for (const MeasuredPoint& measured : points) {
        if (measured.chart != chart->id) continue;
        auto curve = std::find_if(chart->curves.begin(), chart->curves.end(),
                                  [&](const ChartCurve& c) { return c.method == measured.method; });
        if (curve == chart->curves.end()) {
            chart->curves.push_back({measured.method, {}});
            curve = chart->curves.end() - 1;
        }
        curve->points.push_back(measured.point);
    }
}

}  // namespace drude
