// Sweeps on the virtual bench: undisturbed, with every fault at every transfer, and taken up again.
#include "device/sweep/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "base/expect_error.h"
#include "device/sweep/fresh_frame.h"
#include "device/sweep/journal_reduction.h"
#include "materials/surface.h"
#include "sweep_cases.h"

namespace drude {
namespace {

// The same frames and azimuths for every point, bit for bit.
void expect_same_points(const Journal& a, const Journal& b, const std::string& when) {
    ASSERT_EQ(a.points.size(), b.points.size()) << when;
    std::map<uint32_t, const JournalPoint*> by_index;
    for (const JournalPoint& point : a.points) by_index[point.index] = &point;
    for (const JournalPoint& point : b.points) {
        const JournalPoint& other = *by_index.at(point.index);
        EXPECT_EQ(point.polariser_deg, other.polariser_deg) << when;
        ASSERT_EQ(point.frames.size(), other.frames.size()) << when;
        for (size_t i = 0; i < point.frames.size(); ++i) {
            EXPECT_EQ(point.frames[i].counts, other.frames[i].counts) << when;
        }
    }
    ASSERT_TRUE(a.dark(0) != nullptr && b.dark(0) != nullptr) << when;
    for (size_t i = 0; i < a.dark(0)->frames.size(); ++i) {
        EXPECT_EQ(a.dark(0)->frames[i].counts, b.dark(0)->frames[i].counts) << when;
    }
}

uint64_t transfers_of_a_sweep(const TemporaryFolder& folder, const Recipe& recipe) {
    uint64_t count = 0;
    run_short_sweep(
        folder.file("count.journal"), false,
        [&](uint64_t transfer, const char*) { count = transfer + 1; }, recipe);
    return count;
}

TEST(Sweep, MeasuresPsiAndDelta) {
    const TemporaryFolder folder;
    Recipe recipe = short_recipe();
    recipe.steps = 24;
    recipe.averages = 4;
    recipe.zones_deg = {45, -45};
    recipe.integration_s = 0;
    recipe.first_nm = 600;
    recipe.last_nm = 750;
    recipe.step_nm = 5;
    VirtualBenchSettings settings = short_bench_settings();
    settings.pixels = 512;
    Bench bench = make_virtual_bench(find_material("Cu-McPeak"), settings);
    NoOperator nobody;
    SweepOptions options;
    options.journal = folder.file("a.journal");
    const SweepOutcome outcome = run_sweep(bench, recipe, nobody, options);
    EXPECT_TRUE(outcome.journal.complete);
    EXPECT_EQ(outcome.retries, 0u);
    EXPECT_EQ(outcome.journal.points.size(), 48u);
    const JournalReduction result = reduce_journal(outcome.journal, {});
    const Measurement measurement = parse_measurement(result.text, "m");
    ASSERT_EQ(measurement.rows.size(), 31u);
    const Material material = find_material("Cu-McPeak");
    for (const MeasurementRow& row : measurement.rows) {
        const Reflection<double> r = reflect(material, row.wavelength_nm, std::cos(70 * pi / 180));
        EXPECT_NEAR(row.psi_deg, psi(r) * 180 / pi, 0.1) << row.wavelength_nm;
        EXPECT_NEAR(row.delta_deg, delta(r) * 180 / pi, 0.2) << row.wavelength_nm;
    }
    EXPECT_EQ(measurement.header_value("sample"), "Cu-McPeak");
    EXPECT_EQ(measurement.header_value("date"), "");
    // Nothing is done twice: the bench's time is that of its parts.
    const SweepTimes& times = outcome.journal.times;
    EXPECT_GT(times.integration, 0);
    EXPECT_GT(times.motion, 0);
    EXPECT_LT(times.elsewhere(), 0.02 * times.total);
    EXPECT_GE(times.elsewhere(), -1e-9);
}

TEST(Sweep, ExposureOfTheBrightestSettingIsWithinItsBounds) {
    const TemporaryFolder folder;
    Recipe recipe = short_recipe();
    recipe.angles_deg = {45, 60, 80};
    recipe.steps = 36;
    recipe.cycles = 2;
    recipe.averages = 1;
    recipe.integration_s = 0;
    const SweepOutcome outcome = run_short_sweep(folder.file("a.journal"), false, {}, recipe);
    uint32_t brightest = 0;
    for (const JournalPoint& point : outcome.journal.points) {
        for (const uint32_t count : point.frames[0].counts) brightest = std::max(brightest, count);
    }
    EXPECT_GT(brightest, 0.68 * 65535);
    EXPECT_LT(brightest, 0.86 * 65535);
}

TEST(Sweep, ALampThatIsOffIsSaid) {
    const TemporaryFolder folder;
    VirtualBenchSettings settings = short_bench_settings();
    settings.full_scale_s = 1e4;
    Bench bench = make_virtual_bench(find_material("Cu-McPeak"), settings);
    Recipe recipe = short_recipe();
    recipe.integration_s = 0;
    NoOperator nobody;
    SweepOptions options;
    options.journal = folder.file("dark.journal");
    expect_error(Cause::outside, {"is the lamp on", "dark.journal holds 0 of 5", "--resume"},
                 [&] { run_sweep(bench, recipe, nobody, options); });
}

TEST(Sweep, ABeamThatIsTooBrightIsSaid) {
    const TemporaryFolder folder;
    VirtualBenchSettings settings = short_bench_settings();
    settings.full_scale_s = 1e-6;
    Bench bench = make_virtual_bench(find_material("Cu-McPeak"), settings);
    Recipe recipe = short_recipe();
    recipe.integration_s = 0;
    NoOperator nobody;
    SweepOptions options;
    options.journal = folder.file("bright.journal");
    expect_error(Cause::outside, {"grey filter", "--integration"},
                 [&] { run_sweep(bench, recipe, nobody, options); });
}

// A passing fault, of every kind and at every transfer: the same frames as without it.
TEST(SweepFaults, EveryPassingFaultAtEveryTransferLeavesTheSameFrames) {
    const TemporaryFolder folder;
    const Journal whole = run_short_sweep(folder.file("whole.journal"), false).journal;
    const uint64_t transfers = transfers_of_a_sweep(folder, short_recipe());
    ASSERT_GT(transfers, 30u);
    for (const Fault fault : {Fault::timeout, Fault::stall, Fault::short_read, Fault::overflow,
                              Fault::bad_frame, Fault::io, Fault::mechanical, Fault::unplugged}) {
        for (uint64_t at = 0; at < transfers; ++at) {
            const std::string when = fmt::format("{} at transfer {}", fault_name(fault), at);
            const std::string path = folder.file("fault.journal");
            bool injected = false;
            const SweepOutcome outcome =
                run_short_sweep(path, false, [&](uint64_t transfer, const char* part) {
                    if (transfer != at || injected) return;
                    injected = true;
                    device_error(fault, "injected into the {}", part);
                });
            EXPECT_TRUE(injected) << when;
            EXPECT_TRUE(outcome.journal.complete) << when;
            EXPECT_EQ(outcome.retries, 1u) << when;
            expect_same_points(whole, outcome.journal, when);
            std::filesystem::remove(path);
        }
    }
}

// A lasting fault: a clear error, and a journal from which the sweep goes on to the same frames.
TEST(SweepFaults, EveryLastingFaultAtEveryTransferCanBeResumed) {
    const TemporaryFolder folder;
    const Journal whole = run_short_sweep(folder.file("whole.journal"), false).journal;
    const uint64_t transfers = transfers_of_a_sweep(folder, short_recipe());
    for (const Fault fault : {Fault::timeout, Fault::mechanical, Fault::unplugged}) {
        for (uint64_t at = 0; at < transfers; ++at) {
            const std::string when = fmt::format("{} from transfer {}", fault_name(fault), at);
            const std::string path = folder.file("fault.journal");
            expect_error(Cause::outside, {"injected", "fault.journal holds", "--resume"}, [&] {
                run_short_sweep(path, false, [&](uint64_t transfer, const char* part) {
                    if (transfer >= at) device_error(fault, "injected into the {}", part);
                });
            });
            expect_error(Cause::user, {"never overwritten"}, [&] { run_short_sweep(path, false); });
            const SweepOutcome outcome = run_short_sweep(path, true);
            EXPECT_TRUE(outcome.resumed) << when;
            EXPECT_TRUE(outcome.journal.complete) << when;
            EXPECT_GE(outcome.retries, 1u) << when;
            expect_same_points(whole, outcome.journal, when);
            for (const JournalResume& resume : outcome.journal.resumes) {
                EXPECT_EQ(resume.scale, 1) << when;
                EXPECT_EQ(resume.dark_change_counts, 0) << when;
            }
            std::filesystem::remove(path);
        }
    }
}

// The same where it is asked to stop, at every moment that it looks.
TEST(SweepFaults, StopsBetweenTransfersAndGoesOn) {
    const TemporaryFolder folder;
    const Journal whole = run_short_sweep(folder.file("whole.journal"), false).journal;
    for (int at = 0;; ++at) {
        const std::string path = folder.file("stopped.journal");
        int asked = 0;
        const SweepOutcome first =
            run_short_sweep(path, false, {}, short_recipe(), [&] { return asked++ >= at; });
        if (!first.stopped) {
            EXPECT_GT(at, 30);
            break;
        }
        EXPECT_FALSE(first.journal.complete);
        const SweepOutcome second = run_short_sweep(path, true);
        expect_same_points(whole, second.journal, fmt::format("stopped at {}", at));
        std::filesystem::remove(path);
    }
}

TEST(SweepResume, WithNothingThereStartsAndWithEverythingThereEnds) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.journal");
    EXPECT_FALSE(run_short_sweep(path, true).resumed);
    const SweepOutcome again = run_short_sweep(path, true, [](uint64_t, const char*) {
        device_error(Fault::io, "nothing is to be measured");
    });
    EXPECT_TRUE(again.resumed);
    EXPECT_TRUE(again.journal.resumes.empty());
}

TEST(SweepResume, AnotherRecipeOrBenchIsRefused) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.journal");
    int asked = 0;
    run_short_sweep(path, false, {}, short_recipe(), [&] { return asked++ >= 25; });
    Recipe other = short_recipe();
    other.averages = 3;
    expect_error(Cause::user, {"another recipe", "--journal"},
                 [&] { run_short_sweep(path, true, {}, other); });
    VirtualBenchSettings settings = short_bench_settings();
    settings.seed = 2;
    Bench bench = make_virtual_bench(find_material("Cu-McPeak"), settings);
    NoOperator nobody;
    SweepOptions options;
    options.journal = path;
    options.resume = true;
    expect_error(Cause::user, {"another bench"},
                 [&] { run_sweep(bench, short_recipe(), nobody, options); });
}

