// Which USB devices belong to an instrument that a bench is built from, by their numbers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace drude {

// One interface of a USB device, as its descriptor states it (USB 2.0, table 9-12).
struct UsbInterface {
    uint8_t interface_class = 0, subclass = 0, protocol = 0;
};

struct InstrumentFamily {
    std::string name;  // "Ocean Optics USB4000 / Flame-T"; empty where the device is none of them
    std::string kind;  // "spectrometer", "rotation mount", "instrument"
    // How sure the numbers alone make it: a serial-port chip may sit in anything.
    bool certain = true;
};

// The family of a device, with an empty name for everything else (keyboards, hubs). Numbers of
// Ocean Optics as in pyseabreeze; Thorlabs mounts sit behind FTDI serial-port chips; test and
// measurement instruments name themselves by their class (USBTMC: FE/03).
InstrumentFamily instrument_family(uint16_t vendor, uint16_t product,
                                   const std::vector<UsbInterface>& interfaces);

// The line for /etc/udev/rules.d that lets the user who sits at the machine open the device.
std::string udev_rule(uint16_t vendor, uint16_t product);

}  // namespace drude
