// Every stability map, coarse: within its bound inside its domain, and said outside.
#include "bench/charts/stability_maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace drude {
namespace {

void expect_holds(const std::vector<StabilityMap>& maps) {
    ASSERT_FALSE(maps.empty());
    for (const StabilityMap& map : maps) {
        SCOPED_TRACE(map.id);
        const MapVerdict verdict = judge(map);
        EXPECT_LE(verdict.worst_inside, map.bound) << verdict.worst_at;
        EXPECT_EQ(verdict.refused_inside, 0U);
        EXPECT_EQ(verdict.silent_outside, 0U);
        EXPECT_TRUE(verdict.holds(map));
        EXPECT_GT(map.bound, 0);
        EXPECT_FALSE(map.domain.empty() || map.outside.empty() || map.caption.empty());
    }
}

// That a map has an outside at all, and that something is said there.
size_t refused(const StabilityMap& map) {
    return static_cast<size_t>(std::count_if(map.cells.begin(), map.cells.end(),
                                             [](const MapCell& cell) { return cell.refused; }));
}
size_t outside(const StabilityMap& map) {
    return static_cast<size_t>(std::count_if(map.cells.begin(), map.cells.end(),
                                             [](const MapCell& cell) { return !cell.inside; }));
}

TEST(Stability, Fresnel) {
    expect_holds(fresnel_maps(12));
}

TEST(Stability, FilmsInClosedForm) {
    expect_holds(film_maps(6));
}

TEST(Stability, TablesOfFilms) {
    const std::vector<StabilityMap> maps = film_table_maps(false);
    expect_holds(maps);
    EXPECT_GT(refused(maps[0]), 0U) << "clear films of n < 1 are no resonators any more";
    EXPECT_EQ(refused(maps[1]), 0U);
}

TEST(Stability, Lobes) {
    const std::vector<StabilityMap> maps = lobe_maps(8, 1024);
    EXPECT_EQ(maps.size(), 13U);
    expect_holds(maps);
    for (const StabilityMap& map : maps) EXPECT_EQ(refused(map), outside(map)) << map.id;
}

TEST(Stability, Frames) {
    expect_holds(frame_maps(10));
}

TEST(Stability, Mirrors) {
    expect_holds(mirror_maps(6, 32));
}

TEST(Stability, SunsOfOnePixel) {
    expect_holds(light_maps({8, 64, 256}, 4, 4096));
}

TEST(Stability, BeyondTheTables) {
    const std::vector<StabilityMap> maps = table_maps(16);
    expect_holds(maps);
    for (const StabilityMap& map : maps) EXPECT_GT(outside(map), 100U);
}

TEST(Stability, Fits) {
    const std::vector<StabilityMap> maps = bulk_fit_maps(8, 6);
    expect_holds(maps);
    // tan^2 Psi holds nothing of aluminium and silver below 60 degrees.
    for (const StabilityMap& map : maps) {
        if (map.id == "fits-angles-rho2") {
            EXPECT_GT(refused(map), 10U);
        }
    }
}

TEST(Stability, FitsOfFilms) {
    expect_holds(film_fit_maps(2, 1, false));
}

TEST(Stability, Capture) {
    expect_holds(capture_maps(10, 50));
}

}  // namespace
}  // namespace drude
