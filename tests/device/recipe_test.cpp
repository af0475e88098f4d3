// Recipes, plans and bench files: what they mean, and what is said about wrong ones.
#include "device/sweep/recipe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/expect_error.h"
#include "device/sweep/bench_file.h"
#include "device/sweep/goniometers.h"
#include "device/sweep/plan.h"
#include "sweep_cases.h"

namespace drude {
namespace {

Recipe recipe_of(const std::string& members) {
    return parse_recipe("{\"format\": \"drude-recipe/1\"" + members + "}", "r.json");
}

TEST(Recipe, RoundTrips) {
    Recipe recipe = recipe_of(
        ", \"kind\": \"lobe\", \"angles_deg\": [30.1, 45], \"offsets_deg\": [-2, 0.1, 3], "
        "\"detector_solid_angle_sr\": 1e-4, \"detector_half_angle_deg\": 0.4, \"seed\": "
        "9007199254740991, \"sample\": \"\\u00e4\", \"straight_through_readings\": 7, "
        "\"analyser_follows\": false, \"longest_integration_s\": 33.3, \"relative_floor\": 1e-3");
    EXPECT_EQ(recipe.seed, 9007199254740991u);
    EXPECT_EQ(recipe.offsets_deg[1], 0.1);
    EXPECT_EQ(recipe.straight_through_readings, 7);
    EXPECT_FALSE(recipe.analyser_follows);
    EXPECT_EQ(recipe.longest_integration_s, 33.3);
    EXPECT_EQ(recipe.relative_floor, 1e-3);
    const std::string text = format_recipe(recipe);
    EXPECT_EQ(format_recipe(parse_recipe(text, "again")), text);
}

TEST(Recipe, WrongOnesAreRefusedWithTheirPlace) {
    expect_error(Cause::user, {"r.json:1:", "'stepps'", "'steps'"},
                 [] { recipe_of(", \"stepps\": 3"); });
    expect_error(Cause::user, {"r.json:1:", "psi-delta", "did you mean"},
                 [] { recipe_of(", \"kind\": \"psi-dleta\""); });
    expect_error(Cause::user, {"steps", "4", "5 to 360"}, [] { recipe_of(", \"steps\": 4"); });
    expect_error(Cause::user, {"8 steps", "4 azimuths"}, [] { recipe_of(", \"steps\": 8"); });
    expect_error(Cause::user, {"whole number"}, [] { recipe_of(", \"steps\": 24.5"); });
    expect_error(Cause::user, {"90", "angles_deg"}, [] { recipe_of(", \"angles_deg\": [90]"); });
    expect_error(Cause::user, {"45 twice"}, [] { recipe_of(", \"angles_deg\": [45, 45]"); });
    expect_error(Cause::user, {"true or false"}, [] { recipe_of(", \"shuffle\": 1"); });
    expect_error(Cause::user, {"offsets_deg"}, [] { recipe_of(", \"kind\": \"lobe\""); });
    const auto lobe_of = [](const std::string& members) {
        return recipe_of(
            ", \"kind\": \"lobe\", \"offsets_deg\": [0], \"detector_solid_angle_sr\": 1e-4, "
            "\"detector_half_angle_deg\": 0.4, " +
            members);
    };
    expect_error(Cause::user, {"straight_through_readings = 0", "1 to 100"},
                 [&] { lobe_of("\"straight_through_readings\": 0"); });
    expect_error(Cause::user, {"relative_floor = 0.2"},
                 [&] { lobe_of("\"relative_floor\": 0.2"); });
    expect_error(Cause::user, {"longest_integration_s = 0"},
                 [&] { lobe_of("\"longest_integration_s\": 0"); });
    expect_error(Cause::user, {"'relative_flor'", "'relative_floor'"},
                 [&] { lobe_of("\"relative_flor\": 0"); });
    expect_error(Cause::user, {"drude-recipe/1"},
                 [] { parse_recipe("{\"format\": \"drude-recipe/2\"}", "r"); });
    EXPECT_EQ(recipe_of(", \"steps\": 3, \"harmonic_4\": false").steps, 3);
}

TEST(Plan, HasEverySettingOnceInAShuffledOrderOfItsSeed) {
    Recipe recipe;
    recipe.angles_deg = {60, 70};
    const std::vector<PlanPoint> plan = make_plan(recipe);
    ASSERT_EQ(plan.size(), 2u * 2 * 2 * 24);
    std::set<std::tuple<double, bool, double, double>> settings;
    bool ascending = true;
    for (size_t i = 0; i < plan.size(); ++i) {
        settings.emplace(plan[i].incidence_deg, plan[i].retarder_in, plan[i].analyser_deg,
                         plan[i].polariser_deg);
        if (i == 0) continue;
        EXPECT_GE(plan[i].block, plan[i - 1].block);
        EXPECT_GE(plan[i].scan, plan[i - 1].scan);
        if (plan[i].scan == 0) {
            ascending = ascending && plan[i].polariser_deg > plan[i - 1].polariser_deg;
        }
    }
    EXPECT_EQ(settings.size(), plan.size());
    EXPECT_FALSE(ascending);
    const auto steps = [](const Recipe& r) {
        std::vector<double> degrees;
        for (const PlanPoint& point : make_plan(r)) degrees.push_back(point.polariser_deg);
        return degrees;
    };
    EXPECT_EQ(steps(recipe), steps(recipe));
    Recipe other = recipe;
    other.seed = 2;
    EXPECT_NE(steps(recipe), steps(other));
    other.shuffle = false;
    EXPECT_EQ(steps(other)[1], 15);
}

Recipe lobe_recipe() {
    Recipe recipe = default_recipe(RecipeKind::lobe);
    recipe.angles_deg = {45, 60};
    recipe.offsets_deg = {-6, -4, -2, 0, 2, 4, 6};
    recipe.detector_solid_angle_sr = 2.4e-4;
    recipe.detector_half_angle_deg = 0.5;
    return recipe;
}

// The straight beam before, between and after the parts of each angle, every position once with
// both polarisations, the analyser along the polariser.
TEST(Plan, OfALobeScanComesBackToTheStraightBeam) {
    const Recipe recipe = lobe_recipe();
    const std::vector<PlanPoint> plan = make_plan(recipe);
    ASSERT_EQ(plan.size(), 2u * (1 + 2 * 3 + 2 * 7));
    EXPECT_TRUE(plan.front().straight_through);
    EXPECT_TRUE(plan.back().straight_through);
    std::set<std::tuple<double, double, double>> positions;
    std::set<std::pair<double, double>> straight;
    std::vector<double> offsets;
    int visits = 0;
    for (size_t i = 0; i < plan.size(); ++i) {
        const PlanPoint& point = plan[i];
        EXPECT_EQ(std::remainder(point.analyser_deg - point.polariser_deg, 180), 0) << i;
        EXPECT_EQ(std::fmod(point.polariser_deg, 180), i % 2 == 0 ? 90 : 0) << i;
        EXPECT_EQ(point.repeat > 1, point.straight_through) << i;
        EXPECT_EQ(point.group, point.straight_through ? 0u : point.incidence_deg == 45 ? 1u : 2u);
        if (point.straight_through) {
            visits += i % 2 == 0 ? 1 : 0;
            straight.emplace(point.polariser_deg, point.analyser_deg);
        } else {
            positions.emplace(point.incidence_deg, point.offset_deg, point.polariser_deg);
            if (i % 2 == 0) offsets.push_back(point.offset_deg);
        }
        if (i == 0) continue;
        // A dark never spans the straight beam and a sample.
        EXPECT_EQ(point.block == plan[i - 1].block,
                  point.straight_through == plan[i - 1].straight_through);
        EXPECT_GE(point.block, plan[i - 1].block);
    }
    EXPECT_EQ(visits, 7);
    EXPECT_EQ(straight.size(), 8u);  // half turns of either mount
    EXPECT_EQ(positions.size(), 2u * 2 * 7);
    EXPECT_FALSE(std::is_sorted(offsets.begin(), offsets.begin() + 7));
}

TEST(Plan, OfALobeScanFollowsItsRecipe) {
    Recipe recipe = lobe_recipe();
    recipe.straight_through_readings = 1;
    recipe.shuffle = false;
    std::vector<PlanPoint> plan = make_plan(recipe);
    ASSERT_EQ(plan.size(), 2u * (1 + 2 * 7));
    EXPECT_EQ(plan[2].offset_deg, -6);
    EXPECT_EQ(plan[4].offset_deg, -4);
    recipe.analyser_follows = false;
    for (const PlanPoint& point : make_plan(recipe)) EXPECT_EQ(point.analyser_deg, 45);
    // More readings than positions: one after every position.
    recipe.straight_through_readings = 100;
    EXPECT_EQ(make_plan(recipe).size(), 2u * (1 + 2 * (7 + 7)));
    // A wide detector also reads the crossed light.
    recipe = lobe_recipe();
    recipe.detector_half_angle_deg = 2;
    plan = make_plan(recipe);
    ASSERT_EQ(plan.size(), 4u * (1 + 2 * 3 + 2 * 7));
    for (size_t i = 0; i < plan.size(); i += 2) {
        EXPECT_EQ(std::remainder(plan[i].analyser_deg - plan[i].polariser_deg, 180), 0);
        EXPECT_EQ(std::abs(std::remainder(plan[i + 1].analyser_deg - plan[i].polariser_deg, 180)),
                  90);
        EXPECT_EQ(plan[i].polariser_deg, plan[i + 1].polariser_deg);
        EXPECT_EQ(plan[i].scan, plan[i + 1].scan);
    }
}

TEST(Plan, OfALobeScanAdaptsToTheBench) {
    Bench bench = short_bench();
    std::vector<std::string> warnings;
    EXPECT_TRUE(adapt_recipe(lobe_recipe(), bench, &warnings).analyser_follows);
    EXPECT_TRUE(warnings.empty());
    bench.analyser.rotator.reset();
    bench.analyser.fixed_deg = 45;
    bench.goniometer_by_hand = true;
    warnings.clear();
    const Recipe adapted = adapt_recipe(lobe_recipe(), bench, &warnings);
    EXPECT_FALSE(adapted.analyser_follows);
    EXPECT_EQ(adapted.relative_floor, 0.01);
    EXPECT_EQ(adapted.straight_through_readings, 2);
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_NE(warnings[0].find("does not turn"), std::string::npos);
    EXPECT_NE(warnings[1].find("by hand"), std::string::npos);
}

TEST(Plan, AdaptsToWhatTheBenchHas) {
    Bench bench = short_bench();
    bench.analyser.rotator.reset();
    bench.analyser.fixed_deg = 45;
    bench.retarder = {};
    bench.fixed_incidence_deg = 70;
    std::vector<std::string> warnings;
    const Recipe adapted = adapt_recipe(Recipe{}, bench, &warnings);
    EXPECT_EQ(adapted.angles_deg, std::vector<double>{70});
    EXPECT_EQ(adapted.zones_deg, std::vector<double>{45});
    EXPECT_EQ(adapted.cycles, 1);
    EXPECT_EQ(warnings.size(), 3u);
    Recipe wrong;
    wrong.angles_deg = {65};
    expect_error(Cause::user, {"fixed at 70", "65"},
                 [&] { adapt_recipe(wrong, bench, &warnings); });
    wrong = Recipe{};
    wrong.integration_s = 100;
    expect_error(Cause::user, {"100 s"}, [&] { adapt_recipe(wrong, short_bench(), &warnings); });
}

BenchFile bench_of(const std::string& members) {
    return parse_bench_file("{\"format\": \"drude-bench/1\"" + members + "}", "lab/b.json");
}

const char* const parts =
    ", \"spectrometer\": \"ooi:A\", \"polariser\": {\"rotator\": \"ell:D/0\", \"zero_deg\": 12.5, "
    "\"direction\": -1}, \"analyser\": {\"fixed_deg\": 45}";

TEST(BenchFile, SaysWhoPlaysWhat) {
    const BenchFile file = bench_of(std::string(parts) +
                                    ", \"retarder\": \"manual\", \"goniometer\": {\"fixed_deg\": "
                                    "70}, \"calibration\": \"c.json\"");
    EXPECT_EQ(file.name, "b");
    EXPECT_EQ(file.polariser.rotator, "ell:D/0");
    EXPECT_EQ(file.polariser.zero_deg, 12.5);
    EXPECT_EQ(file.polariser.direction, -1);
    EXPECT_EQ(file.analyser.rotator, "");
    EXPECT_TRUE(file.has_retarder);
    EXPECT_EQ(file.fixed_incidence_deg, 70);
    EXPECT_EQ(file.calibration, "lab/c.json");
}

TEST(BenchFile, WrongOnesAreRefusedWithTheirPlace) {
    expect_error(Cause::user, {"lab/b.json:1:", "'spectromter'", "'spectrometer'"},
                 [] { bench_of(", \"spectromter\": \"ooi:A\""); });
    expect_error(Cause::user, {"no 'goniometer'"}, [] { bench_of(parts); });
    expect_error(Cause::user, {"\"manual\""},
                 [] { bench_of(std::string(parts) + ", \"goniometer\": \"hand\""); });
    expect_error(Cause::user, {"expected 1 or -1"}, [] {
        bench_of(
            ", \"spectrometer\": \"ooi:A\", \"polariser\": {\"rotator\": \"ell:D/0\", "
            "\"direction\": 2}");
    });
    expect_error(Cause::user, {"ell:D/0", "two parts"}, [] {
        bench_of(std::string(parts) +
                 ", \"goniometer\": {\"sample\": {\"rotator\": \"ell:D/0\"}, \"arm\": "
                 "{\"rotator\": \"ell:D/1\"}}");
    });
    expect_error(Cause::user, {"virtual.settings", "pixels"}, [] {
        bench_of(", \"virtual\": {\"material\": \"Cu\", \"settings\": {\"pixles\": 3}}");
    });
}

TEST(BenchFile, AHeadMayHaveItsOwnCommands) {
    const std::string head = ", \"head\": \"usbtmc:1209:5e11:T1\"";
    EXPECT_EQ(bench_of(head).scpi.psi_delta, "MEAS:PSID?");
    EXPECT_EQ(bench_of(head).scpi_json, "");
    const BenchFile file = bench_of(
        head +
        ", \"scpi\": {\"psi_delta\": \"READ:ELL?\", \"angle\": \"ANG {} DEG\", \"next_error\": "
        "\"\", \"setup\": [\"FORM REAL,32\"], \"format\": \"real32\", \"swapped\": true, "
        "\"measure_s\": 12.5, \"max_counts\": 4095}");
    EXPECT_EQ(file.scpi.psi_delta, "READ:ELL?");
    EXPECT_EQ(file.scpi.angle, "ANG {} DEG");
    EXPECT_EQ(file.scpi.next_error, "");
    EXPECT_EQ(file.scpi.setup, std::vector<std::string>{"FORM REAL,32"});
    EXPECT_EQ(file.scpi.format, ScpiFormat::real32);
    EXPECT_TRUE(file.scpi.swapped);
    EXPECT_EQ(file.scpi.measure_s, 12.5);
    EXPECT_EQ(file.scpi.max_counts, 4095u);
    EXPECT_EQ(file.scpi.wavelengths, "SENS:WAV?");
    EXPECT_NE(file.scpi_json.find("READ:ELL?"), std::string::npos);
    // As the spectrometer of a bench of parts, too, but not for one that speaks no SCPI.
    EXPECT_EQ(
        bench_of(", \"spectrometer\": \"usbtmc:1209:5e11\", \"polariser\": {\"rotator\": "
                 "\"ell:D/0\"}, \"analyser\": {\"fixed_deg\": 45}, \"goniometer\": \"manual\", "
                 "\"scpi\": {\"lamp\": \"LAMP {}\"}")
            .scpi.lamp,
        "LAMP {}");
    expect_error(Cause::user, {"lab/b.json:1:", "'scpi'", "usbtmc:", "ooi:A"}, [] {
        bench_of(std::string(parts) + ", \"goniometer\": \"manual\", \"scpi\": {}");
    });
    const auto refused = [&](const std::string& members, std::initializer_list<const char*> words) {
        expect_error(Cause::user, words, [&] { bench_of(head + ", \"scpi\": {" + members + "}"); });
    };
    refused("\"psi_dleta\": \"X?\"", {"lab/b.json:1:", "psi_dleta", "'psi_delta'"});
    refused("\"psi_delta\": \"\"", {"'scpi.psi_delta' is empty"});
    refused("\"psi_delta\": \"X?\\nY?\"", {"on one line"});
    refused("\"angle\": \"ANG 70\"", {"with {} once"});
    refused("\"angle\": \"ANG {} {}\"", {"with {} once"});
    refused("\"psi_delta\": \"X? {}\"", {"without {}"});
    refused("\"format\": \"real46\"", {"real46", "'real64'"});
    refused("\"measure_s\": 0", {"above 0"});
    refused("\"shortest_s\": 100", {"shortest_s = 100 above longest_s = 60"});
    refused("\"max_counts\": 0.5", {"whole number"});
    refused("\"setup\": \"FORM\"", {"'scpi.setup'"});
}

TEST(BenchFile, AnInstrumentAloneIsToldWhatIsMissing) {
    const auto person = std::make_shared<NoOperator>();
    expect_error(Cause::user, {"ooi:A", "bench file", "drude-bench/1", "polariser"},
                 [&] { open_bench("ooi:A", 1, person); });
    expect_error(Cause::user, {"virtual:Cu"}, [&] { open_bench("virtual:", 1, person); });
    expect_error(Cause::user, {"no bench file 'none.json'"},
                 [&] { open_bench("none.json", 1, person); });
    EXPECT_EQ(open_bench("virtual:Cu-McPeak", 1, person).sample, "Cu-McPeak");
}

// A mount that does as it is told.
class PlainRotator : public Rotator {
  public:
    const RotatorInfo& info() const override { return info_; }
    void home() override { at = 0; }
    double move_to(double degrees) override { return at = degrees; }
    double position() override { return at; }
    void recover() override {}
    bool reconnect(double) override { return true; }
    double at = 0;

