#include "usb_bench/make_devices.h"

#include "base/error.h"
#include "usb_bench/apt_mount.h"
#include "usb_bench/elliptec_bus.h"
#include "usb_bench/ooi_device.h"

namespace drude::usb_bench {

std::vector<std::unique_ptr<VirtualDevice>> make_devices(const BenchOptions& options,
                                                         OpticalBench& bench, FaultPlan& faults) {
    std::vector<std::unique_ptr<VirtualDevice>> devices;
    for (const DeviceOption& option : options.devices) {
        if (option.scheme == "ooi") {
            devices.push_back(std::make_unique<OoiDevice>(option.serial, bench, faults));
        } else if (option.scheme == "ell") {
            devices.push_back(std::make_unique<ElliptecBus>(
                option.serial, std::vector<Role>{Role::polariser, Role::analyser, Role::retarder},
                options.move_s, bench, faults));
        } else if (option.scheme == "apt-sample" || option.scheme == "apt-arm") {
            const Role role = option.scheme == "apt-arm" ? Role::detector_arm : Role::sample_stage;
            devices.push_back(
                std::make_unique<AptMount>(option.serial, role, options.move_s, bench, faults));
        } else {
            user_error("--device: no model of '{}'", option.scheme);
        }
    }
    return devices;
}

}  // namespace drude::usb_bench
