#include "device/usb/usb_fault.h"

#include <algorithm>
#include <vector>

#include "device/bench_clock.h"
#include "device/device_error.h"
#include "device/usb/usb_handles.h"

namespace drude {

namespace {

// Some hosts report a failed transfer first where a device was unplugged, and take the hub's word
// for it a moment later.
bool still_listed(const UsbPlace& place) {
    for (int attempt = 0; attempt < 10; ++attempt) {
        if (attempt > 0) real_clock().sleep(0.05);
        std::string problem;
        const ContextPointer fresh = make_context(&problem);
        if (!fresh) return true;
        const std::vector<DevicePointer> devices = list_devices(fresh.get(), &problem);
        const bool listed =
            std::any_of(devices.begin(), devices.end(), [&](const DevicePointer& device) {
                libusb_device_descriptor descriptor;
                libusb_get_device_descriptor(device.get(), &descriptor);
                return libusb_get_bus_number(device.get()) == place.bus &&
                       libusb_get_device_address(device.get()) == place.address &&
                       descriptor.idVendor == place.vendor && descriptor.idProduct == place.product;
            });
        if (!listed) return false;
    }
    return true;
}

}  // namespace

void raise_transfer(TransferEnd end, const UsbPlace& place, const std::string& what, size_t done,
                    size_t wanted) {
    if (end == TransferEnd::failed && !still_listed(place)) end = TransferEnd::unplugged;
    const std::string count =
        done > 0 ? fmt::format(" ({} of {} bytes went over)", done, wanted) : std::string();
    switch (end) {
        case TransferEnd::timed_out:
            device_error(Fault::timeout, "{}: {}: no answer in time{}", place.name, what, count);
        case TransferEnd::interrupted:
            device_error(Fault::interrupted, "{}: {}: interrupted{}", place.name, what, count);
        case TransferEnd::stalled:
            device_error(Fault::stall, "{}: {}: the endpoint is halted{}", place.name, what, count);
        case TransferEnd::overflow:
            device_error(Fault::overflow, "{}: {}: more bytes came than asked for", place.name,
                         what);
        case TransferEnd::unplugged:
            device_error(Fault::unplugged, "{}: {}: it was unplugged{}", place.name, what, count);
        case TransferEnd::complete:
        case TransferEnd::failed:
            break;
    }
    device_error(Fault::io, "{}: {}: the transfer failed{}", place.name, what, count);
}

}  // namespace drude
