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
    std::vector<uint8_t> saturated;  // no dark: what is measured against it is not known
};

class JournalScans {
  public:
    JournalScans(const Journal& journal, const NoiseModel& noise)
        : journal_(journal), noise_(noise) {
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
            mean.variance.assign(mean.counts.size(), noise.variance(0) / frames);
            darks_.emplace(dark.block, std::move(mean));
        }
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
        for (size_t i = 0; i < pixels; ++i) {
            step.counts[i] /= frames;
            const double net = step.counts[i] - dark.counts[i];
            step.variance[i] = noise_.variance(net) / frames;
            if (scale != 1) {
                step.counts[i] = dark.counts[i] + net / scale;
                step.variance[i] /= scale * scale;
            }
        }
        return step;
    }

  private:
    const Journal& journal_;
    const NoiseModel& noise_;
    std::map<uint32_t, Dark> darks_;
    std::map<uint32_t, const JournalPoint*> points_;
    std::vector<double> scales_;
};

// The clocks of two sessions have nothing to do with each other: each goes on where the one before
// ended, so that a drift is one over the measuring time.
void join_sessions(const std::vector<uint32_t>& sessions, Scan* scan) {
    std::map<uint32_t, std::pair<double, double>> span;
    for (size_t i = 0; i < sessions.size(); ++i) {
        const double time = scan->steps[i].time_s;
        const auto entry = span.emplace(sessions[i], std::make_pair(time, time)).first;
        entry->second.first = std::min(entry->second.first, time);
        entry->second.second = std::max(entry->second.second, time);
    }
    std::map<uint32_t, double> begin;
    double end = 0;
    for (const auto& [session, first_last] : span) {
        begin[session] = end;
        const double length = first_last.second - first_last.first;
        end += length * (1 + 1.0 / static_cast<double>(scan->steps.size()));
    }
    for (size_t i = 0; i < sessions.size(); ++i) {
        scan->steps[i].time_s += begin[sessions[i]] - span[sessions[i]].first;
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
        if (all_sessions.size() > 1) join_sessions(sessions, &scans.back());
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
    std::vector<LobeReading> readings;
    size_t missing = 0;
    for (uint32_t i = 0; i < journal.plan.size(); ++i) {
        const PlanPoint& plan = journal.plan[i];
        const JournalPoint* point = source.point(i);
        const Dark* dark = source.dark(plan.block);
        // Both polarisations of a position, or none of it.
        const uint32_t other = i % 2 == 0 ? i + 1 : i - 1;
        if (point == nullptr || dark == nullptr || source.point(other) == nullptr) {
            ++missing;
            continue;
        }
        LobeReading reading;
        reading.incidence_deg = plan.incidence_deg;
        reading.offset_deg = plan.offset_deg;
        reading.s_polarised = plan.polariser_deg == 90;
        reading.integration_s = point->integration_s;
        reading.step = source.step(*point, *dark);
        reading.dark = dark->counts;
        reading.dark_variance = dark->variance;
        readings.push_back(std::move(reading));
    }
    if (missing > 0) {
        warnings->push_back(fmt::format("{} of {} readings of the lobe were not measured", missing,
                                        journal.plan.size()));
    }
    return readings;
}

}  // namespace drude
