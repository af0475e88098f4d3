#include "device/sweep/journal_scans.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/error.h"
#include "base/numbers.h"

namespace drude {

namespace {

struct Dark {
    std::vector<double> counts, variance;
    uint32_t group = 0;
    double frames = 0;
    std::vector<uint8_t> saturated;  // no dark: what is measured against it is not known
};

// Mean over pixels.
double mean_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i) sum += a[i] - b[i];
    return sum / static_cast<double>(std::max<size_t>(1, a.size()));
}

class JournalScans {
  public:
    JournalScans(const Journal& journal, const NoiseModel& noise)
        : journal_(journal), noise_(noise) {
        if (journal.header->recipe.kind == RecipeKind::lobe) {
            for (const PlanPoint& point : journal.plan) {
                if (group_noise_.count(point.group) > 0) continue;
                const NoiseModel own = fit_noise_model(journal, point.group);
                group_noise_.emplace(point.group, own.readings > 0 ? own : noise);
            }
        }
        for (const JournalDark& dark : journal.darks) {
            if (darks_.count(dark.block) > 0) continue;
            Dark mean;
            const double frames = static_cast<double>(dark.frames.size());
            mean.counts.assign(dark.frames.front().counts.size(), 0);
            mean.saturated.assign(mean.counts.size(), 0);
            for (const Frame& frame : dark.frames) {
                for (size_t i = 0; i < mean.counts.size(); ++i) {
                    mean.counts[i] += frame.counts[i] / frames;
                    if (frame.counts[i] >= journal.header->spectrometer.max_counts) {
                        mean.saturated[i] = 1;
                    }
                }
            }
            mean.group = group_of(dark.block);
            mean.frames = frames;
            mean.variance.assign(mean.counts.size(), noise_of(mean.group).variance(0) / frames);
            darks_.emplace(dark.block, std::move(mean));
        }
        for (const auto& [group, model] : group_noise_) pool_darks(group, model.variance(0));
        for (const JournalPoint& point : journal.points) points_[point.index] = &point;
        // Of the light in each session over that in the first.
        scales_.push_back(1);
        for (const JournalResume& resume : journal.resumes) {
            const bool known =
                std::abs(resume.scale - 1) > 3 * resume.scale_sigma && resume.scale_sigma > 0;
            scales_.push_back(scales_.back() * (known ? resume.scale : 1));
        }
    }

    const Dark* dark(uint32_t block) const {
        const auto found = darks_.find(block);
        return found == darks_.end() ? nullptr : &found->second;
    }
    const JournalPoint* point(uint32_t index) const {
        const auto found = points_.find(index);
        return found == points_.end() ? nullptr : found->second;
    }

    ScanStep step(const JournalPoint& point, const Dark& dark) const {
        ScanStep step;
        step.polariser_deg = point.polariser_deg;
        step.frames = static_cast<int>(point.frames.size());
        const double frames = step.frames;
        const size_t pixels = dark.counts.size();
        step.counts.assign(pixels, 0);
        step.variance.assign(pixels, 0);
        step.saturated = dark.saturated;
        const uint32_t max_counts = journal_.header->spectrometer.max_counts;
        for (const Frame& frame : point.frames) {
            step.time_s += (frame.arrived_s - point.integration_s / 2) / frames;
            for (size_t i = 0; i < pixels; ++i) {
                step.counts[i] += frame.counts[i];
                if (frame.counts[i] >= max_counts) step.saturated[i] = 1;
            }
        }
        const double scale = scales_[point.session];
        const NoiseModel& noise = noise_of(journal_.plan[point.index].group);
        for (size_t i = 0; i < pixels; ++i) {
            step.counts[i] /= frames;
            const double net = step.counts[i] - dark.counts[i];
            step.variance[i] = noise.variance(net) / frames;
            if (scale != 1) {
                step.counts[i] = dark.counts[i] + net / scale;
                step.variance[i] /= scale * scale;
            }
        }
        return step;
    }

  private:
    uint32_t group_of(uint32_t block) const {
        const auto first =
            std::find_if(journal_.plan.begin(), journal_.plan.end(),
                         [&](const PlanPoint& point) { return point.block == block; });
        return first == journal_.plan.end() ? 0 : first->group;
    }

    const NoiseModel& noise_of(uint32_t group) const {
        const auto own = group_noise_.find(group);
        return own == group_noise_.end() ? noise_ : own->second;
    }

    // `variance` of one reading of one pixel.
    void pool_darks(uint32_t group, double variance) {
        std::vector<double> pattern;
        double all_frames = 0;
        for (const auto& [block, dark] : darks_) {
            if (dark.group != group) continue;
            pattern.resize(dark.counts.size(), 0);
            for (size_t i = 0; i < pattern.size(); ++i) {
                pattern[i] += dark.counts[i] * dark.frames;
            }
            all_frames += dark.frames;
        }
        for (double& counts : pattern) counts /= all_frames;
        const double pixels = static_cast<double>(pattern.size());
        for (auto& [block, dark] : darks_) {
            if (dark.group != group || dark.frames >= all_frames) continue;
            const double level = mean_difference(dark.counts, pattern);
            // Of the frames that are not in the mean on either side.
            const double expected = variance * (1 / dark.frames - 1 / all_frames);
            double chi2 = 0;
            for (size_t i = 0; i < pattern.size(); ++i) {
                const double miss = dark.counts[i] - pattern[i] - level;
                chi2 += miss * miss / expected;
            }
            if (chi2 / pixels > 1.1 + 5 * std::sqrt(2 / pixels)) continue;
            for (size_t i = 0; i < pattern.size(); ++i) dark.counts[i] = pattern[i] + level;
            dark.variance.assign(pattern.size(), variance / all_frames);
        }
    }

