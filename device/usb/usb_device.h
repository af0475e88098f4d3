// USB devices opened through libusb.
//
//     UsbTarget target{"ooi", "Ocean Optics spectrometer", usb_ids("ooi"), "USB4C00001", {}};
//     std::shared_ptr<UsbPort> port = open_usb(target);
//     port->write(0x01, request, deadline_in(1));
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "device/usb/usb_port.h"

namespace drude {

struct UsbId {
    uint16_t vendor = 0, product = 0;
    bool operator==(const UsbId&) const = default;
};

// The numbers of all devices of a scheme (instrument_family.h).
std::vector<UsbId> usb_ids(const std::string& scheme);

// What is looked for.
struct UsbTarget {
    std::string scheme;      // "ooi": how devices are named in messages
    std::string what;        // "Ocean Optics spectrometer (OOI protocol)"
    std::vector<UsbId> ids;  // empty: any device whose interfaces make it one of the scheme
    std::string serial;      // empty: the only one that fits
    // Asks an opened device for its serial number where its descriptor has none; may throw
    // DeviceError. Empty: such devices have no serial number.
    std::function<std::string(UsbPort&)> ask_serial;
};

// Opens the device and claims its interface (the USBTMC one of scheme "usbtmc", else the first with
// bulk endpoints); a kernel driver that holds it is detached, and attached again when the port is
// destroyed. The device is not reset.
//
// Throws Error (user) where several devices fit and no serial number says which, listing their
// URIs; Error (outside) where none fits (what was looked for, what is there, the nearest serial
// number), where the user may not open it (with the udev rule that changes it), and where it is
// busy (who holds it); DeviceError where it vanishes meanwhile.
//
// A port belongs to the thread that uses it. Its transfers are cut short by SIGINT and SIGTERM
// (base/interrupt.h) with Fault::interrupted.
std::shared_ptr<UsbPort> open_usb(const UsbTarget& target);

}  // namespace drude
