#include "device/instrument_family.h"

#include <fmt/format.h>

#include <algorithm>

namespace drude {

namespace {

struct KnownDevice {
    uint16_t vendor, product;
    const char* name;
};

// Spectrometers of Ocean Optics, later Ocean Insight: 2457 the older, 0999 the newer ones.
constexpr KnownDevice spectrometers[] = {
    {0x2457, 0x1002, "Ocean Optics USB2000"},
    {0x2457, 0x100A, "Ocean Optics HR2000"},
    {0x2457, 0x1014, "Ocean Optics USB650"},
    {0x2457, 0x101E, "Ocean Optics USB2000+ / Flame-S"},
    {0x2457, 0x1016, "Ocean Optics HR2000+"},
    {0x2457, 0x1012, "Ocean Optics HR4000"},
    {0x2457, 0x1022, "Ocean Optics USB4000 / Flame-T"},
    {0x2457, 0x1018, "Ocean Optics QE65000"},
    {0x2457, 0x102A, "Ocean Optics Maya2000 Pro"},
    {0x2457, 0x102C, "Ocean Optics Maya"},
    {0x2457, 0x1046, "Ocean Optics Maya LSL"},
    {0x2457, 0x1026, "Ocean Optics NIRQuest512"},
    {0x2457, 0x1028, "Ocean Optics NIRQuest256"},
    {0x2457, 0x2000, "Ocean Optics Jaz"},
    {0x2457, 0x2003, "Ocean Optics HDX"},
    {0x2457, 0x4000, "Ocean Optics STS"},
    {0x2457, 0x4004, "Ocean Optics QE Pro"},
    {0x2457, 0x4200, "Ocean Optics Spark"},
    {0x2457, 0x5000, "Ocean Optics Ventana"},
    {0x0999, 0x1000, "Ocean Insight ST"},
    {0x0999, 0x1001, "Ocean Insight SR2"},
    {0x0999, 0x1002, "Ocean Insight SR4"},
    {0x0999, 0x1003, "Ocean Insight HR2"},
    {0x0999, 0x1004, "Ocean Insight HR4"},
    {0x0999, 0x1005, "Ocean Insight SR6"},
    {0x0999, 0x1006, "Ocean Insight HR6"},
};

constexpr uint16_t ftdi = 0x0403;
constexpr uint16_t ft230x = 0x6015;
constexpr uint16_t thorlabs_apt = 0xFAF0;

bool is_usbtmc(const UsbInterface& interface) {
    return interface.interface_class == 0xFE && interface.subclass == 0x03;
}

}  // namespace

InstrumentFamily instrument_family(uint16_t vendor, uint16_t product,
                                   const std::vector<UsbInterface>& interfaces) {
    for (const KnownDevice& known : spectrometers) {
        if (known.vendor == vendor && known.product == product) {
            return {known.name, "spectrometer", true};
        }
    }
    if (vendor == ftdi && product == thorlabs_apt) {
        return {"Thorlabs APT motor controller (K10CR1 among them)", "rotation mount", true};
    }
    if (vendor == ftdi && product == ft230x) {
        return {"FTDI FT230X serial port (in the Thorlabs ELL14 among others)", "rotation mount",
                false};
    }
    if (std::any_of(interfaces.begin(), interfaces.end(), is_usbtmc)) {
        return {"USB test and measurement instrument (USBTMC)", "instrument", true};
    }
    return {};
}

std::string udev_rule(uint16_t vendor, uint16_t product) {
    return fmt::format(
        "SUBSYSTEM==\"usb\", ATTR{{idVendor}}==\"{:04x}\", ATTR{{idProduct}}==\"{:04x}\", "
        "TAG+=\"uaccess\"",
        vendor, product);
}

}  // namespace drude
