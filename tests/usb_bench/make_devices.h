// The models that a bench's command line asks for.
#pragma once

#include <memory>
#include <vector>

#include "usb_bench/bench_options.h"
#include "usb_bench/optical_bench.h"
#include "usb_bench/virtual_device.h"

namespace drude::usb_bench {

// In the order of options.devices; `bench` and `faults` outlive them. Arms that nothing moves stand
// at options.incidence_deg. Throws Error (user) for a scheme without a model.
std::vector<std::unique_ptr<VirtualDevice>> make_devices(const BenchOptions& options,
                                                         OpticalBench& bench, FaultPlan& faults);

}  // namespace drude::usb_bench
