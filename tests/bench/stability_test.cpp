#include "bench/charts/stability.h"

#include <gtest/gtest.h>

#include <cmath>

namespace drude {
namespace {

StabilityMap two_by_two() {
    StabilityMap map;
    map.id = "map";
    map.title = "Map";
    map.bound = 1e-3;
    map.x = {"theta", {10, 80}};
    map.y = {"beta", {0.1, 0.2}};
    map.cells = {{1e-5, false, true}, {1e-4, false, true}, {0, true, false}, {1e-4, false, false}};
    return map;
}

TEST(StabilityMap, HoldsWhereTheBoundIsKeptAndTheRestIsSaid) {
    const StabilityMap map = two_by_two();
    const MapVerdict verdict = judge(map);
    EXPECT_TRUE(verdict.holds(map));
    EXPECT_EQ(verdict.worst_inside, 1e-4);
    EXPECT_EQ(verdict.worst_at, "theta 80, beta 0.1");
}

TEST(StabilityMap, FailsForEachReason) {
    const auto holds = [](size_t cell, MapCell with) {
        StabilityMap map = two_by_two();
        map.cells[cell] = with;
        return judge(map).holds(map);
    };
    EXPECT_TRUE(holds(0, {1e-3, false, true}));
    EXPECT_FALSE(holds(0, {1.1e-3, false, true}));
    EXPECT_FALSE(holds(0, {std::nan(""), false, true}));
    EXPECT_FALSE(holds(0, {0, true, true})) << "refused inside";
    EXPECT_FALSE(holds(3, {1, false, false})) << "a wrong number outside, and nothing said";
    EXPECT_FALSE(holds(3, {std::nan(""), false, false}));
    StabilityMap map = two_by_two();
    map.cells.pop_back();
    EXPECT_THROW(judge(map), std::invalid_argument);
    EXPECT_THROW(map_svg(map), std::invalid_argument);
}

TEST(StabilityMap, IsDrawnAndTabulated) {
    const StabilityMap map = two_by_two();
    const std::string svg = map_svg(map);
    EXPECT_NE(svg.find("said to have no answer"), std::string::npos);
    EXPECT_NE(svg.find("end of the domain"), std::string::npos);
    EXPECT_EQ(map_csv(map),
              "map,theta,beta,error,refused,inside\nmap,10,0.1,1e-05,0,1\nmap,80,0.1,0.0001,0,1\n"
              "map,10,0.2,0,1,0\nmap,80,0.2,0.0001,0,0\n");
}

}  // namespace
}  // namespace drude
