// What a transfer that did not complete is to a sweep.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "device/usb/usb_transfer.h"

namespace drude {

// A device that was opened: its name in messages, and where it was on the bus.
struct UsbPlace {
    const std::string& name;
    uint16_t vendor, product;
    int bus, address;
};

// Throws the DeviceError that `end` is, "NAME: WHAT: ..." with how many of the bytes went over. A
// transfer that failed is `unplugged` where the device leaves the bus within half a second.
[[noreturn]] void raise_transfer(TransferEnd end, const UsbPlace& place, const std::string& what,
                                 size_t done, size_t wanted);

}  // namespace drude
