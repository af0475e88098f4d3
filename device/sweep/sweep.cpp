#include "device/sweep/sweep.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <optional>
#include <set>

#include "base/error.h"
#include "base/sha256.h"
#include "device/sweep/drift_check.h"
#include "device/sweep/exposure.h"

namespace drude {

namespace {

std::string utc_now() {
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    std::tm parts{};
    gmtime_r(&now, &parts);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text;
}

JournalHeader make_header(const Bench& bench, const Recipe& recipe,
                          const std::vector<std::string>& warnings) {
    JournalHeader header;
    header.recipe = recipe;
    header.bench_name = bench.name;
    header.bench_description = bench.description;
    header.is_virtual = bench.is_virtual;
    header.notes = bench.notes;
    header.warnings = bench.warnings;
    header.warnings.insert(header.warnings.end(), warnings.begin(), warnings.end());
    header.has_spectrometer = bench.spectrometer != nullptr;
    if (bench.spectrometer) {
        header.spectrometer = bench.spectrometer->info();
        const auto& own = bench.spectrometer->info().warnings;
        header.warnings.insert(header.warnings.end(), own.begin(), own.end());
    }
    if (bench.head) header.head_identity = bench.head->identity();
    if (bench.polariser.rotator) {
        header.mount_repeatability_deg = bench.polariser.rotator->info().repeatability_deg;
    }
    if (bench.analyser.rotator) {
        header.analyser_repeatability_deg = bench.analyser.rotator->info().repeatability_deg;
    }
    header.software = "drude " DRUDE_VERSION;
    // A virtual bench gives the same bytes whenever it is run.
    if (!bench.is_virtual) header.started = utc_now();
    return header;
}

class Sweep {
  public:
    Sweep(Bench& bench, Operator& person, const SweepOptions& options, Journal journal,
          JournalWriter writer)
        : driver_(bench, person, options.stop),
          bench_(bench),
          options_(options),
          journal_(std::move(journal)),
          writer_(std::move(writer)),
          retrier_(driver_, options.retries,
                   [this](const std::string& text) { log("retry", text); }) {}

    // False where it was stopped.
    bool run(bool resumed) {
        try {
            if (bench_.head) {
                measure_angles();
            } else {
                measure_points(resumed);
            }
            writer_.write_times(driver_.times());
            writer_.write_end();
            return true;
        } catch (const SweepStopped&) {
            writer_.write_times(driver_.times());
            writer_.sync();
            return false;
        } catch (const DeviceError&) {
            writer_.write_times(driver_.times());
            writer_.sync();
            throw;
        }
    }

  private:
    void log(const std::string& kind, const std::string& text) {
        writer_.write(JournalEvent{kind, text});
        if (options_.observer.message) options_.observer.message(text);
    }

    void measure_angles() {
        const std::vector<double>& angles = journal_.header->recipe.angles_deg;
        for (uint32_t i = 0; i < angles.size(); ++i) {
            const bool done = std::any_of(journal_.rows.begin(), journal_.rows.end(),
                                          [&](const JournalRows& r) { return r.angle == i; });
            if (!done) {
                JournalRows rows;
                rows.angle = i;
                retrier_.run([&] { rows.rows = driver_.measure_with_head(angles[i]); });
                writer_.write(rows);
                journal_.rows.push_back(std::move(rows));
            }
            if (options_.observer.progress) options_.observer.progress(i + 1, angles.size());
        }
    }

    void measure_points(bool resumed) {
        retrier_.run([&] { driver_.home(); });
        std::set<uint32_t> done;
        for (const JournalPoint& point : journal_.points) done.insert(point.index);
        if (resumed) check_against_before(done);
        const std::vector<PlanPoint>& plan = journal_.plan;
        for (uint32_t i = 0; i < plan.size(); ++i) {
            if (done.count(i) == 0) measure_point(i);
            if (options_.observer.progress) options_.observer.progress(i + 1, plan.size());
            const bool scan_ends = i + 1 == plan.size() || plan[i + 1].scan != plan[i].scan;
            if (scan_ends && done.count(i) == 0 && options_.observer.scan_finished) {
                options_.observer.scan_finished(journal_);
            }
        }
        // Whoever comes next finds the lamp as it was.
        retrier_.run([&] { driver_.set_lamp(true); });
    }

