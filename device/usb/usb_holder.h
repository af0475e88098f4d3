// Who keeps a USB interface from being claimed; inside device/usb/ only.
#pragma once

#include <libusb.h>

#include <string>

namespace drude {

// What to tell a person whose device is busy: the kernel driver that is bound to the interface, or
// the process that has the device open (those of other users are not visible), and what to do.
std::string explain_busy(libusb_device* device, int interface_number);

}  // namespace drude
