#include "usb_bench/optical_bench.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace drude::usb_bench {

namespace {

double seconds_between(Instant from, Instant to) {
    return std::chrono::duration<double>(to - from).count();
}

}  // namespace

OpticalBench::OpticalBench(Material sample, VirtualBenchSettings settings, bool frozen_noise)
    : optics_(std::move(sample), std::move(settings)),
      frozen_noise_(frozen_noise),
      start_(Clock::now()) {
    // Long before anything, so that every exposure lies within the history.
    history_.push_back({Instant::min(), from_angles()});
}

OpticalState OpticalBench::from_angles() const {
    const auto at = [&](Role role) { return angles_[static_cast<int>(role)]; };
    // In (-180, 180].
    const auto folded = [](double degrees) {
        return 180 - std::fmod(540 - std::fmod(degrees, 360), 360);
    };
    OpticalState state;
    state.polariser_deg = at(Role::polariser);
    state.analyser_deg = at(Role::analyser);
    state.retarder_in = std::abs(folded(at(Role::retarder))) < 45;
    // On its way the stage passes where no light would meet the sample's face.
    state.incidence_deg = std::clamp(folded(at(Role::sample_stage)), 0.5, 89.5);
    state.straight_through = std::abs(folded(at(Role::detector_arm))) < 0.01;
    const double offset = folded(180 - 2 * state.incidence_deg - at(Role::detector_arm));
    // Closer than the encoders resolve: in the mirror direction.
    state.offset_deg = state.straight_through || std::abs(offset) < 0.01 ? 0 : offset;
    state.lamp_on = lamp_on_;
    return state;
}

void OpticalBench::change(OpticalState next) {
    if (next == history_.back().state) return;
    history_.push_back({Clock::now(), next});
    exposures_in_state_ = 0;
    // No exposure looks back further than its own length, and that is a minute at most.
    while (history_.size() > 2 && seconds_between(history_[1].since, Clock::now()) > 120) {
        history_.erase(history_.begin());
        history_.front().since = Instant::min();
    }
}

void OpticalBench::set(Role role, double degrees) {
    if (role == Role::none) return;
    angles_[static_cast<int>(role)] = degrees;
    change(from_angles());
}

void OpticalBench::fix_arms(double incidence_deg) {
    set(Role::sample_stage, incidence_deg);
    set(Role::detector_arm, 180 - 2 * incidence_deg);
}

void OpticalBench::set_lamp(bool on) {
    lamp_on_ = on;
    change(from_angles());
}

double OpticalBench::angle(Role role) const {
    return angles_[static_cast<int>(role)];
}

std::vector<uint32_t> OpticalBench::expose(Instant begin, double seconds) {
    const Instant end = begin + seconds_of(seconds);
    const double start = seconds_between(start_, begin);
    if (begin >= history_.back().since) {
        const uint64_t number = frozen_noise_ ? 0 : exposures_in_state_++;
        return optics_.frame(history_.back().state, seconds, start, number);
    }
    std::vector<double> mean(optics_.wavelengths_nm().size(), 0.0);
    for (size_t i = 0; i < history_.size(); ++i) {
        const Instant from = std::max(begin, history_[i].since);
        const Instant to = i + 1 < history_.size() ? std::min(end, history_[i + 1].since) : end;
        if (to <= from) continue;
        const double share = seconds_between(from, to) / seconds;
        const std::vector<uint32_t> counts = optics_.frame(history_[i].state, seconds, start, 0);
        for (size_t k = 0; k < mean.size(); ++k) mean[k] += share * counts[k];
    }
    std::vector<uint32_t> counts;
    for (const double value : mean) counts.push_back(static_cast<uint32_t>(std::lround(value)));
    return counts;
}

FreeRunningDetector::FreeRunningDetector(OpticalBench& bench, double seconds)
    : bench_(bench), seconds_(seconds), begin_(Clock::now()), held_seconds_(seconds) {}

void FreeRunningDetector::restart(double seconds) {
    seconds_ = held_seconds_ = seconds;
    begin_ = Clock::now();
}

FreeRunningDetector::Reading FreeRunningDetector::fetch() {
    const Instant now = Clock::now(), end = begin_ + seconds_of(held_seconds_);
    Reading reading{bench_.expose(begin_, held_seconds_), std::max(now, end)};
    // The next to be handed out is the one under way at that time.
    const double past = seconds_between(end, reading.due);
    begin_ = end + seconds_of(seconds_ * std::floor(past / seconds_));
    held_seconds_ = seconds_;
    return reading;
}

}  // namespace drude::usb_bench
