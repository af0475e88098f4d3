// What the parts of a virtual bench share: the light path, the clock, what they stand at and since
// when, and the faults they are made to suffer.
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "device/bench_clock.h"
#include "device/virtual/virtual_bench.h"

namespace drude {

class VirtualRig {
  public:
    VirtualRig(const Material& sample, const VirtualBenchSettings& settings, FaultInjection faults);

    const VirtualOptics& optics() const { return optics_; }
    const std::shared_ptr<VirtualClock>& clock() const { return clock_; }

    // Before each transfer: throws what the injected fault throws.
    void transfer(const char* part);
    // False where the part does not come back within `seconds`, which then have passed.
    bool comes_back(const char* part, double seconds);

    const OpticalState& state() const { return history_.back().state; }
    // From now on the parts stand at `state`; entered again where it is the same.
    void enter(const OpticalState& state);
    double entered_s() const { return entered_s_; }
    uint64_t entries() const { return entries_; }

    // What the parts stood at from `start_s` to `end_s`, in order; forgets what was before that.
    // `start_s` must not fall from call to call.
    std::vector<ExposurePart> between(double start_s, double end_s);

  private:
    struct Since {
        double since_s;
        OpticalState state;
    };

    VirtualOptics optics_;
    std::shared_ptr<VirtualClock> clock_ = std::make_shared<VirtualClock>();
    FaultInjection faults_;
    uint64_t transfers_ = 0, entries_ = 0;
    double entered_s_ = 0;
    std::deque<Since> history_;
};

}  // namespace drude
