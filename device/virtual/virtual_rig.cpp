#include "device/virtual/virtual_rig.h"

#include <algorithm>
#include <utility>

namespace drude {

VirtualRig::VirtualRig(const Material& sample, const VirtualBenchSettings& settings,
                       FaultInjection faults)
    : optics_(sample, settings), faults_(std::move(faults)) {
    // Mounts wake up at 0.
    OpticalState awake;
    awake.analyser_deg = 0;
    history_.push_back({clock_->now(), awake});
}

void VirtualRig::transfer(const char* part) {
    const uint64_t number = transfers_++;
    if (faults_) faults_(number, part);
}

bool VirtualRig::comes_back(const char* part, double seconds) {
    try {
        transfer(part);
    } catch (const DeviceError&) {
        clock_->sleep(seconds);
        return false;
    }
    return true;
}

void VirtualRig::enter(const OpticalState& state) {
    if (!(state == this->state())) history_.push_back({clock_->now(), state});
    entered_s_ = clock_->now();
    ++entries_;
}

std::vector<ExposurePart> VirtualRig::between(double start_s, double end_s) {
    while (history_.size() > 1 && history_[1].since_s <= start_s) history_.pop_front();
    std::vector<ExposurePart> parts;
    for (size_t i = 0; i < history_.size(); ++i) {
        const double first = std::max(start_s, history_[i].since_s);
        const double last =
            i + 1 < history_.size() ? std::min(end_s, history_[i + 1].since_s) : end_s;
        if (last > first) parts.push_back({history_[i].state, last - first});
    }
    return parts;
}

}  // namespace drude