    void measure_point(uint32_t index) {
        const PlanPoint& point = journal_.plan[index];
        const double integration_s = exposure_of(point.group);
        if (journal_.dark(point.block) == nullptr) {
            JournalDark dark = take_dark(point.block, integration_s);
            writer_.write(dark);
            journal_.darks.push_back(std::move(dark));
        }
        JournalPoint result = take_point(index, integration_s);
        writer_.write(result);
        journal_.points.push_back(std::move(result));
    }

    double exposure_of(uint32_t group) {
        if (const JournalExposure* known = journal_.exposure(group)) return known->integration_s;
        JournalExposure exposure;
        exposure.group = group;
        exposure.integration_s = journal_.header->recipe.integration_s;
        if (exposure.integration_s == 0) {
            std::vector<PlanPoint> points;
            std::copy_if(journal_.plan.begin(), journal_.plan.end(), std::back_inserter(points),
                         [&](const PlanPoint& point) { return point.group == group; });
            ExposureChoice choice;
            retrier_.run([&] { choice = choose_exposure(driver_, bench_, points); });
            for (const std::string& warning : choice.warnings) log("warning", warning);
            exposure.integration_s = choice.integration_s;
            exposure.peak = choice.peak;
        }
        writer_.write(exposure);
        journal_.exposures.push_back(exposure);
        return exposure.integration_s;
    }

    // With everything at the block's first point, so that stray light is that of the block and a
    // dark that is taken again is taken in the same state.
    JournalDark take_dark(uint32_t block, double integration_s) {
        const auto first =
            std::find_if(journal_.plan.begin(), journal_.plan.end(),
                         [&](const PlanPoint& point) { return point.block == block; });
        JournalDark dark;
        dark.block = block;
        dark.session = session_;
        dark.integration_s = integration_s;
        retrier_.run([&] {
            driver_.set_integration_time(integration_s);
            driver_.set(*first);
            driver_.set_lamp(false);
            dark.frames = take_frames(journal_.header->recipe.dark_frames);
        });
        return dark;
    }

    JournalPoint take_point(uint32_t index, double integration_s) {
        JournalPoint point;
        point.index = index;
        point.session = session_;
        point.integration_s = integration_s;
        retrier_.run([&] {
            driver_.set_lamp(true);
            driver_.set_integration_time(integration_s);
            driver_.set(journal_.plan[index]);
            point.frames = take_frames(journal_.header->recipe.averages);
            point.settled_s = driver_.settled_s();
            point.polariser_deg = driver_.polariser_deg();
            point.polariser_reported_deg = driver_.polariser_reported_deg();
            point.analyser_deg = driver_.analyser_deg();
            point.analyser_reported_deg = driver_.analyser_reported_deg();
        });
        point.retries = static_cast<uint32_t>(retrier_.retries());
        return point;
    }

    std::vector<Frame> take_frames(int count) {
        std::vector<Frame> frames;
        for (int i = 0; i < count; ++i) {
            frames.push_back(driver_.acquire());
            const size_t pixels = frames.back().counts.size();
            if (pixels != bench_.spectrometer->info().wavelength_nm.size()) {
                device_error(Fault::bad_frame, "{}: a frame has {} pixels, expected {}",
                             bench_.spectrometer->info().uri, pixels,
                             bench_.spectrometer->info().wavelength_nm.size());
            }
        }
        return frames;
    }