// The bench is the same by its description, and its lamp or its dark is not.
TEST(SweepResume, ALampOrADarkThatChangedIsRefused) {
    const TemporaryFolder folder;
    const auto resume_with = [&](VirtualBenchSettings settings) {
        const std::string path = folder.file("a.journal");
        std::filesystem::remove(path);
        int asked = 0;
        run_short_sweep(path, false, {}, short_recipe(), [&] { return asked++ >= 25; });
        Bench bench = make_virtual_bench(find_material("Cu-McPeak"), settings);
        bench.description = short_bench().description;
        NoOperator nobody;
        SweepOptions options;
        options.journal = path;
        options.resume = true;
        return run_sweep(bench, short_recipe(), nobody, options);
    };
    VirtualBenchSettings dimmer = short_bench_settings();
    dimmer.full_scale_s *= 1.1;
    expect_error(Cause::answer_is_no, {"old point", "0.9", "warm up"},
                 [&] { resume_with(dimmer); });
    VirtualBenchSettings darker = short_bench_settings();
    darker.dark_counts = 2500;
    expect_error(Cause::answer_is_no, {"dark reading has changed by", "allowed"},
                 [&] { resume_with(darker); });
    VirtualBenchSettings little = short_bench_settings();
    little.full_scale_s *= 1.02;
    const SweepOutcome outcome = resume_with(little);
    ASSERT_EQ(outcome.journal.resumes.size(), 1u);
    EXPECT_NEAR(outcome.journal.resumes[0].scale, 1 / 1.02, 0.003);
}

