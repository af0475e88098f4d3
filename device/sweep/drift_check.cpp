#include "device/sweep/drift_check.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"

namespace drude {

namespace {

constexpr double largest_dark_change = 0.005;  // of max_counts
constexpr double largest_drift = 0.05;
constexpr double sigmas = 5;

// Sums over the spectrum, one a frame, of the pixels that no frame of either saturates: the scatter
// of frames is that of the light and of the noise together.
struct Sums {
    double mean = 0;
    double variance_of_mean = 0;
};

Sums sums(const std::vector<Frame>& frames, const std::vector<bool>& used) {
    std::vector<double> totals;
    for (const Frame& frame : frames) {
        double total = 0;
        for (size_t i = 0; i < used.size(); ++i) total += used[i] ? frame.counts[i] : 0;
        totals.push_back(total);
    }
    Sums result;
    const double n = static_cast<double>(totals.size());
    result.mean = std::accumulate(totals.begin(), totals.end(), 0.0) / n;
    for (const double total : totals) {
        result.variance_of_mean += (total - result.mean) * (total - result.mean);
    }
    result.variance_of_mean = totals.size() > 1 ? result.variance_of_mean / (n * (n - 1)) : 0;
    return result;
}

std::vector<bool> unsaturated(const JournalPoint& a, const JournalPoint& b, uint32_t max_counts) {
    std::vector<bool> used(a.frames.front().counts.size(), true);
    for (const JournalPoint* point : {&a, &b}) {
        for (const Frame& frame : point->frames) {
            for (size_t i = 0; i < used.size(); ++i) {
                if (frame.counts[i] >= max_counts) used[i] = false;
            }
        }
    }
    return used;
}

}  // namespace

double checked_dark_change(const JournalDark& before, const JournalDark& now,
                           const SpectrometerInfo& spectrometer, const std::string& journal) {
    const std::vector<bool> all(spectrometer.wavelength_nm.size(), true);
    const double pixels = static_cast<double>(all.size());
    const Sums a = sums(before.frames, all), b = sums(now.frames, all);
    const double change = (b.mean - a.mean) / pixels;
    const double noise = std::sqrt(a.variance_of_mean + b.variance_of_mean) / pixels;
    const double bound = std::max(sigmas * noise, largest_dark_change * spectrometer.max_counts);
    if (std::abs(change) > bound) {
        throw Error(Cause::answer_is_no,
                    fmt::format("{}: the dark reading has changed by {:.1f} counts since ({:.1f} "
                                "allowed); let the spectrometer reach its temperature and keep "
                                "light away, then try again, or begin another journal with "
                                "--journal",
                                journal, change, bound));
    }
    return change;
}

Drift checked_drift(const JournalPoint& before, const JournalDark& dark_before,
                    const JournalPoint& now, const JournalDark& dark_now,
                    const SpectrometerInfo& spectrometer, const std::string& journal) {
    const std::vector<bool> used = unsaturated(before, now, spectrometer.max_counts);
    const Sums a = sums(before.frames, used), b = sums(now.frames, used);
    const double light_before = a.mean - sums(dark_before.frames, used).mean;
    const double light_now = b.mean - sums(dark_now.frames, used).mean;
    Drift drift;
    // A setting without light (crossed elements) says nothing of the lamp.
    const double noise = std::sqrt(a.variance_of_mean + b.variance_of_mean);
    const double range =
        static_cast<double>(std::count(used.begin(), used.end(), true)) * spectrometer.max_counts;
    if (!(light_before > std::max(10 * noise, 1e-4 * range))) return drift;
    drift.scale = light_now / light_before;
    drift.sigma = std::max(noise / light_before, 1e-9);
    if (!(std::abs(drift.scale - 1) <= largest_drift)) {
        throw Error(
            Cause::answer_is_no,
            fmt::format("{}: an old point measured again reads {:.4f} times what it did ({} % "
                        "allowed); let the lamp warm up, see that sample and arms were not "
                        "touched, then try again, or begin another journal with --journal",
                        journal, drift.scale, 100 * largest_drift));
    }
    return drift;
}

}  // namespace drude
