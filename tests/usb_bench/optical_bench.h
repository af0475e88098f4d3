// The light path that all devices of a virtual bench share, as time goes on.
#pragma once

#include <string>
#include <vector>

#include "device/virtual/virtual_optics.h"
#include "usb_bench/virtual_device.h"

namespace drude::usb_bench {

enum class Role { none, polariser, analyser, retarder, sample_stage, detector_arm };

// Polariser and analyser: the axis stands where the mount reports to be. Retarder: in the beam
// at 0 degrees of its arm, out at 90. Goniometer: the sample's normal stands at `sample_stage`
// from the source and the detector at `detector_arm` from straight through, so that the mirror
// direction is at 180 - 2 * sample_stage, and a smaller arm is further from the normal. An arm at 0
// looks into the source: the sample is taken to be out of the beam then. A bench without mounts for
// the arms has a fixed goniometer (fix_arms()).
class OpticalBench {
  public:
    // `frozen_noise`: every exposure in one state has the same noise, whatever its number. Throws
    // as VirtualOptics does.
    OpticalBench(Material sample, VirtualBenchSettings settings, bool frozen_noise);

    const VirtualOptics& optics() const { return optics_; }
    void set(Role role, double degrees);
    void set_lamp(bool on);
    void fix_arms(double incidence_deg);
    double angle(Role role) const;

    // Raw counts of an exposure that lasts from `begin` for `seconds`, some of which may lie in the
    // past. One that saw the parts move is the mean over time of what it saw. An end that has not
    // come yet is taken to see what stands now.
    std::vector<uint32_t> expose(Instant begin, double seconds);

  private:
    struct Moment {
        Instant since;
        OpticalState state;
    };
    void change(OpticalState next);
    OpticalState from_angles() const;

    VirtualOptics optics_;
    bool frozen_noise_;
    Instant start_;
    double angles_[6] = {0, 0, 0, 0, 0, 0};
    bool lamp_on_ = true;
    std::vector<Moment> history_;
    uint64_t exposures_in_state_ = 0;
};

// A detector that integrates without pause and keeps one finished frame until it is fetched: what
// is handed out may have begun before the request, before the parts moved, or before the
// integration time changed. Only the frame after it is sure to be later than the first was fetched.
class FreeRunningDetector {
  public:
    FreeRunningDetector(OpticalBench& bench, double seconds);

    // Of the exposures that begin from now on; one that is under way or waiting keeps its own.
    void set_integration_time(double seconds) { seconds_ = seconds; }
    double integration_time() const { return seconds_; }
    void restart(double seconds);

    struct Reading {
        std::vector<uint32_t> counts;
        Instant due;
    };
    Reading fetch();

  private:
    OpticalBench& bench_;
    double seconds_;
    // The exposure that will be handed out next.
    Instant begin_;
    double held_seconds_;
};

}  // namespace drude::usb_bench