// A spectrometer whose frames are made up by the test.
class ScriptedSpectrometer : public Spectrometer {
  public:
    ScriptedSpectrometer() { info_.readout_s = 0.01; }
    const SpectrometerInfo& info() const override { return info_; }
    void set_integration_time(double) override {}
    double integration_time() const override { return 0.1; }
    void set_lamp(bool) override {}
    Frame acquire() override {
        Frame frame;
        frame.arrived_s = arrivals.at(next++);
        return frame;
    }
    void recover() override {}
    bool reconnect(double) override { return true; }
    std::vector<double> arrivals;
    size_t next = 0;

  private:
    SpectrometerInfo info_;
};

// The virtual spectrometer, some of whose frames are spoilt by the test.
class SpoiltSpectrometer : public Spectrometer {
  public:
    using Spoil = std::function<void(bool lamp_on, int frame, std::vector<uint32_t>* counts)>;
    SpoiltSpectrometer(std::shared_ptr<Spectrometer> inner, Spoil spoil)
        : inner_(std::move(inner)), spoil_(std::move(spoil)) {}
    const SpectrometerInfo& info() const override { return inner_->info(); }
    void set_integration_time(double seconds) override { inner_->set_integration_time(seconds); }
    double integration_time() const override { return inner_->integration_time(); }
    void set_lamp(bool on) override {
        lamp_on_ = on;
        inner_->set_lamp(on);
    }
    Frame acquire() override {
        Frame frame = inner_->acquire();
        spoil_(lamp_on_, lamp_on_ ? light_++ : dark_++, &frame.counts);
        return frame;
    }
    void recover() override { inner_->recover(); }
    bool reconnect(double seconds) override { return inner_->reconnect(seconds); }

