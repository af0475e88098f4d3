// Speed against accuracy: what a method costs and how wrong it is, one curve a method.
#pragma once

#include <string>
#include <vector>

namespace drude {

struct ChartPoint {
    std::string setting;     // "64 spp"
    double cost = 0;         // > 0, in the unit of Chart::cost; the median over the runs
    double error = 0;        // >= 0, against the chart's reference; the mean over the seeds
    double error_sigma = 0;  // standard deviation of that mean; 0 where nothing is random
    bool automatic = false;  // what the program picks when nothing is asked for
    std::string note;        // what else is to be known of this point
};

struct ChartCurve {
    std::string method;
    std::vector<ChartPoint> points;  // in the order the line is drawn
    bool joined = true;              // by a line; not where each point is another thing
};

struct Chart {
    std::string id;  // "transport-half-sphere": of its files and in its page; a-z 0-9 -
    std::string title;
    std::string cost;     // label of the axis with its unit: "processor time (s)"
    std::string error;    // "relative error of S0"
    std::string caption;  // scene, reference, seeds: what a reader needs to make it again
    bool is_cost = true;  // the x axis; of a parameter there is no front
    std::vector<ChartCurve> curves;
    std::vector<std::string> findings;  // sentences with figures, each computed from the points
};

// The points that no other point of the chart beats in both cost and error, by rising cost.
// Points whose cost is not > 0 or whose error is not a finite number >= 0 take no part.
std::vector<ChartPoint> pareto_front(const Chart& chart);

// Slope of log(error) against log(cost) by least squares; NaN with fewer than two points of
// positive cost and error.
double log_slope(const ChartCurve& curve);

// Log-log; curves with error bars, the front as a grey line beneath them, a ring around what is
// automatic. An error of exactly 0 cannot be drawn and is named beneath the plot.
std::string chart_svg(const Chart& chart);

// Columns chart, method, setting, cost, error, error_sigma, automatic, pareto, note; numbers with
// round-trip precision.
std::string chart_csv(const Chart& chart);

// A row of such a table, with the chart that it belongs to.
struct MeasuredPoint {
    std::string chart, method;
    ChartPoint point;
};

// What another program measured, in the format of chart_csv. Throws Error (user) with file and line
// for other columns and for a number that is none.
std::vector<MeasuredPoint> read_points(const std::string& path);

// Adds those that name this chart, each to the curve of its method, which is made where it is
// missing.
void add_points(const std::vector<MeasuredPoint>& points, Chart* chart);

}  // namespace drude
