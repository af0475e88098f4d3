#include "device/usb/usb_listing.h"

#include <fmt/format.h>

#include <utility>

#include "device/usb/usb_handles.h"

namespace drude {

namespace {

UsbDevice describe(libusb_device* device) {
    UsbDevice result;
    libusb_device_descriptor descriptor;
    libusb_get_device_descriptor(device, &descriptor);  // from memory: it cannot fail
    result.vendor = descriptor.idVendor;
    result.product = descriptor.idProduct;
    result.bus = libusb_get_bus_number(device);
    result.address = libusb_get_device_address(device);
    result.high_speed = libusb_get_device_speed(device) >= LIBUSB_SPEED_HIGH;
    result.family = instrument_family(result.vendor, result.product, read_interfaces(device));
    libusb_device_handle* raw = nullptr;
    const int status = libusb_open(device, &raw);
    if (status != 0) {
        result.permitted = status != LIBUSB_ERROR_ACCESS;
        result.problem =
            result.permitted ? std::string(libusb_strerror(status)) : "not permitted for this user";
        return result;
    }
    const HandlePointer handle(raw);
    int ignored = 0, failed = 0;
    result.manufacturer = read_string(handle.get(), descriptor.iManufacturer, &ignored);
    result.product_name = read_string(handle.get(), descriptor.iProduct, &ignored);
    result.serial = read_string(handle.get(), descriptor.iSerialNumber, &failed);
    if (failed != 0) {
        result.problem =
            fmt::format("its serial number could not be read ({})", libusb_strerror(failed));
    }
    result.uri = instrument_uri(result.family.scheme, result.vendor, result.product, result.serial);
    return result;
}

}  // namespace

UsbListing list_usb_devices() {
    UsbListing listing;
    std::string problem;
    const ContextPointer context = make_context(&problem);
    if (!context) {
        listing.note = fmt::format("this machine gives no access to USB ({})", problem);
        return listing;
    }
    for (const DevicePointer& device : list_devices(context.get(), &problem)) {
        listing.devices.push_back(describe(device.get()));
    }
    if (!problem.empty()) {
        listing.note = fmt::format("the USB devices could not be listed ({})", problem);
    }
    return listing;
}

}  // namespace drude
