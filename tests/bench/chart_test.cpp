#include "bench/charts/chart.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/expect_error.h"
#include "base/files.h"
#include "bench/charts/csv.h"
#include "bench/charts/experiment.h"
#include "temporary_folder.h"

namespace drude {
namespace {

Chart two_methods() {
    Chart chart;
    chart.id = "one";
    chart.title = "One & two";
    chart.cost = "time (s)";
    chart.error = "relative error";
    chart.curves = {
        {"slow, exact", {{"4", 4, 1e-3, 1e-4, false, ""}, {"8", 8, 0, 0, false, ""}}},
        {"fast", {{"1", 1, 1e-1, 0, true, "a \"note\""}, {"2", 2, 2e-1, 0, false, ""}}}};
    return chart;
}

TEST(Chart, TheFrontIsWhatNothingBeats) {
    const std::vector<ChartPoint> front = pareto_front(two_methods());
    ASSERT_EQ(front.size(), 3U);
    EXPECT_EQ(front[0].setting, "1");  // "2" costs more and is worse
    EXPECT_EQ(front[1].setting, "4");
    EXPECT_EQ(front[2].setting, "8");
    Chart broken = two_methods();
    broken.curves[0].points[0].error = std::nan("");
    broken.curves[0].points[1].cost = 0;
    EXPECT_EQ(pareto_front(broken).size(), 1U);
}

TEST(Chart, SlopesAreThoseOfPowerLaws) {
    ChartCurve curve{"monte carlo", {}};
    for (const double n : {16.0, 64.0, 1024.0})
        curve.points.push_back({"", n, 3 / std::sqrt(n), 0, false, ""});
    EXPECT_NEAR(log_slope(curve), -0.5, 1e-12);
    curve.points.resize(1);
    EXPECT_TRUE(std::isnan(log_slope(curve)));
    curve.points.push_back(curve.points[0]);
    EXPECT_TRUE(std::isnan(log_slope(curve))) << "two points of one cost have no slope";
}

TEST(Chart, ItsTableComesBackWhole) {
    const TemporaryFolder folder;
    const std::string path = folder.file("points.csv");
    const Chart chart = two_methods();
    write_file(path, chart_csv(chart));
    const std::vector<MeasuredPoint> points = read_points(path);
    Chart copy = chart;
    copy.curves.clear();
    add_points(points, &copy);
    EXPECT_EQ(chart_csv(copy), chart_csv(chart));
    EXPECT_EQ(copy.curves[1].points[0].note, "a \"note\"");
    Chart other = chart;
    other.id = "another";
    add_points(points, &other);
    EXPECT_EQ(other.curves[0].points.size(), 2U);
}

TEST(Chart, ATableOfAnotherKindIsRefusedByLine) {
    const TemporaryFolder folder;
    const std::string path = folder.file("points.csv");
    write_file(path, "a,b\n1,2\n");
    expect_error(Cause::user, {"points.csv:1", "chart,method,setting"}, [&] { read_points(path); });
    const std::string head = chart_csv({});
    write_file(path, head + "one,fast,1,x,1,0,0,0,\n");
    expect_error(Cause::user, {"points.csv:2", "cost: found 'x'"}, [&] { read_points(path); });
    write_file(path, head + "\none,fast,1\n");
    expect_error(Cause::user, {"points.csv:3", "found 3 fields, expected 9"},
                 [&] { read_points(path); });
    write_file(path, head + "one,\"fast");
    expect_error(Cause::user, {"points.csv:2", "never ends"}, [&] { read_points(path); });
}

TEST(Chart, ThePictureSaysWhatCannotBeDrawn) {
    const std::string svg = chart_svg(two_methods());
    EXPECT_NE(svg.find("error 0: slow, exact (8)"), std::string::npos);
    EXPECT_NE(svg.find("what is picked by default"), std::string::npos);
    EXPECT_NE(svg.find("One &amp; two"), std::string::npos);
    EXPECT_NE(svg.find("Pareto front"), std::string::npos);
}

TEST(Csv, FieldsWithCommasQuotesAndLineBreaksComeBack) {
    const std::vector<std::string> fields = {"plain", "a,b", "say \"so\"", "two\nlines", ""};
    const std::vector<CsvRecord> records =
        csv_records(csv_line({"head"}) + csv_line(fields) + "last\r\n", "x.csv");
    ASSERT_EQ(records.size(), 3U);
    EXPECT_EQ(records[1].fields, fields);
    EXPECT_EQ(records[1].line, 2);
    EXPECT_EQ(records[2].line, 4);
    EXPECT_EQ(records[2].fields, std::vector<std::string>{"last"});
}

TEST(Experiment, TakesMediansOfCostsAndMeansOfErrors) {
    std::vector<uint64_t> order;
    const auto run = [&](double factor) {
        return [&order, factor](uint64_t seed) {
            order.push_back(seed);
            const double x = static_cast<double>(seed);
            return Measured{factor * x * x, x};
        };
    };
    const std::vector<ChartCurve> curves =
        run_shuffled({{"m", {{"a", run(1), true}, {"b", run(2), false}}}}, 5);
    ASSERT_EQ(curves.size(), 1U);
    const ChartPoint& a = curves[0].points[0];
    EXPECT_EQ(a.setting, "a");
    EXPECT_TRUE(a.automatic);
    EXPECT_EQ(a.cost, 9);
    EXPECT_EQ(a.error, 3);
    EXPECT_NEAR(a.error_sigma, std::sqrt(2.5 / 5), 1e-12);
    EXPECT_EQ(curves[0].points[1].cost, 18);
    EXPECT_EQ(order.size(), 10U);
    EXPECT_FALSE(std::is_sorted(order.begin(), order.end()));
    EXPECT_TRUE(std::isnan(median({})));
    EXPECT_EQ(median({4, 1, 3, 2}), 2.5);
}

TEST(Experiment, ProcessorTimeIsTakenWhereNoCostIsGiven) {
    const auto work = [](uint64_t seed) {
        const double begun = thread_seconds();
        while (thread_seconds() < begun + 0.002 * static_cast<double>(seed)) {
        }
        return Measured{0, 1};
    };
    const double cost = run_shuffled({{"m", {{"a", work}}}}, 3)[0].points[0].cost;
    EXPECT_GE(cost, 0.004);
    EXPECT_EQ(run_shuffled({{"m", {{"a", work}}}}, 1)[0].points[0].error_sigma, 0);
}

}  // namespace
}  // namespace drude
