// The simulated bench in this process, without USB: `virtual:MATERIAL`.
#pragma once

#include <functional>
#include <memory>

#include "device/bench.h"
#include "device/device_error.h"
#include "device/virtual/virtual_optics.h"

namespace drude {

// What a virtual bench is made to suffer: called before each transfer of each part with the
// transfer's number (from 0, all parts counted together) and the part's name ("spectrometer",
// "polariser", "analyser", "retarder", "goniometer"); may throw DeviceError, which the sweep
// handles as it would that of a real part.
using FaultInjection = std::function<void(uint64_t transfer, const char* part)>;

// All parts motorised, a VirtualClock of its own on which frames take their integration time plus
// readout and mounts move at 430 degrees a second plus 60 ms (ELL14), free-running double-buffered
// frames: a frame that is handed out may have begun before the request, so that stale frames are a
// real hazard. Throws as VirtualOptics does.
Bench make_virtual_bench(const Material& sample, const VirtualBenchSettings& settings,
                         FaultInjection faults = {});

// A bench of ordinary parts: noise, dark, drift, offsets, extinction and jitter of the values that
// virtual_optics.h names in parentheses. What `virtual:MATERIAL` is.
VirtualBenchSettings ordinary_bench_settings(uint64_t seed);

}  // namespace drude