  private:
    std::shared_ptr<Spectrometer> inner_;
    Spoil spoil_;
    bool lamp_on_ = true;
    int light_ = 0, dark_ = 0;
};

SweepOutcome run_spoilt(const std::string& journal, SpoiltSpectrometer::Spoil spoil,
                        const Recipe& recipe = short_recipe()) {
    std::filesystem::remove(journal);
    Bench bench = short_bench();
    bench.spectrometer = std::make_shared<SpoiltSpectrometer>(bench.spectrometer, std::move(spoil));
    NoOperator nobody;
    SweepOptions options;
    options.journal = journal;
    return run_sweep(bench, recipe, nobody, options);
}

// A frame of full scale between others is a flash: it is taken again, and nothing of it is kept.
TEST(SweepSaturation, AFlashIsMeasuredAgain) {
    const TemporaryFolder folder;
    const SweepOutcome whole = run_short_sweep(folder.file("whole.journal"), false);
    for (const int flash : {3, 9}) {
        const SweepOutcome flashed = run_spoilt(
            folder.file("a.journal"), [&](bool lamp_on, int frame, std::vector<uint32_t>* counts) {
                if (lamp_on && frame == flash) counts->assign(counts->size(), 65535);
            });
        // Where the frame is one of those that are discarded, nobody sees it.
        EXPECT_LE(flashed.retries, 1u);
        expect_same_points(whole.journal, flashed.journal, std::to_string(flash));
    }
}

