// Lobe scans as sweeps: darks and noise of each integration time, and scans that were interrupted.
#include <gtest/gtest.h>

#include <cmath>

#include "device/sweep/journal_reduction.h"
#include "device/sweep/journal_scans.h"
#include "sweep_cases.h"

namespace drude {
namespace {

// As the straight beam's time is short and the sample's long: dark current of 20 000 counts a
// second makes the noise of the two differ.
VirtualBenchSettings settings_of_lobes() {
    VirtualBenchSettings settings = ordinary_bench_settings(4);
    settings.pixels = 400;
    settings.dark_counts_per_s = 20000;
    return settings;
}

Recipe recipe_of_lobes() {
    Recipe recipe = default_recipe(RecipeKind::lobe);
    recipe.angles_deg = {50};
    recipe.offsets_deg = {-12, -8, -4, 0, 4, 8, 12};
    recipe.averages = 3;
    recipe.dark_frames = 12;
    recipe.longest_integration_s = 0.5;
    recipe.detector_half_angle_deg = 1;
    recipe.detector_solid_angle_sr = 1e-3;
    recipe.first_nm = 450;
    recipe.last_nm = 750;
    recipe.step_nm = 20;
    return recipe;
}

SweepOutcome lobe_sweep(const std::string& journal, bool resume, std::function<bool()> stop = {},
                        const Recipe& recipe = recipe_of_lobes()) {
    Material rough = find_material("Cu-McPeak");
    rough.beta = 0.12;
    Bench bench = make_virtual_bench(rough, settings_of_lobes());
    NoOperator nobody;
    SweepOptions options;
    options.journal = journal;
    options.resume = resume;
    options.stop = std::move(stop);
    return run_sweep(bench, recipe, nobody, options);
}

double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

TEST(LobeSweep, NoiseAndDarksAreThoseOfTheirIntegrationTime) {
    const TemporaryFolder folder;
    Journal journal = lobe_sweep(folder.file("j"), false).journal;
    const VirtualBenchSettings settings = settings_of_lobes();
    ASSERT_EQ(journal.exposures.size(), 2u);
    for (const JournalExposure& exposure : journal.exposures) {
        const double dark =
            settings.dark_counts + settings.dark_counts_per_s * exposure.integration_s;
        const NoiseModel noise = fit_noise_model(journal, exposure.group);
        EXPECT_NEAR(noise.variance(0) / (225 + dark / 2), 1, 0.1) << exposure.group;
    }
    EXPECT_EQ(fit_noise_model(journal, 7).readings, 0u);

    std::vector<std::string> warnings;
    const NoiseModel all = fit_noise_model(journal);
    const auto readings = lobe_readings_of(journal, all, &warnings);
    EXPECT_TRUE(warnings.empty());
    ASSERT_EQ(readings.size(), 2u * (4 + 7));
    const double variance = fit_noise_model(journal, 1).variance(0);
    size_t pooled = 0;
    for (const LobeReading& reading : readings) {
        EXPECT_EQ(reading.step.frames, reading.incidence_deg == 90 ? 12 : 3);
        if (reading.incidence_deg == 90) continue;
        EXPECT_NEAR(mean(reading.dark_variance), variance / (3 * 12), 1e-9);
        // The mean over pixels is that of the part's own dark.
        const double expected =
            settings.dark_counts + settings.dark_counts_per_s * reading.integration_s;
        EXPECT_NEAR(mean(reading.dark), expected, 4 * std::sqrt(variance / 12 / 400));
        ++pooled;
    }
    EXPECT_EQ(pooled, 14u);

    // A dark with a lamp of the room in it is not like the others.
    JournalDark* second = nullptr;
    for (JournalDark& dark : journal.darks) {
        if (journal.plan[2 + 2 * 2 + 2].block == dark.block) second = &dark;
    }
    ASSERT_NE(second, nullptr);
    for (Frame& frame : second->frames) {
        for (size_t i = 0; i < 20; ++i) frame.counts[i] += 2000;
    }
    size_t own = 0;
    for (const LobeReading& reading : lobe_readings_of(journal, all, &warnings)) {
        if (reading.incidence_deg == 90) continue;
        own += mean(reading.dark_variance) > 2 * variance / (3 * 12) ? 1 : 0;
    }
    EXPECT_GT(own, 0u);
}

TEST(LobeSweep, ResumedScansAgreeWithUninterruptedOnes) {
    const TemporaryFolder folder;
    const auto reduced = [](const Journal& journal) {
        return parse_lobe_scan(reduce_journal(journal, {}).text, "scan");
    };
    const LobeScan whole = reduced(lobe_sweep(folder.file("whole"), false).journal);
    size_t total = 0;
    lobe_sweep(folder.file("count"), false, [&] { return ++total == 0; });
    ASSERT_GT(total, 100u);
    for (const double part : {0.3, 0.6, 0.95}) {
        const std::string path = folder.file(fmt::format("{}", part));
        size_t asked = 0;
        const auto at = static_cast<size_t>(part * static_cast<double>(total));
        const SweepOutcome first = lobe_sweep(path, false, [&] { return ++asked == at; });
        ASSERT_TRUE(first.stopped);
        ASSERT_FALSE(first.journal.complete);
        const SweepOutcome second = lobe_sweep(path, true);
        EXPECT_TRUE(second.resumed);
        ASSERT_TRUE(second.journal.complete);
        const LobeScan resumed = reduced(second.journal);
        ASSERT_EQ(resumed.rows.size(), whole.rows.size());
        for (size_t i = 0; i < whole.rows.size(); ++i) {
            // The frames are the same but for the lamp, which began anew.
            EXPECT_NEAR(resumed.rows[i].reflectance_s, whole.rows[i].reflectance_s,
                        0.5 * whole.rows[i].sigma_s);
            EXPECT_NEAR(resumed.rows[i].reflectance_p, whole.rows[i].reflectance_p,
                        0.5 * whole.rows[i].sigma_p);
        }
    }
}

// A scan that ended early gives what it has: whole positions only.
TEST(LobeSweep, HalfAScanIsReducedWithAWarning) {
    const TemporaryFolder folder;
    Journal journal = lobe_sweep(folder.file("j"), false).journal;
    journal.points.resize(5);  // straight beam, one position, half of another
    std::vector<std::string> warnings;
    const auto readings = lobe_readings_of(journal, fit_noise_model(journal), &warnings);
    EXPECT_EQ(readings.size(), 4u);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("18 of 22"), std::string::npos) << warnings[0];
}

}  // namespace
}  // namespace drude
