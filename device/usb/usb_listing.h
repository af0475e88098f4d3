// What is plugged in, through libusb.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "device/instrument_family.h"

namespace drude {

struct UsbDevice {
    uint16_t vendor = 0, product = 0;
    int bus = 0, address = 0;
    // As the device states them; empty where it has none or may not be opened.
    std::string manufacturer, product_name, serial;
    InstrumentFamily family;
    std::string uri;          // by which it is opened; empty where nothing here can open it
    bool high_speed = false;  // 480 Mbit/s or more
    bool permitted = true;    // false: the system does not let this user open it
    // Why it could not be opened, or its serial number not read, in words; or empty.
    std::string problem;
};

struct UsbListing {
    std::vector<UsbDevice> devices;  // by bus and address, hubs left out
    std::string note;                // why there can be none, e.g. a machine without USB; or empty
};

// Never an error: a machine without USB has an empty list and a note. Devices are opened for
// reading their names and closed again; nothing is claimed, reset or written.
UsbListing list_usb_devices();

}  // namespace drude
