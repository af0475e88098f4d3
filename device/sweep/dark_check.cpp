#include "device/sweep/dark_check.h"

#include "base/numbers.h"
#include "device/device_error.h"

namespace drude {

namespace {

constexpr double largest_excess = 0.05;  // of max_counts
constexpr size_t one_in = 100;           // pixels that may be different: hot ones

std::vector<size_t> saturated_pixels(const std::vector<Frame>& frames, uint32_t max_counts) {
    std::vector<size_t> pixels;
    for (size_t i = 0; i < frames.front().counts.size(); ++i) {
        for (const Frame& frame : frames) {
            if (frame.counts[i] < max_counts) continue;
            pixels.push_back(i);
            break;
        }
    }
    return pixels;
}

}  // namespace

DarkCheck::DarkCheck(const SpectrometerInfo& spectrometer, const std::vector<JournalDark>& others,
                     double integration_s)
    : spectrometer_(spectrometer), others_(others), integration_s_(integration_s) {}

void DarkCheck::check(const std::vector<Frame>& frames) {
    const std::vector<size_t> before = std::move(saturated_);
    saturated_ = saturated_pixels(frames, spectrometer_.max_counts);
    const size_t pixels = frames.front().counts.size();
    if (!saturated_.empty() && (saturated_ != before || saturated_.size() * one_in > pixels)) {
        device_error(Fault::bad_frame,
                     "{}: {} of the {} pixels of a dark read full scale at {} s; keep light away "
                     "from the detector (is the shutter closed, the lamp off?) or choose a shorter "
                     "time with --integration",
                     spectrometer_.uri, saturated_.size(), pixels, format_double(integration_s_));
    }
    for (const Frame& frame : frames) {
        for (const Frame& other : frames) compare(frame, other);
        for (const JournalDark& dark : others_) {
            if (dark.integration_s != integration_s_) continue;
            for (const Frame& other : dark.frames) compare(frame, other);
        }
    }
}

void DarkCheck::compare(const Frame& frame, const Frame& other) const {
    const double excess = largest_excess * spectrometer_.max_counts;
    size_t above = 0;
    for (size_t i = 0; i < frame.counts.size(); ++i) {
        if (1.0 * frame.counts[i] - other.counts[i] > excess) ++above;
    }
    if (above * one_in <= frame.counts.size()) return;
    device_error(Fault::bad_frame,
                 "{}: {} of the {} pixels of a dark read over {:.0f} counts more than in another "
                 "dark frame of {} s; keep light away from the detector",
                 spectrometer_.uri, above, frame.counts.size(), excess,
                 format_double(integration_s_));
}

}  // namespace drude
