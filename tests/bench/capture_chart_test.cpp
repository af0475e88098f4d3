// What the capture chart measures, on sweeps short enough for a test.
#include <gtest/gtest.h>

#include "bench/charts/capture_experiment.h"
#include "device/virtual/virtual_bench.h"

namespace drude {
namespace {

Recipe short_recipe(int averages) {
    Recipe recipe;
    recipe.angles_deg = {70};
    recipe.steps = 12;
    recipe.averages = averages;
    recipe.zones_deg = {45};
    recipe.step_nm = 10;
    return recipe;
}

TEST(CaptureChart, APerfectBenchMeasuresTheTruth) {
    VirtualBenchSettings settings;
    settings.pixels = 521;  // a pixel a nanometre
    const CaptureOutcome outcome = capture_outcome("Cu-McPeak", settings, short_recipe(1));
    EXPECT_EQ(outcome.rows, 41u);
    // Counts are rounded, and the mean of a bin is not its pixels' mean to the last digit.
    EXPECT_LT(outcome.psi_error_deg, 0.01);
    EXPECT_LT(outcome.delta_error_deg, 0.02);
}

TEST(CaptureChart, SixteenFramesAreFourTimesAsGoodAsOne) {
    VirtualBenchSettings settings = noise_only_bench_settings(1);
    settings.pixels = 521;
    const CaptureOutcome one = capture_outcome("Cu-McPeak", settings, short_recipe(1));
    const CaptureOutcome many = capture_outcome("Cu-McPeak", settings, short_recipe(16));
    // 41 rows: the root mean square is known to 11 %, the ratio to 16 %.
    EXPECT_NEAR(one.psi_error_deg / many.psi_error_deg, 4, 2);
    EXPECT_NEAR(one.delta_error_deg / many.delta_error_deg, 4, 2);
    EXPECT_NEAR(one.psi_pull, 1, 0.4);
    EXPECT_NEAR(many.psi_pull, 1, 0.4);
    EXPECT_GT(many.integrating_s, 5 * one.integrating_s);  // darks are the same
    EXPECT_NEAR(many.moving_s, one.moving_s, 1e-6);
    EXPECT_LT(many.moving_s + many.integrating_s, many.seconds);
}

TEST(CaptureChart, SameSeedSameSweep) {
    VirtualBenchSettings settings = noise_only_bench_settings(3);
    settings.pixels = 105;
    const CaptureOutcome a = capture_outcome("Al-McPeak", settings, short_recipe(1));
    const CaptureOutcome b = capture_outcome("Al-McPeak", settings, short_recipe(1));
    EXPECT_EQ(a.psi_error_deg, b.psi_error_deg);
    EXPECT_EQ(a.delta_error_deg, b.delta_error_deg);
    EXPECT_EQ(a.seconds, b.seconds);
}

}  // namespace
}  // namespace drude
