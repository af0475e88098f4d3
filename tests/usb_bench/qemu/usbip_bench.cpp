// usbip-bench: runs a program while virtual USB devices are attached to this machine's kernel.
//
// The command line is that of usb-bench (bench_options.cpp), but what the kernel itself decides has
// no option: which user may open a device, who holds it, which driver is bound. Needs root and the
// kernel module vhci_hcd, so it is for a machine that is there for nothing else
// (tests/long.d/qemu).
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/files.h"
#include "materials/material.h"
#include "usb_bench/bench_options.h"
#include "usb_bench/make_devices.h"
#include "usb_bench/qemu/usbip_host.h"

namespace drude::usb_bench {
namespace {

constexpr int left_something = 125, failed_here = 126;
constexpr double seconds_to_attach = 60, seconds_to_settle = 10;

int work(const BenchOptions& options) {
    for (const DeviceOption& device : options.devices) {
        if (device.refused || device.busy) {
            user_error("usbip-bench: found ',refused' or ',busy' at {}:{}; here the kernel says so",
                       device.scheme, device.serial);
        }
    }
    if (!options.on_failure.empty() || !options.bench_file.empty()) {
        user_error("usbip-bench: --on-failure and --bench-out are usb-bench's only");
    }
    FaultPlan faults;
    OpticalBench optics(find_material(options.material), options.settings, options.frozen_noise);
    const auto devices = make_devices(options, optics, faults);
    std::vector<VirtualDevice*> pointers;
    for (const auto& device : devices) pointers.push_back(device.get());
    UsbipHost host(pointers);
    host.attach(seconds_to_attach);

    // Answers are counted from here: those before were the kernel's, which configured the devices.
    const uint64_t first = faults.count();
    for (PlannedFault fault : options.faults) {
        fault.index += first;
        faults.add(fault);
    }
    faults.on_kill = [&](int milliseconds) { host.kill_program(milliseconds / 1000.0); };
    const int status = host.run(options.command, options.seconds_allowed);

    const uint64_t count = faults.count() - first;
    std::string problem;
    const bool settled = host.drivers_back(seconds_to_settle, &problem);
    if (!options.answers_file.empty()) {
        std::string text;
        for (uint64_t i = 0; i < count; ++i) {
            const std::string& answer = faults.answers()[first + i];
            text += fmt::format("{}{}\n", i, answer.substr(answer.find('\t')));
        }
        write_file(options.answers_file, text);
    }
    if (!options.report_file.empty()) {
        const nlohmann::ordered_json report = {{"status", status},
                                               {"answers", count},
                                               {"faults_applied", faults.applied()},
                                               {"not_applicable", faults.not_applicable()},
                                               {"troubles", problem}};
        write_file(options.report_file, report.dump(1) + "\n");
    }
    if (options.count) fmt::print(stderr, "usbip-bench: {} answers\n", count);
    if (faults.applied() < static_cast<int>(options.faults.size())) {
        fmt::print(stderr, "usbip-bench: {} of {} faults befell the program\n", faults.applied(),
                   options.faults.size());
        return left_something;
    }
    if (settled) return status;
    fmt::print(stderr, "usbip-bench: {}\n", problem);
    return left_something;
}

}  // namespace
}  // namespace drude::usb_bench

int main(int argc, char** argv) {
    using namespace drude;
    try {
        return usb_bench::work(usb_bench::parse_bench_options({argv + 1, argv + argc}));
    } catch (const Error& error) {
        fmt::print(stderr, "usbip-bench: {}\n", error.message());
        return error.cause() == Cause::user ? 2 : usb_bench::failed_here;
    }
}