    // A new session: the dark and one point that were measured before are measured again.
    void check_against_before(const std::set<uint32_t>& done) {
        if (done.size() == journal_.plan.size()) return;
        JournalResume resume;
        session_ = static_cast<uint32_t>(journal_.resumes.size() + 1);
        resume.session = session_;
        // The last point of the block that is gone on with, so that both have one dark.
        uint32_t next = 0;
        while (done.count(next) > 0) ++next;
        std::optional<JournalDark> dark;
        if (const JournalDark* before = journal_.dark(journal_.plan[next].block)) {
            dark = take_dark(before->block, before->integration_s);
            resume.dark_change_counts =
                checked_dark_change(*before, *dark, bench_.spectrometer->info(), options_.journal);
        }
        if (!journal_.points.empty()) {
            const JournalPoint& before = journal_.points.back();
            const uint32_t block = journal_.plan[before.index].block;
            const JournalDark& old_dark = *journal_.dark(block);
            const JournalPoint now = take_point(before.index, before.integration_s);
            const Drift drift = checked_drift(before, old_dark, now,
                                              dark && dark->block == block ? *dark : old_dark,
                                              bench_.spectrometer->info(), options_.journal);
            resume.scale = drift.scale;
            resume.scale_sigma = drift.sigma;
        }
        writer_.write(resume);
        journal_.resumes.push_back(resume);
        if (dark) {
            writer_.write(*dark);
            journal_.darks.push_back(std::move(*dark));
        }
    }

    BenchDriver driver_;
    Bench& bench_;
    const SweepOptions& options_;
    Journal journal_;
    JournalWriter writer_;
    Retrier retrier_;
    uint32_t session_ = 0;
};

void check_same(const Journal& before, const JournalHeader& now, const std::string& path) {
    const std::string recipe = sha256(format_recipe(now.recipe));
    if (before.recipe_sha256 != recipe) {
        user_error(
            "{}: was made with another recipe (SHA-256 {}..., now {}...); go on with the options "
            "it was begun with, or begin another one with --journal",
            path, before.recipe_sha256.substr(0, 12), recipe.substr(0, 12));
    }
    if (before.header->bench_description != now.bench_description) {
        user_error(
            "{}: was made with another bench: {}; found {}; connect the same instruments, or begin "
            "another journal with --journal",
            path, before.header->bench_description, now.bench_description);
    }
    const auto& old_nm = before.header->spectrometer.wavelength_nm;
    if (old_nm != now.spectrometer.wavelength_nm) {
        user_error(
            "{}: the spectrometer's wavelength calibration has changed since; begin another "
            "journal with --journal",
            path);
    }
}

std::string how_to_go_on(const Journal& journal, const std::string& path) {
    const size_t total = journal.header->has_spectrometer
                             ? journal.plan.size()
                             : journal.header->recipe.angles_deg.size();
    const size_t done =
        journal.header->has_spectrometer ? journal.points.size() : journal.rows.size();
    return fmt::format(
        "{} holds {} of {} {}: put right what this says and go on with the same command and "
        "--resume",
        path, done, total, journal.header->has_spectrometer ? "points" : "angles");
}

}  // namespace

SweepOutcome run_sweep(Bench& bench, const Recipe& recipe, Operator& person,
                       const SweepOptions& options) {
    std::vector<std::string> warnings;
    const Recipe adapted = adapt_recipe(recipe, bench, &warnings);
    const JournalHeader header = make_header(bench, adapted, warnings);
    SweepOutcome outcome;
    std::optional<JournalWriter> writer;
    Journal journal;
    if (options.resume && std::filesystem::exists(options.journal)) {
        journal = read_journal(options.journal);
        if (!journal.header) {
            // Stopped before anything was written: nothing is lost.
            std::filesystem::remove(options.journal);
        } else {
            check_same(journal, header, options.journal);
            outcome.resumed = true;
            if (!journal.complete) writer.emplace(JournalWriter::append(options.journal, journal));
        }
    }
    if (!outcome.resumed) {
        writer.emplace(JournalWriter::create(options.journal, header));
        journal = read_journal(options.journal);
    }
    if (!journal.complete) {
        const bool had_points = !journal.points.empty() || !journal.darks.empty();
        Sweep sweep(bench, person, options, std::move(journal), std::move(*writer));
        writer.reset();
        try {
            outcome.stopped = !sweep.run(had_points);
        } catch (const Error& error) {
            if (error.cause() != Cause::outside) throw;
            throw Error(Cause::outside,
                        error.message() + "; " +
                            how_to_go_on(read_journal(options.journal), options.journal));
        }
        journal = read_journal(options.journal);
    }
    outcome.retries = journal.retries();
    outcome.journal = std::move(journal);
    return outcome;
}

}  // namespace drude
