// The simulated bench in this process, without USB: `virtual:MATERIAL`.
#pragma once

#include <functional>
#include <memory>

#include "device/bench.h"
#include "device/device_error.h"
#include "device/signal/calibration.h"
#include "device/virtual/virtual_optics.h"

namespace drude {

// What a virtual bench is made to suffer: called before each transfer of each part with the
// transfer's number (from 0, all parts counted together) and the part's name ("spectrometer",
// "polariser", "analyser", "retarder", "goniometer"); may throw DeviceError, which the sweep
// handles as it would that of a real part. Every call of a part's functions but info(),
// integration_time() and description() is one transfer, recover() and reconnect() included: a
// reconnect() that is made to fail finds nothing until its time is over.
using FaultInjection = std::function<void(uint64_t transfer, const char* part)>;

// All parts motorised, a VirtualClock of its own on which frames take their integration time plus
// readout and mounts move at 430 degrees a second plus 60 ms (ELL14), free-running double-buffered
// frames (free_run.h): a frame that is handed out may have begun before the request, so that stale
// frames are a real hazard.
//
// Exposures are numbered for VirtualOptics::frame() from 0 each time a part is moved (wherever to),
// the lamp switched or the integration time changed. The first frame handed out after that, or
// after recover() or reconnect(), has no such number, nor has one that may have begun earlier as
// far as a host can tell (earliest_begin()): these are the frames that acquire_fresh() discards. So
// the frames that it keeps are the same when it is repeated, however many it discarded. Throws as
// VirtualOptics does.
Bench make_virtual_bench(const Material& sample, const VirtualBenchSettings& settings,
                         FaultInjection faults = {});

// Photon and read noise and a dark, and nothing else wrong.
VirtualBenchSettings noise_only_bench_settings(uint64_t seed);

// A bench of ordinary parts: noise, dark, drift, offsets, extinction, non-linearity with the
// correction that its maker would have stored, and jitter of the values that virtual_optics.h names
// in parentheses. What `virtual:MATERIAL` is.
VirtualBenchSettings ordinary_bench_settings(uint64_t seed);

// What a perfect calibration of that bench finds: azimuths, polarisation of the source, retarder,
// depth of modulation.
Calibration true_calibration(const VirtualBenchSettings& settings);

// Coefficients c0, c1, ... c7 by which a reading is divided to undo
// VirtualBenchSettings::nonlinearity, as a spectrometer's maker would store them.
std::vector<double> nonlinearity_correction(double nonlinearity, uint32_t max_counts);

}  // namespace drude
