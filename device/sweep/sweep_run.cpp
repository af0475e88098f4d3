#include "device/sweep/sweep_run.h"

#include <algorithm>
#include <optional>

#include "base/error.h"
#include "device/sweep/dark_check.h"
#include "device/sweep/drift_check.h"
#include "device/sweep/exposure.h"

namespace drude {

SweepRun::SweepRun(Bench& bench, Operator& person, const SweepOptions& options, Journal journal,
                   JournalWriter writer)
    : driver_(bench, person, options.stop),
      bench_(bench),
      options_(options),
      journal_(std::move(journal)),
      writer_(std::move(writer)),
      retrier_(driver_, options.retries, [this](const std::string& text) { log("retry", text); }) {}

// False where it was stopped.
bool SweepRun::run(bool resumed) {
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

void SweepRun::log(const std::string& kind, const std::string& text) {
    writer_.write(JournalEvent{kind, text});
    if (options_.observer.message) options_.observer.message(text);
}

void SweepRun::measure_angles() {
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

void SweepRun::measure_points(bool resumed) {
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

void SweepRun::measure_point(uint32_t index) {
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

double SweepRun::exposure_of(uint32_t group) {
    if (const JournalExposure* known = journal_.exposure(group)) return known->integration_s;
    JournalExposure exposure;
    exposure.group = group;
    exposure.integration_s = journal_.header->recipe.integration_s;
    if (exposure.integration_s == 0) {
        std::vector<PlanPoint> points;
        std::copy_if(journal_.plan.begin(), journal_.plan.end(), std::back_inserter(points),
                     [&](const PlanPoint& point) { return point.group == group; });
        const ExposureLimits limits = exposure_limits(journal_.header->recipe);
        ExposureChoice choice;
        retrier_.run([&] { choice = choose_exposure(driver_, bench_, points, limits); });
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
JournalDark SweepRun::take_dark(uint32_t block, double integration_s) {
    const auto first = std::find_if(journal_.plan.begin(), journal_.plan.end(),
                                    [&](const PlanPoint& point) { return point.block == block; });
    JournalDark dark;
    dark.block = block;
    dark.session = session_;
    dark.integration_s = integration_s;
    DarkCheck check(bench_.spectrometer->info(), journal_.darks, integration_s);
    retrier_.run([&] {
        driver_.set_integration_time(integration_s);
        driver_.set(*first);
        driver_.set_lamp(false);
        dark.frames = take_frames(journal_.header->recipe.dark_frames);
        check.check(dark.frames);
    });
    if (check.hot() > 0) {
        log("warning",
            fmt::format("{} pixels read full scale in the dark and are left out", check.hot()));
    }
    return dark;
}

JournalPoint SweepRun::take_point(uint32_t index, double integration_s) {
    JournalPoint point;
    point.index = index;
    point.session = session_;
    point.integration_s = integration_s;
    bool seen_saturated = false;
    retrier_.run([&] {
        driver_.set_lamp(true);
        driver_.set_integration_time(integration_s);
        driver_.set(journal_.plan[index]);
        point.frames = take_frames(journal_.header->recipe.averages *
                                   static_cast<int>(journal_.plan[index].repeat));
        check_saturation(point.frames, &seen_saturated);
        point.settled_s = driver_.settled_s();
        point.polariser_deg = driver_.polariser_deg();
        point.polariser_reported_deg = driver_.polariser_reported_deg();
        point.analyser_deg = driver_.analyser_deg();
        point.analyser_reported_deg = driver_.analyser_reported_deg();
    });
    point.retries = static_cast<uint32_t>(retrier_.retries());
    return point;
}

// Full scale over most of a frame is believed where it is read a second time: until then it may be
// a flash, or a damaged frame. Of an exposure that is simply too long it is not asked again.
void SweepRun::check_saturation(const std::vector<Frame>& frames, bool* seen) {
    if (overexposed_) return;
    const SpectrometerInfo& spectrometer = bench_.spectrometer->info();
    for (const Frame& frame : frames) {
        const auto full =
            std::count_if(frame.counts.begin(), frame.counts.end(),
                          [&](uint32_t counts) { return counts >= spectrometer.max_counts; });
        if (2 * static_cast<size_t>(full) <= frame.counts.size()) continue;
        if (*seen) {
            overexposed_ = true;
            log("warning", fmt::format("{}: {} of {} pixels read full scale; they are left out. "
                                       "Choose a shorter time with --integration",
                                       spectrometer.uri, full, frame.counts.size()));
            return;
        }
        *seen = true;
        device_error(Fault::bad_frame, "{}: {} of {} pixels read full scale", spectrometer.uri,
                     full, frame.counts.size());
    }
}

std::vector<Frame> SweepRun::take_frames(int count) {
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
void SweepRun::check_against_before(const std::set<uint32_t>& done) {
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
        const Drift drift =
            checked_drift(before, old_dark, now, dark && dark->block == block ? *dark : old_dark,
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

}  // namespace drude
