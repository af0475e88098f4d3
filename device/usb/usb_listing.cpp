#include "device/usb/usb_listing.h"

#include <fmt/format.h>
#include <libusb.h>

#include <algorithm>
#include <memory>
#include <tuple>

namespace drude {

namespace {

struct CloseContext {
    void operator()(libusb_context* context) const { libusb_exit(context); }
};
struct CloseHandle {
    void operator()(libusb_device_handle* handle) const { libusb_close(handle); }
};
struct FreeConfiguration {
    void operator()(libusb_config_descriptor* config) const {
        libusb_free_config_descriptor(config);
    }
};

std::string read_string(libusb_device_handle* handle, uint8_t index) {
    if (index == 0) return {};
    unsigned char buffer[256];
    const int length = libusb_get_string_descriptor_ascii(handle, index, buffer, sizeof buffer);
    std::string text;
    for (int i = 0; i < length; ++i) {
        // Devices do send control characters; a terminal should not see them.
        text += buffer[i] >= 32 && buffer[i] < 127 ? static_cast<char>(buffer[i]) : '?';
    }
    return text;
}

std::vector<UsbInterface> read_interfaces(libusb_device* device) {
    std::vector<UsbInterface> interfaces;
    libusb_config_descriptor* raw = nullptr;
    if (libusb_get_active_config_descriptor(device, &raw) != 0 &&
        libusb_get_config_descriptor(device, 0, &raw) != 0) {
        return interfaces;
    }
    const std::unique_ptr<libusb_config_descriptor, FreeConfiguration> config(raw);
    for (int i = 0; i < config->bNumInterfaces; ++i) {
        for (int j = 0; j < config->interface[i].num_altsetting; ++j) {
            const libusb_interface_descriptor& setting = config->interface[i].altsetting[j];
            interfaces.push_back(
                {setting.bInterfaceClass, setting.bInterfaceSubClass, setting.bInterfaceProtocol});
        }
    }
    return interfaces;
}

UsbDevice describe(libusb_device* device, const libusb_device_descriptor& descriptor) {
    UsbDevice result;
    result.vendor = descriptor.idVendor;
    result.product = descriptor.idProduct;
    result.bus = libusb_get_bus_number(device);
    result.address = libusb_get_device_address(device);
    result.family = instrument_family(result.vendor, result.product, read_interfaces(device));
    libusb_device_handle* raw = nullptr;
    const int status = libusb_open(device, &raw);
    if (status != 0) {
        result.permitted = status != LIBUSB_ERROR_ACCESS;
        result.problem =
            result.permitted ? std::string(libusb_strerror(status)) : "not permitted for this user";
        return result;
    }
    const std::unique_ptr<libusb_device_handle, CloseHandle> handle(raw);
    result.manufacturer = read_string(handle.get(), descriptor.iManufacturer);
    result.product_name = read_string(handle.get(), descriptor.iProduct);
    result.serial = read_string(handle.get(), descriptor.iSerialNumber);
    return result;
}

}  // namespace

UsbListing list_usb_devices() {
    UsbListing listing;
    libusb_context* raw_context = nullptr;
    const int status = libusb_init(&raw_context);
    if (status != 0) {
        listing.note =
            fmt::format("this machine gives no access to USB ({})", libusb_strerror(status));
        return listing;
    }
    const std::unique_ptr<libusb_context, CloseContext> context(raw_context);
    libusb_device** list = nullptr;
    const ssize_t count = libusb_get_device_list(context.get(), &list);
    if (count < 0) {
        listing.note = fmt::format("the USB devices could not be listed ({})",
                                   libusb_strerror(static_cast<int>(count)));
        return listing;
    }
    for (ssize_t i = 0; i < count; ++i) {
        libusb_device_descriptor descriptor;
        if (libusb_get_device_descriptor(list[i], &descriptor) != 0) continue;
        if (descriptor.bDeviceClass == LIBUSB_CLASS_HUB) continue;
        listing.devices.push_back(describe(list[i], descriptor));
    }
    libusb_free_device_list(list, 1);
    std::sort(listing.devices.begin(), listing.devices.end(),
              [](const UsbDevice& a, const UsbDevice& b) {
                  return std::tie(a.bus, a.address) < std::tie(b.bus, b.address);
              });
    return listing;
}

}  // namespace drude
