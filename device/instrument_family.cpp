#include "device/instrument_family.h"

#include <fmt/format.h>

#include <algorithm>

namespace drude {

namespace {

constexpr uint16_t ftdi = 0x0403;

KnownInstrument spectrometer(uint16_t vendor, uint16_t product, const char* scheme,
                             const char* name) {
    return {vendor, product, {name, "spectrometer", true, scheme}};
}

bool is_usbtmc(const UsbInterface& interface) {
    return interface.interface_class == 0xFE && interface.subclass == 0x03;
}

}  // namespace

const std::vector<KnownInstrument>& known_instruments() {
    // Spectrometers of Ocean Optics, later Ocean Insight: 2457 the older, 0999 the newer ones.
    static const std::vector<KnownInstrument> known = {
        spectrometer(0x2457, 0x1002, "ooi", "Ocean Optics USB2000"),
        spectrometer(0x2457, 0x100A, "ooi", "Ocean Optics HR2000"),
        spectrometer(0x2457, 0x1012, "ooi", "Ocean Optics HR4000"),
        spectrometer(0x2457, 0x1014, "ooi", "Ocean Optics USB650"),
        spectrometer(0x2457, 0x1016, "ooi", "Ocean Optics HR2000+"),
        spectrometer(0x2457, 0x1018, "ooi", "Ocean Optics QE65000"),
        spectrometer(0x2457, 0x101E, "ooi", "Ocean Optics USB2000+ / Flame-S"),
        spectrometer(0x2457, 0x1022, "ooi", "Ocean Optics USB4000 / Flame-T"),
        spectrometer(0x2457, 0x1026, "ooi", "Ocean Optics NIRQuest512"),
        spectrometer(0x2457, 0x1028, "ooi", "Ocean Optics NIRQuest256"),
        spectrometer(0x2457, 0x102A, "ooi", "Ocean Optics Maya2000 Pro"),
        spectrometer(0x2457, 0x102C, "ooi", "Ocean Optics Maya"),
        spectrometer(0x2457, 0x1046, "ooi", "Ocean Optics Maya LSL"),
        spectrometer(0x2457, 0x2000, "ooi", "Ocean Optics Jaz"),
        spectrometer(0x2457, 0x2003, "obp", "Ocean Optics HDX"),
        spectrometer(0x2457, 0x4000, "obp", "Ocean Optics STS"),
        spectrometer(0x2457, 0x4004, "obp", "Ocean Optics QE Pro"),
        spectrometer(0x2457, 0x4200, "obp", "Ocean Optics Spark"),
        spectrometer(0x2457, 0x5000, "obp", "Ocean Optics Ventana"),
        spectrometer(0x0999, 0x1000, "obp", "Ocean Insight ST"),
        spectrometer(0x0999, 0x1001, "obp", "Ocean Insight SR2"),
        spectrometer(0x0999, 0x1002, "obp", "Ocean Insight SR4"),
        spectrometer(0x0999, 0x1003, "obp", "Ocean Insight HR2"),
        spectrometer(0x0999, 0x1004, "obp", "Ocean Insight HR4"),
        spectrometer(0x0999, 0x1005, "obp", "Ocean Insight SR6"),
        spectrometer(0x0999, 0x1006, "obp", "Ocean Insight HR6"),
        {ftdi,
         0xFAF0,
         {"Thorlabs APT motor controller (K10CR1 among them)", "rotation mount", true, "apt"}},
        {ftdi,
         0x6015,
         {"FTDI FT230X serial port (in the Thorlabs ELL14 among others)", "rotation mount", false,
          "ell"}},
    };
    return known;
}

InstrumentFamily instrument_family(uint16_t vendor, uint16_t product,
                                   const std::vector<UsbInterface>& interfaces) {
    for (const KnownInstrument& known : known_instruments()) {
        if (known.vendor == vendor && known.product == product) return known.family;
    }
    if (std::any_of(interfaces.begin(), interfaces.end(), is_usbtmc)) {
        return {"USB test and measurement instrument (USBTMC)", "instrument", true, "usbtmc"};
    }
    return {};
}

std::string instrument_uri(const std::string& scheme, uint16_t vendor, uint16_t product,
                           const std::string& serial) {
    if (scheme.empty()) return {};
    if (scheme == "usbtmc") return fmt::format("usbtmc:{:04x}:{:04x}:{}", vendor, product, serial);
    return fmt::format("{}:{}{}", scheme, serial, scheme == "ell" ? "/0" : "");
}

std::string udev_rule(uint16_t vendor, uint16_t product) {
    return fmt::format(
        "SUBSYSTEM==\"usb\", ATTR{{idVendor}}==\"{:04x}\", ATTR{{idProduct}}==\"{:04x}\", "
        "TAG+=\"uaccess\"",
        vendor, product);
}

std::string udev_rules_file() {
    std::string text =
        "# Lets the user who sits at this machine open the instruments that drude knows.\n"
        "# Belongs into /etc/udev/rules.d or /usr/lib/udev/rules.d under a name that sorts before\n"
        "# 73-seat-late.rules. Then: udevadm control --reload, and plug the device in again.\n"
        "# Users without a seat (ssh) need a group instead: MODE=\"0660\", GROUP=\"plugdev\".\n";
    for (const KnownInstrument& known : known_instruments()) {
        text +=
            fmt::format("\n# {}\n{}\n", known.family.name, udev_rule(known.vendor, known.product));
    }
    text +=
        "\n# USB test and measurement instruments (USBTMC), by their interface's class\n"
        "SUBSYSTEM==\"usb\", ENV{DEVTYPE}==\"usb_device\", "
        "ENV{ID_USB_INTERFACES}==\"*:fe03??:*\", TAG+=\"uaccess\"\n";
    return text;
}

}  // namespace drude
