// Lobe scans of the virtual bench, from the recipe through frames, journal and reduction to the
// lobe's name and its beta.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "fitter/lobe_fit.h"
#include "fitter/virtual_sweep.h"
#include "materials/scalar.h"

namespace drude {
namespace {

const char* const metal_name = "Cu-McPeak";

Material rough_metal(Lobe lobe, double beta) {
    Material rough = find_material(metal_name);
    rough.lobe = lobe;
    rough.masking = Masking::v_groove;
    rough.beta = beta;
    return rough;
}

Recipe lobe_recipe(const VirtualBenchSettings& settings) {
    Recipe recipe = default_recipe(RecipeKind::lobe);
    recipe.sample = "rough copper";
    recipe.angles_deg = {60};
    recipe.offsets_deg.clear();
    for (int offset = -30; offset <= 24; offset += 2) recipe.offsets_deg.push_back(offset);
    recipe.detector_half_angle_deg = settings.detector_half_angle_deg;
    recipe.detector_solid_angle_sr =
        2 * pi * (1 - std::cos(settings.detector_half_angle_deg * degree));
    recipe.first_nm = 450;
    recipe.last_nm = 710;
    recipe.step_nm = 10;
    return recipe;
}

LobeFitResult capture_and_fit(Lobe lobe, double beta, const VirtualBenchSettings& settings,
                              const Recipe& recipe) {
    const JournalReduction reduced = sweep_and_reduce(rough_metal(lobe, beta), settings, recipe);
    return fit_lobes(parse_lobe_scan(reduced.text, "scan"), find_material(metal_name));
}

const FittedLobe& fitted(const LobeFitResult& fit, Lobe lobe) {
    size_t i = 0;
    while (fit.lobes.at(i).lobe != lobe) ++i;
    return fit.lobes[i];
}

double reduced_chi2(const LobeFitResult& fit) {
    return fit.lobes.front().chi2 / fit.dof();
}

// Everything that ordinary parts have wrong, at once: the lobe that the sample has is named, its
// beta found, and what is left is the stated noise.
TEST(LobeCapture, OrdinaryPartsNameTheLobeAndRecoverBeta) {
    uint64_t seed = 1;
    for (const Lobe lobe :
         {Lobe::blinn_phong, Lobe::gaussian, Lobe::beckmann, Lobe::trowbridge_reitz}) {
        for (const double beta : {0.1, 0.15, 0.2}) {
            VirtualBenchSettings settings = ordinary_bench_settings(seed++);
            settings.pixels = 512;
            const LobeFitResult fit = capture_and_fit(lobe, beta, settings, lobe_recipe(settings));
            const FittedLobe& found = fitted(fit, lobe);
            const FittedLobe& best = fit.lobes.front();
            std::printf(
                "%-16s beta %.5f +- %.5f of %.2f, reduced chi-square %.3f +- %.3f; %s, next by "
                "%.0f\n",
                std::string(lobe_name(lobe)).c_str(), found.beta, found.sigma_beta, beta,
                reduced_chi2(fit), std::sqrt(2.0 / fit.dof()),
                best.lobe == lobe ? "named" : "in the tie", fit.lobes[1].chi2 - best.chi2);
            EXPECT_TRUE(found.tied);
            EXPECT_NEAR(found.beta, beta, 4 * found.sigma_beta);
            EXPECT_NEAR(found.beta, beta, 0.01 * beta);
            // Noise is known from the scatter of the frames; the floor and the beam's part, which
            // the fit's free scale takes up, make sigmas a little larger than what scatters.
            EXPECT_GT(reduced_chi2(fit), 0.85);
            EXPECT_LT(reduced_chi2(fit), 1.15);
        }
    }
}

// Without the other faults, noise in proportion to the light: as before, another bench.
TEST(LobeCapture, NoiseInProportionToTheLight) {
    for (const Lobe lobe : {Lobe::beckmann, Lobe::trowbridge_reitz}) {
        VirtualBenchSettings settings;
        settings.seed = 3;
        settings.pixels = 105;
        settings.relative_noise = 5e-3;
        settings.read_noise_counts = 5;
        settings.dark_counts = 1500;  // so that noise is not cut off at 0
        Recipe recipe = lobe_recipe(settings);
        recipe.step_nm = 5;
        const LobeFitResult fit = capture_and_fit(lobe, 0.15, settings, recipe);
        std::printf("%-16s relative noise: beta %.5f +- %.5f of 0.15, reduced chi-square %.3f\n",
                    std::string(lobe_name(lobe)).c_str(), fit.lobes[0].beta,
                    fit.lobes[0].sigma_beta, reduced_chi2(fit));
        EXPECT_EQ(fit.lobes[0].lobe, lobe);
        EXPECT_FALSE(fit.lobes[1].tied);
        EXPECT_NEAR(fit.lobes[0].beta, 0.15, 4 * fit.lobes[0].sigma_beta);
        EXPECT_NEAR(reduced_chi2(fit), 1, 0.15);
    }
}

// Each imperfection alone and large enough to be seen, without its countermeasure and with it.
TEST(LobeCapture, EveryImperfectionHasItsCountermeasure) {
    struct Case {
        const char* name;
        void (*spoil)(VirtualBenchSettings*);
        void (*undo)(Recipe*);  // what the recipe does against it
    };
    const auto still = [](Recipe* recipe) { recipe->analyser_follows = false; };
    const auto once = [](Recipe* recipe) { recipe->straight_through_readings = 1; };
    const Case cases[] = {
        {"polariser off by 0.5 degrees",
         [](VirtualBenchSettings* s) { s->polariser_offset_deg = 0.5; }, still},
        {"mounts eccentric by 0.4 degrees",
         [](VirtualBenchSettings* s) { s->eccentricity_deg = 0.4; }, still},
        {"mounts miss by 0.2 degrees", [](VirtualBenchSettings* s) { s->mount_jitter_deg = 0.2; },
         still},
        {"lamp drifts by 10 % an hour", [](VirtualBenchSettings* s) { s->drift_per_hour = 0.1; },
         once},
    };
    for (const Case& c : cases) {
        VirtualBenchSettings settings;
        settings.seed = 5;
        settings.pixels = 512;
        settings.electrons_per_count = 2;
        settings.read_noise_counts = 15;
        settings.dark_counts = 1500;
        c.spoil(&settings);
        Recipe recipe = lobe_recipe(settings);
        const LobeFitResult after = capture_and_fit(Lobe::beckmann, 0.15, settings, recipe);
        c.undo(&recipe);
        const LobeFitResult before = capture_and_fit(Lobe::beckmann, 0.15, settings, recipe);
        std::printf("%-32s reduced chi-square %.2f (beta %.5f) without, %.3f (%.5f) with\n", c.name,
                    reduced_chi2(before), before.lobes.front().beta, reduced_chi2(after),
                    after.lobes.front().beta);
        EXPECT_GT(reduced_chi2(before), 2) << c.name;
        EXPECT_NEAR(reduced_chi2(after), 1, 0.15) << c.name;
        EXPECT_EQ(after.lobes.front().lobe, Lobe::beckmann) << c.name;
        EXPECT_NEAR(after.lobes.front().beta, 0.15, 4 * after.lobes.front().sigma_beta) << c.name;
    }
}

// A detector that sees far around its axis gets light that out-of-plane facets have turned; the
// crossed readings hold it.
TEST(LobeCapture, AWideDetectorCountsTheCrossedLight) {
    VirtualBenchSettings settings = ordinary_bench_settings(7);
    settings.pixels = 512;
    settings.detector_half_angle_deg = 3;
    const LobeFitResult fit =
        capture_and_fit(Lobe::trowbridge_reitz, 0.15, settings, lobe_recipe(settings));
    std::printf("a detector of 3 degrees: beta %.5f +- %.5f of 0.15, reduced chi-square %.3f\n",
                fit.lobes[0].beta, fit.lobes[0].sigma_beta, reduced_chi2(fit));
    EXPECT_EQ(fit.lobes[0].lobe, Lobe::trowbridge_reitz);
    EXPECT_NEAR(fit.lobes[0].beta, 0.15, 4 * fit.lobes[0].sigma_beta);
    EXPECT_NEAR(reduced_chi2(fit), 1, 0.15);  // 1.26 without
}

TEST(LobeCapture, TheHeaderStatesTheFloorTheLampAndTheCap) {
    VirtualBenchSettings settings = ordinary_bench_settings(1);
    settings.pixels = 105;
    settings.drift_per_hour = 0.1;
    Recipe recipe = lobe_recipe(settings);
    recipe.longest_integration_s = 2;
    recipe.relative_floor = 3e-3;
    const JournalReduction reduced =
        sweep_and_reduce(rough_metal(Lobe::trowbridge_reitz, 0.2), settings, recipe);
    const LobeScan scan = parse_lobe_scan(reduced.text, "scan");
    const auto value = [&](const std::string& key) {
        std::string all;
        for (const auto& [name, text] : scan.header) all += name == key ? text + "\n" : "";
        return all;
    };
    EXPECT_EQ(value("sigma_relative_floor").substr(0, 6), "0.003 ");
    EXPECT_EQ(value("straight_through").substr(0, 10), "4 readings");
    EXPECT_NE(value("warning").find("longest integration time used, 2 s"), std::string::npos);
    EXPECT_NE(value("integration_s").find(", 2"), std::string::npos) << value("integration_s");
    for (const LobeScanRow& row : scan.rows) {
        EXPECT_GE(row.sigma_s, 3e-3 * std::abs(row.reflectance_s));
    }
}

}  // namespace
}  // namespace drude