  private:
    RotatorInfo info_;
};

class CountingOperator : public Operator {
  public:
    void ask(const std::string& request) override { requests.push_back(request); }
    std::vector<std::string> requests;
};

// Independent of the formula: the detector's direction as a vector, from the mirror's.
TEST(Goniometer, PutsTheDetectorWhereTheMirrorSendsTheLight) {
    const auto sample = std::make_shared<PlainRotator>(), arm = std::make_shared<PlainRotator>();
    const auto person = std::make_shared<CountingOperator>();
    MotorGoniometer goniometer({sample, 10, 1}, {arm, 200, -1}, person);
    for (const double theta : {30.0, 70.0}) {
        for (const double offset : {0.0, 5.0, -3.0}) {
            goniometer.move_to(theta, offset);
            const double degree = std::acos(-1.0) / 180;
            // Light travels along +x; the sample's normal stands at theta from -x.
            const double normal_x = -std::cos((sample->at - 10) * degree),
                         normal_y = std::sin((sample->at - 10) * degree);
            const double turned = (200 - arm->at) * degree;
            const double out_x = std::cos(turned), out_y = std::sin(turned);
            EXPECT_NEAR(normal_x * -1, std::cos(theta * degree), 1e-12);
            EXPECT_NEAR(normal_x * out_x + normal_y * out_y, std::cos((theta + offset) * degree),
                        1e-12);
        }
    }
    EXPECT_TRUE(person->requests.empty());
    goniometer.straight_through();
    EXPECT_EQ(arm->at, 200);
    ASSERT_EQ(person->requests.size(), 1u);
    goniometer.move_to(50, 0);
    EXPECT_EQ(person->requests.size(), 2u);
}

}  // namespace
}  // namespace drude