// An exposure that is too long is believed after the second frame, and said once.
TEST(SweepSaturation, AnOverexposedSweepGoesOnWithAWarning) {
    const TemporaryFolder folder;
    const SweepOutcome outcome =
        run_spoilt(folder.file("a.journal"), [](bool lamp_on, int, std::vector<uint32_t>* counts) {
            if (lamp_on) counts->assign(counts->size(), 65535);
        });
    EXPECT_TRUE(outcome.journal.complete);
    EXPECT_EQ(outcome.retries, 1u);
    const auto& events = outcome.journal.events;
    EXPECT_EQ(std::count_if(events.begin(), events.end(),
                            [](const JournalEvent& event) {
                                return event.kind == "warning" &&
                                       event.text.find("read full scale") != std::string::npos;
                            }),
              1);
}

TEST(SweepDark, OneThatIsNoneIsTakenAgain) {
    const TemporaryFolder folder;
    const Journal whole = run_short_sweep(folder.file("whole.journal"), false).journal;
    const std::string path = folder.file("a.journal");
    // A part at full scale; another that is far above what the other frame shows. Dark frames 0
    // and 1 are stale.
    for (const uint32_t level : {65535U, 12000U}) {
        for (const int spoilt : {2, 3}) {
            const SweepOutcome outcome =
                run_spoilt(path, [&](bool lamp_on, int frame, std::vector<uint32_t>* counts) {
                    if (!lamp_on && frame == spoilt) std::fill_n(counts->begin(), 8, level);
                });
            EXPECT_EQ(outcome.retries, 1u) << level;
            expect_same_points(whole, outcome.journal, std::to_string(level));
        }
    }
    // For good: an error, and nothing that would be taken for a dark.
    expect_error(Cause::outside,
                 {"virtual:spectrometer", "8 of the 24 pixels of a dark read full scale", "shutter",
                  "2 retries", "holds 0 of 5", "--resume"},
                 [&] {
                     run_spoilt(path, [](bool lamp_on, int, std::vector<uint32_t>* counts) {
                         if (!lamp_on) std::fill_n(counts->begin(), 8, 65535U);
                     });
                 });
    EXPECT_TRUE(read_journal(path).darks.empty());
}

// Of another angle, at the same integration time.
TEST(SweepDark, IsComparedWithThoseBefore) {
    const TemporaryFolder folder;
    Recipe recipe = short_recipe();
    recipe.angles_deg = {60, 70};
    recipe.dark_frames = 1;
    const SweepOutcome outcome = run_spoilt(
        folder.file("a.journal"),
        [](bool lamp_on, int frame, std::vector<uint32_t>* counts) {
            // The third of three is the dark of an angle.
            if (!lamp_on && frame == 5) std::fill_n(counts->begin(), 8, 12000U);
        },
        recipe);
    EXPECT_EQ(outcome.retries, 1u);
    ASSERT_EQ(outcome.journal.darks.size(), 2u);
    EXPECT_LT(outcome.journal.darks[1].frames[0].counts[0], 2000u);
}

TEST(SweepDark, HotPixelsAreLeftOut) {
    const TemporaryFolder folder;
    VirtualBenchSettings settings = short_bench_settings();
    settings.pixels = 512;
    Bench bench = make_virtual_bench(find_material("Cu-McPeak"), settings);
    bench.spectrometer = std::make_shared<SpoiltSpectrometer>(
        bench.spectrometer,
        [](bool, int, std::vector<uint32_t>* counts) { counts->at(300) = 65535; });
    NoOperator nobody;
    SweepOptions options;
    options.journal = folder.file("a.journal");
    const SweepOutcome outcome = run_sweep(bench, short_recipe(), nobody, options);
    EXPECT_EQ(outcome.retries, 1u);
    const JournalReduction result = reduce_journal(outcome.journal, {});
    EXPECT_EQ(parse_measurement(result.text, "m").rows.size(), 4u);
}

