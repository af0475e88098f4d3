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
    std::string scheme;  // of the URI by which it is opened: "ooi", "obp", "ell", "apt", "usbtmc"
};

// A family that is known by vendor and product.
struct KnownInstrument {
    uint16_t vendor = 0, product = 0;
    InstrumentFamily family;
};
const std::vector<KnownInstrument>& known_instruments();

// The family of a device, with an empty name for everything else (keyboards, hubs). Numbers of
// Ocean Optics as in pyseabreeze; Thorlabs mounts sit behind FTDI serial-port chips; test and
// measurement instruments name themselves by their class (USBTMC: FE/03).
InstrumentFamily instrument_family(uint16_t vendor, uint16_t product,
                                   const std::vector<UsbInterface>& interfaces);

// "ooi:USB4C00001", "ell:DK0AHAJZ/0" (0: the bus address that mounts leave the factory with),
// "usbtmc:1209:5e11:TMC0001": what a bench file would say. Empty for a family without scheme.
std::string instrument_uri(const std::string& scheme, uint16_t vendor, uint16_t product,
                           const std::string& serial);

// The line for /etc/udev/rules.d that lets the user who sits at the machine open the device.
std::string udev_rule(uint16_t vendor, uint16_t product);

// The rules file of everything known here, as it is installed. Serial-port chips go by product, so
// that other devices of their maker keep their permissions; USBTMC by its interface class.
std::string udev_rules_file();

// The name that rules file has to have: udev grants access in 73-seat-late.rules, so it must sort
// before that.
inline constexpr const char* udev_rules_name = "70-drude.rules";

}  // namespace drude
