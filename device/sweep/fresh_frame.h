// Frames that began after the bench stood still.
#pragma once

#include <functional>

#include "device/bench_clock.h"
#include "device/spectrometer.h"

namespace drude {

struct FreshFrame {
    Frame frame;
    int discarded = 0;  // frames that were thrown away before it, at least one
};

// A spectrometer that runs freely and buffers twice hands out, after a move or a new integration
// time, a frame that began before it (python-seabreeze issues 110 and 177). The first frame is
// always discarded, since nothing says how long it lay in the buffer, and so is every one that can
// have begun before `settled_s` of the bench's clock: arrival less integration time less readout.
// At most 8 are; then throws DeviceError (bad frame). `between` runs before each frame and may
// throw, e.g. where a signal arrived.
FreshFrame acquire_fresh(Spectrometer& spectrometer, double settled_s,
                         const std::function<void()>& between = {});

}  // namespace drude
