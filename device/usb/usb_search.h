// Which of the devices on the bus a target means; inside device/usb/ only.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/error.h"
#include "device/usb/usb_device.h"
#include "device/usb/usb_handles.h"

namespace drude {

// A device that fits a target's numbers, opened unless the system said no.
struct UsbCandidate {
    DevicePointer device;
    HandlePointer handle;
    int open_status = 0;  // of libusb_open
    uint16_t vendor = 0, product = 0;
    int bus = 0, address = 0;
    std::string serial;          // of its descriptor
    std::string serial_problem;  // why that could not be read, in words; or empty
    std::string family_name;     // "Ocean Optics USB4000 / Flame-T"
};

// Nothing fits: waiting may help.
class NoSuchDevice : public Error {
  public:
    using Error::Error;
};

// The one device that is meant; throws as open_usb(). `ask` is called for a candidate whose
// descriptor gives no serial number where that is what decides, and fills in `serial` (empty: it
// has none) and `serial_problem`.
UsbCandidate find_device(libusb_context* context, const UsbTarget& target,
                         const std::function<void(UsbCandidate&)>& ask);

// "Ocean Optics USB4000 / Flame-T (ooi:USB4C00001)".
std::string shown_device(const std::string& scheme, const UsbCandidate& candidate);

// "this user may not open it ...", with the udev rule.
std::string explain_access(uint16_t vendor, uint16_t product);

}  // namespace drude
