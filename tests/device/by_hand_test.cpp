// Benches whose parts somebody moves: what is asked for, in which words, and that nothing is done
// where nobody can be asked.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "base/expect_error.h"
#include "device/sweep/goniometers.h"
#include "device/sweep/journal_reduction.h"
#include "sweep_cases.h"

namespace drude {
namespace {

// A spectrometer whose lamp no line of its own switches.
class WithoutLampLine : public Spectrometer {
  public:
    explicit WithoutLampLine(std::shared_ptr<Spectrometer> inner)
        : inner_(std::move(inner)), info_(inner_->info()) {
        info_.has_lamp_control = false;
    }
    const SpectrometerInfo& info() const override { return info_; }
    void set_integration_time(double seconds) override { inner_->set_integration_time(seconds); }
    double integration_time() const override { return inner_->integration_time(); }
    void set_lamp(bool) override { ADD_FAILURE() << "there is no line"; }
    Frame acquire() override { return inner_->acquire(); }
    void recover() override { inner_->recover(); }
    bool reconnect(double seconds) override { return inner_->reconnect(seconds); }

  private:
    std::shared_ptr<Spectrometer> inner_;
    SpectrometerInfo info_;
};

// Does what is asked, with the motors of a virtual bench for hands.
class Assistant : public Operator {
  public:
    explicit Assistant(const Bench& bench) : bench_(bench) {}
    void ask(const std::string& request) override {
        requests.push_back(request);
        if (request == "set both arms to 60 degrees from the sample's normal") {
            bench_.goniometer->move_to(60, 0);
        } else if (request == "set both arms to 70 degrees from the sample's normal") {
            bench_.goniometer->move_to(70, 0);
        } else if (request ==
                   "put the retarder into the beam, its fast axis in the plane of incidence") {
            bench_.retarder.rotator->move_to(bench_.retarder.in_deg);
        } else if (request == "take the retarder out of the beam") {
            bench_.retarder.rotator->move_to(bench_.retarder.out_deg);
        } else if (request == "block the light of the lamp, for a dark reading") {
            bench_.spectrometer->set_lamp(false);
        } else if (request == "let the light of the lamp in again") {
            bench_.spectrometer->set_lamp(true);
        } else {
            ADD_FAILURE() << request;
        }
    }
    std::vector<std::string> requests;

  private:
    Bench bench_;  // shares the parts
};

VirtualBenchSettings quiet_settings() {
    VirtualBenchSettings settings = short_bench_settings();
    settings.pixels = 256;
    settings.mount_jitter_deg = 0;
    return settings;
}

Recipe two_angles() {
    Recipe recipe = short_recipe();
    recipe.angles_deg = {60, 70};
    recipe.cycles = 2;
    recipe.averages = 8;
    recipe.first_nm = 500;
    recipe.step_nm = 25;
    return recipe;
}

Measurement measure(Bench& bench, Operator& person, const std::string& journal) {
    SweepOptions options;
    options.journal = journal;
    const SweepOutcome outcome = run_sweep(bench, two_angles(), person, options);
    EXPECT_TRUE(outcome.journal.complete);
    return parse_measurement(reduce_journal(outcome.journal, {}).text, "m");
}

TEST(ByHand, EveryRequestOnceAndTheMeasurementOfTheMotors) {
    const TemporaryFolder folder;
    Bench motors = make_virtual_bench(find_material("Cu-McPeak"), quiet_settings());
    NoOperator nobody;
    const Measurement truth = measure(motors, nobody, folder.file("a.journal"));

    Bench bench = make_virtual_bench(find_material("Cu-McPeak"), quiet_settings());
    const auto person = std::make_shared<Assistant>(bench);
    bench.goniometer = std::make_shared<ManualGoniometer>(person);
    bench.goniometer_by_hand = true;
    bench.retarder.rotator = nullptr;
    bench.spectrometer = std::make_shared<WithoutLampLine>(bench.spectrometer);
    const Measurement measured = measure(bench, *person, folder.file("b.journal"));
    const std::vector<std::string> per_angle = {
        "take the retarder out of the beam", "block the light of the lamp, for a dark reading",
        "let the light of the lamp in again",
        "put the retarder into the beam, its fast axis in the plane of incidence"};
    std::vector<std::string> expected;
    for (const char* angle : {"60", "70"}) {
        expected.push_back(
            fmt::format("set both arms to {} degrees from the sample's normal", angle));
        expected.insert(expected.end(), per_angle.begin(), per_angle.end());
    }
    EXPECT_EQ(person->requests, expected);
    ASSERT_EQ(measured.rows.size(), truth.rows.size());
    ASSERT_GT(truth.rows.size(), 10u);
    for (size_t i = 0; i < truth.rows.size(); ++i) {
        const MeasurementRow &ours = measured.rows[i], &theirs = truth.rows[i];
        EXPECT_NEAR(ours.psi_deg, theirs.psi_deg,
                    5 * std::hypot(ours.sigma_psi_deg, theirs.sigma_psi_deg));
        EXPECT_NEAR(ours.delta_deg, theirs.delta_deg,
                    5 * std::hypot(ours.sigma_delta_deg, theirs.sigma_delta_deg));
    }
}

// gtest's stdin is no terminal in the ordinary test command; this makes sure of it.
TEST(ByHand, NobodyIsAskedWithoutATerminal) {
    const int before = dup(0);
    ASSERT_NE(freopen("/dev/null", "r", stdin), nullptr);
    expect_error(Cause::user, {"turn the knob", "no terminal", "--yes"},
                 [] { TerminalOperator(false).ask("turn the knob"); });
    TerminalOperator(true).ask("turn the knob");
    dup2(before, 0);
    close(before);
}

}  // namespace
}  // namespace drude