    const Journal& journal_;
    const NoiseModel& noise_;
    std::map<uint32_t, NoiseModel> group_noise_;  // of a lobe scan
    std::map<uint32_t, Dark> darks_;
    std::map<uint32_t, const JournalPoint*> points_;
    std::vector<double> scales_;
};

// The clocks of two sessions have nothing to do with each other: each goes on where the one before
// ended, so that a drift is one over the measuring time.
void join_sessions(const std::vector<uint32_t>& sessions, const std::vector<double*>& times) {
    std::map<uint32_t, std::pair<double, double>> span;
    for (size_t i = 0; i < sessions.size(); ++i) {
        const double time = *times[i];
        const auto entry = span.emplace(sessions[i], std::make_pair(time, time)).first;
        entry->second.first = std::min(entry->second.first, time);
        entry->second.second = std::max(entry->second.second, time);
    }
    std::map<uint32_t, double> begin;
    double end = 0;
    for (const auto& [session, first_last] : span) {
        begin[session] = end;
        const double length = first_last.second - first_last.first;
        end += length * (1 + 1.0 / static_cast<double>(times.size()));
    }
    for (size_t i = 0; i < sessions.size(); ++i) {
        *times[i] += begin[sessions[i]] - span[sessions[i]].first;
    }
}

}  // namespace

std::vector<Scan> scans_of(const Journal& journal, const NoiseModel& noise,
                           std::vector<std::string>* warnings) {
    const JournalScans source(journal, noise);
    std::set<uint32_t> incomplete;
    for (uint32_t i = 0; i < journal.plan.size(); ++i) {
        const PlanPoint& plan = journal.plan[i];
        if (source.point(i) != nullptr && source.dark(plan.block) != nullptr) continue;
        if (incomplete.insert(plan.block).second) {
            warnings->push_back(plan.straight_through
                                    ? std::string("the straight-through scans are not complete")
                                    : fmt::format("{} degrees was not measured to its end and is "
                                                  "left out",
                                                  format_double(plan.incidence_deg)));
        }
    }
    std::vector<Scan> scans;
    std::vector<uint32_t> sessions;
    std::set<uint32_t> all_sessions;
    const auto finish = [&] {
        std::vector<double*> times;
        for (ScanStep& step : scans.back().steps) times.push_back(&step.time_s);
        if (all_sessions.size() > 1) join_sessions(sessions, times);
        sessions.clear();
        all_sessions.clear();
    };
    for (uint32_t i = 0; i < journal.plan.size(); ++i) {
        const PlanPoint& plan = journal.plan[i];
        if (incomplete.count(plan.block) > 0) continue;
        const JournalPoint& point = *source.point(i);
        const Dark& dark = *source.dark(plan.block);
        if (i == 0 || scans.empty() || journal.plan[i - 1].scan != plan.scan) {
            if (!scans.empty()) finish();
            Scan scan;
            scan.incidence_deg = plan.incidence_deg;
            scan.analyser_deg = point.analyser_deg;
            scan.retarder_in = plan.retarder_in;
            scan.dark = dark.counts;
            scan.dark_variance = dark.variance;
            scans.push_back(std::move(scan));
        }
        scans.back().steps.push_back(source.step(point, dark));
        sessions.push_back(point.session);
        all_sessions.insert(point.session);
    }
    if (!scans.empty()) finish();
    return scans;
}

std::vector<LobeReading> lobe_readings_of(const Journal& journal, const NoiseModel& noise,
                                          std::vector<std::string>* warnings) {
    const JournalScans source(journal, noise);
    // All readings of a position, or none of it.
    std::set<uint32_t> incomplete;
    size_t missing = 0;
    for (uint32_t i = 0; i < journal.plan.size(); ++i) {
        const PlanPoint& plan = journal.plan[i];
        if (source.point(i) != nullptr && source.dark(plan.block) != nullptr) continue;
        incomplete.insert(plan.scan);
    }
    std::vector<LobeReading> readings;
    std::vector<uint32_t> sessions;
    for (uint32_t i = 0; i < journal.plan.size(); ++i) {
        const PlanPoint& plan = journal.plan[i];
        if (incomplete.count(plan.scan) > 0) {
            ++missing;
            continue;
        }
        const JournalPoint& point = *source.point(i);
        const Dark& dark = *source.dark(plan.block);
        LobeReading reading;
        reading.incidence_deg = plan.incidence_deg;
        reading.offset_deg = plan.offset_deg;
        reading.s_polarised = std::fmod(plan.polariser_deg, 180) == 90;
        reading.crossed = journal.header->recipe.analyser_follows &&
                          std::fmod(std::abs(plan.analyser_deg - plan.polariser_deg), 180) == 90;
        reading.visit = plan.scan;
        reading.integration_s = point.integration_s;
        reading.step = source.step(point, dark);
        reading.dark = dark.counts;
        reading.dark_variance = dark.variance;
        readings.push_back(std::move(reading));
        sessions.push_back(point.session);
    }
    std::vector<double*> times;
    for (LobeReading& reading : readings) times.push_back(&reading.step.time_s);
    join_sessions(sessions, times);
    if (missing > 0) {
        warnings->push_back(fmt::format("{} of {} readings of the lobe were not measured", missing,
                                        journal.plan.size()));
    }
    return readings;
}

}  // namespace drude
