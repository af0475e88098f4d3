// The command line of usb-bench.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "device/virtual/virtual_optics.h"
#include "usb_bench/fault_plan.h"

namespace drude::usb_bench {

struct DeviceOption {
    std::string scheme;  // "ooi", "obp", "ell", "apt-sample", "apt-arm", "usbtmc"
    std::string serial;
    bool refused = false, busy = false;
};

struct BenchOptions {
    std::vector<DeviceOption> devices;
    std::vector<PlannedFault> faults;
    std::string material = "Cu-McPeak";
    VirtualBenchSettings settings;
    bool frozen_noise = false;
    double move_s = 0;
    double incidence_deg = 70;                 // where no device turns the arms
    std::optional<double> fixed_analyser_deg;  // one mount alone, and no retarder
    double seconds_allowed = 60;
    bool inspect = true;
    bool count = false;
    std::string answers_file, report_file, bench_file;
    std::vector<std::string> command;
    std::vector<std::string> on_failure;  // run after it, on the same bench without faults
};

extern const char* const usage;

// Throws Error (user).
BenchOptions parse_bench_options(const std::vector<std::string>& words);

}  // namespace drude::usb_bench
