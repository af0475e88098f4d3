#include "device/usb/usb_handles.h"

#include <algorithm>
#include <utility>

namespace drude {

ContextPointer make_context(std::string* problem) {
    libusb_context* raw = nullptr;
    const int status = libusb_init(&raw);
    if (status != 0) {
        *problem = libusb_strerror(status);
        return nullptr;
    }
    return ContextPointer(raw);
}

std::vector<DevicePointer> list_devices(libusb_context* context, std::string* problem) {
    std::vector<DevicePointer> devices;
    libusb_device** list = nullptr;
    const ssize_t count = libusb_get_device_list(context, &list);
    if (count < 0) {
        *problem = libusb_strerror(static_cast<int>(count));
        return devices;
    }
    for (ssize_t i = 0; i < count; ++i) {
        DevicePointer device(list[i]);  // takes over the list's reference
        libusb_device_descriptor descriptor;
        if (libusb_get_device_descriptor(device.get(), &descriptor) != 0) continue;
        if (descriptor.bDeviceClass == LIBUSB_CLASS_HUB) continue;
        devices.push_back(std::move(device));
    }
    libusb_free_device_list(list, 0);
    const auto place = [](const DevicePointer& device) {
        return std::pair(libusb_get_bus_number(device.get()),
                         libusb_get_device_address(device.get()));
    };
    std::sort(devices.begin(), devices.end(),
              [&](const DevicePointer& a, const DevicePointer& b) { return place(a) < place(b); });
    return devices;
}

ConfigurationPointer read_configuration(libusb_device* device) {
    libusb_config_descriptor* raw = nullptr;
    if (libusb_get_active_config_descriptor(device, &raw) != 0 &&
        libusb_get_config_descriptor(device, 0, &raw) != 0) {
        return nullptr;
    }
    return ConfigurationPointer(raw);
}

std::vector<UsbInterface> read_interfaces(libusb_device* device) {
    std::vector<UsbInterface> interfaces;
    const ConfigurationPointer config = read_configuration(device);
    if (!config) return interfaces;
    for (int i = 0; i < config->bNumInterfaces; ++i) {
        for (int j = 0; j < config->interface[i].num_altsetting; ++j) {
            const libusb_interface_descriptor& setting = config->interface[i].altsetting[j];
            interfaces.push_back(
                {setting.bInterfaceClass, setting.bInterfaceSubClass, setting.bInterfaceProtocol});
        }
    }
    return interfaces;
}

ChosenInterface choose_interface(libusb_device* device, const std::string& scheme) {
    const ConfigurationPointer config = read_configuration(device);
    ChosenInterface first;
    bool found = false;
    for (int i = 0; config && i < config->bNumInterfaces; ++i) {
        if (config->interface[i].num_altsetting < 1) continue;
        // What is active after plugging in; none of the protocols here changes it.
        const libusb_interface_descriptor& setting = config->interface[i].altsetting[0];
        ChosenInterface chosen;
        chosen.number = setting.bInterfaceNumber;
        bool bulk = false;
        for (int j = 0; j < setting.bNumEndpoints; ++j) {
            const libusb_endpoint_descriptor& end = setting.endpoint[j];
            // Bits 11 and 12 say how often an isochronous endpoint repeats.
            const size_t size = end.wMaxPacketSize & 0x7FF;
            const uint8_t type = end.bmAttributes & 3;
            if (size == 0) continue;
            chosen.endpoints[end.bEndpointAddress] = {size, type};
            bulk = bulk || type == LIBUSB_TRANSFER_TYPE_BULK;
        }
        if (scheme == "usbtmc" && setting.bInterfaceClass == 0xFE &&
            setting.bInterfaceSubClass == 3) {
            return chosen;
        }
        if (bulk && !found) {
            first = std::move(chosen);
            found = true;
        }
    }
    return first;
}

std::string read_string(libusb_device_handle* handle, uint8_t index, int* status) {
    *status = 0;
    if (index == 0) return {};
    unsigned char buffer[256];
    int length = 0;
    for (int attempt = 0; attempt < 2; ++attempt) {
        length = libusb_get_string_descriptor_ascii(handle, index, buffer, sizeof buffer);
        if (length >= 0 || length == LIBUSB_ERROR_NO_DEVICE) break;
    }
    if (length < 0) *status = length;
    std::string text;
    for (int i = 0; i < length; ++i) {
        // Devices do send control characters; a terminal should not see them.
        text += buffer[i] >= 32 && buffer[i] < 127 ? static_cast<char>(buffer[i]) : '?';
    }
    return text;
}

}  // namespace drude