TEST(SweepExposure, AFrameAtFullScaleIsBelievedWhenItIsRepeated) {
    const TemporaryFolder folder;
    Recipe recipe = short_recipe();
    recipe.integration_s = 0;
    const std::string path = folder.file("a.journal");
    const double usual = run_spoilt(
                             path, [](bool, int, std::vector<uint32_t>*) {}, recipe)
                             .journal.exposures.at(0)
                             .integration_s;
    for (int spoilt = 1; spoilt < 8; ++spoilt) {
        const SweepOutcome outcome = run_spoilt(
            path,
            [&](bool lamp_on, int frame, std::vector<uint32_t>* counts) {
                if (lamp_on && frame == spoilt) std::fill(counts->begin(), counts->end(), 65535U);
            },
            recipe);
        EXPECT_LE(outcome.retries, 1u) << spoilt;  // none for a stale frame
        EXPECT_NEAR(outcome.journal.exposures.at(0).integration_s / usual, 1, 0.02) << spoilt;
    }
}

TEST(FreshFrame, DiscardsTheFirstAndWhatBeganBefore) {
    ScriptedSpectrometer spectrometer;
    spectrometer.arrivals = {9.0, 5.12};  // however late the first arrives
    FreshFrame fresh = acquire_fresh(spectrometer, 5);
    EXPECT_EQ(fresh.discarded, 1);
    EXPECT_EQ(fresh.frame.arrived_s, 5.12);
    spectrometer.next = 0;
    spectrometer.arrivals = {5.001, 5.05, 5.109, 5.15};
    fresh = acquire_fresh(spectrometer, 5);
    EXPECT_EQ(fresh.discarded, 3);
    EXPECT_EQ(fresh.frame.arrived_s, 5.15);
    spectrometer.next = 0;
    spectrometer.arrivals.assign(20, 5.05);
    expect_error(Cause::outside, {"began before"}, [&] { acquire_fresh(spectrometer, 5); });
}

// An odd number of steps and one frame at each: no two readings of one setting.
TEST(NoiseModel, SaysWhereTheNoiseOfLightIsUnknown) {
    const TemporaryFolder folder;
    const auto warned = [&](int steps, int averages) {
        Bench bench = short_bench();
        Recipe recipe = short_recipe();
        recipe.steps = steps;
        recipe.averages = averages;
        NoOperator nobody;
        SweepOptions options;
        options.journal = folder.file(fmt::format("{} {}.journal", steps, averages));
        const Journal journal = run_sweep(bench, recipe, nobody, options).journal;
        const JournalReduction reduced = reduce_journal(journal, {});
        const bool said = std::any_of(
            reduced.warnings.begin(), reduced.warnings.end(), [](const std::string& warning) {
                return warning.find("nothing tells the noise of the light") != std::string::npos;
            });
        EXPECT_EQ(said, reduced.noise.light_readings == 0);
        return said;
    };
    EXPECT_TRUE(warned(5, 1));
    EXPECT_FALSE(warned(6, 1));
    EXPECT_FALSE(warned(5, 2));
}

// Coefficients of the settings, recovered from frames alone.
TEST(NoiseModel, FindsWhatTheBenchWasGiven) {
    const TemporaryFolder folder;
    VirtualBenchSettings settings = short_bench_settings();
    settings.pixels = 512;
    settings.read_noise_counts = 20;
    settings.electrons_per_count = 1;
    settings.relative_noise = 0.005;
    for (const int averages : {1, 4}) {
        Bench bench = make_virtual_bench(find_material("Cu-McPeak"), settings);
        Recipe recipe = short_recipe();
        recipe.steps = 24;
        recipe.averages = averages;
        recipe.dark_frames = 16;
        recipe.zones_deg = {45, -45};
        NoOperator nobody;
        SweepOptions options;
        options.journal = folder.file(fmt::format("{}.journal", averages));
        const NoiseModel noise = fit_noise_model(run_sweep(bench, recipe, nobody, options).journal);
        for (const double net : {0.0, 5000.0, 20000.0, 40000.0}) {
            // The electrons of the dark have their own shot noise.
            const double expected = 400 + (net + settings.dark_counts) + 2.5e-5 * net * net;
            EXPECT_NEAR(noise.variance(net) / expected, 1, 0.1) << averages << " " << net;
        }
    }
}

}  // namespace
}  // namespace drude
