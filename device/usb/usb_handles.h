// libusb's objects with owners, and what is read from descriptors; inside device/usb/ only.
#pragma once

#include <libusb.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "device/instrument_family.h"

namespace drude {

struct ExitContext {
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
struct UnrefDevice {
    void operator()(libusb_device* device) const { libusb_unref_device(device); }
};

using ContextPointer = std::unique_ptr<libusb_context, ExitContext>;
using HandlePointer = std::unique_ptr<libusb_device_handle, CloseHandle>;
using ConfigurationPointer = std::unique_ptr<libusb_config_descriptor, FreeConfiguration>;
using DevicePointer = std::unique_ptr<libusb_device, UnrefDevice>;

// A context of its own sees what is plugged in now: the list of an older one lags behind where no
// udev daemon tells it of changes. Empty where the machine has no USB, with libusb's words in
// *problem.
ContextPointer make_context(std::string* problem);

// All devices but hubs, by bus and address; *problem as above. They must not outlive the context.
std::vector<DevicePointer> list_devices(libusb_context* context, std::string* problem);

// The active configuration, or the first one; empty where neither can be read.
ConfigurationPointer read_configuration(libusb_device* device);
std::vector<UsbInterface> read_interfaces(libusb_device* device);

struct UsbEndpoint {
    size_t packet_size = 0;
    uint8_t type = 0;  // 2 bulk, 3 interrupt
};

// The interface that a protocol talks to, with its endpoints.
struct ChosenInterface {
    int number = 0;
    std::map<uint8_t, UsbEndpoint> endpoints;
};

// The USBTMC interface for scheme "usbtmc", else the first with bulk endpoints; interface 0 without
// endpoints where there is neither.
ChosenInterface choose_interface(libusb_device* device, const std::string& scheme);

// A string descriptor as printable ASCII, '?' for everything else; empty for index 0. A read that
// fails is tried once more; then the string is empty. *status: libusb's error, or 0.
std::string read_string(libusb_device_handle* handle, uint8_t index, int* status);

}  // namespace drude
