#include "usb_bench/make_devices.h"

#include "base/error.h"
#include "usb_bench/apt_mount.h"
#include "usb_bench/elliptec_bus.h"
#include "usb_bench/obp_device.h"
#include "usb_bench/ooi_device.h"
#include "usb_bench/tmc_device.h"

namespace drude::usb_bench {

namespace {

std::unique_ptr<VirtualDevice> make_device(const DeviceOption& option, const BenchOptions& options,
                                           OpticalBench& bench, FaultPlan& faults) {
    const double move_s = options.move_s;
    if (option.scheme == "ooi") return std::make_unique<OoiDevice>(option.serial, bench, faults);
    if (option.scheme == "obp") return std::make_unique<ObpDevice>(option.serial, bench, faults);
    if (option.scheme == "ell") {
        std::vector<Role> roles{Role::polariser};
        if (!options.fixed_analyser_deg) roles = {Role::polariser, Role::analyser, Role::retarder};
        return std::make_unique<ElliptecBus>(option.serial, roles, move_s, bench, faults);
    }
    if (option.scheme == "apt-sample" || option.scheme == "apt-arm") {
        const Role role = option.scheme == "apt-arm" ? Role::detector_arm : Role::sample_stage;
        return std::make_unique<AptMount>(option.serial, role, move_s, bench, faults);
    }
    if (option.scheme == "usbtmc") {
        return std::make_unique<TmcDevice>(option.serial, bench.optics().sample(), faults);
    }
    user_error("--device: no model of '{}'", option.scheme);
}

}  // namespace

std::vector<std::unique_ptr<VirtualDevice>> make_devices(const BenchOptions& options,
                                                         OpticalBench& bench, FaultPlan& faults) {
    bool has_arms = false;
    for (const DeviceOption& option : options.devices) {
        has_arms = has_arms || option.scheme == "apt-sample";
    }
    if (!has_arms) bench.fix_arms(options.incidence_deg);
    if (options.fixed_analyser_deg) {
        bench.set(Role::analyser, *options.fixed_analyser_deg);
        bench.set(Role::retarder, 90);
    }
    std::vector<std::unique_ptr<VirtualDevice>> devices;
    for (const DeviceOption& option : options.devices) {
        devices.push_back(make_device(option, options, bench, faults));
    }
    return devices;
}

}  // namespace drude::usb_bench
