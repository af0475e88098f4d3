#include "device/instruments/registry.h"

#include <fmt/ranges.h>

#include <map>
#include <utility>

#include "base/error.h"
#include "base/numbers.h"
#include "device/instruments/apt_rotator.h"
#include "device/instruments/elliptec.h"
#include "device/instruments/obp_models.h"
#include "device/instruments/obp_spectrometer.h"
#include "device/instruments/ooi_models.h"
#include "device/instruments/ooi_spectrometer.h"
#include "device/instruments/scpi_head.h"
#include "device/usb/usb_device.h"
#include "device/usb/usb_listing.h"

namespace drude {

namespace {

const InstrumentDriver& driver_of(const std::string& scheme) {
    for (const InstrumentDriver& driver : instrument_drivers()) {
        if (driver.scheme == scheme) return driver;
    }
    throw std::logic_error("no driver for a scheme that was parsed");
}

InstrumentUri parse_for(const std::string& uri, const std::string& role) {
    const InstrumentUri parsed = parse_instrument_uri(uri);
    const InstrumentDriver& driver = driver_of(parsed.scheme);
    if (driver.plays.find(role) != std::string::npos) return parsed;
    std::vector<std::string> others;
    for (const InstrumentDriver& other : instrument_drivers()) {
        if (other.plays.find(role) != std::string::npos) others.push_back(other.scheme + ":");
    }
    user_error("'{}' plays {}, where a {} is wanted ({})", uri, driver.plays, role,
               fmt::join(others, ", "));
}

UsbTarget target_of(const InstrumentUri& uri) {
    UsbTarget target;
    target.scheme = uri.scheme;
    target.serial = uri.serial;
    target.ids = usb_ids(uri.scheme);
    if (uri.scheme == "ooi") {
        target.what = "Ocean Optics spectrometer of the OOI protocol";
        target.ask_serial = ask_ooi_serial;
    } else if (uri.scheme == "obp") {
        target.what = "Ocean Optics spectrometer of the OBP protocol";
        target.ask_serial = ask_obp_serial;
    } else if (uri.scheme == "ell") {
        target.what = "Thorlabs Elliptec bus (FTDI FT230X)";
    } else if (uri.scheme == "apt") {
        target.what = "Thorlabs APT controller";
    } else {
        target.what = fmt::format("USBTMC instrument {:04x}:{:04x}", uri.vendor, uri.product);
        target.ids = {{uri.vendor, uri.product}};
    }
    return target;
}

// The port of an Elliptec bus, shared by all mounts that are open on it.
std::shared_ptr<UsbPort> open_bus(const InstrumentUri& uri) {
    static std::map<std::string, std::weak_ptr<UsbPort>> open_ports;
    UsbTarget target = target_of(uri);
    if (target.serial.empty()) {
        // Which one "the only one" is has to be known before it is looked for among those that are
        // open: to the bus they are busy.
        std::vector<std::string> serials;
        for (const UsbDevice& device : list_usb_devices().devices) {
            if (device.family.scheme == "ell") serials.push_back(device.serial);
        }
        if (serials.size() == 1) target.serial = serials[0];
    }
    if (std::shared_ptr<UsbPort> port = open_ports[target.serial].lock()) return port;
    std::shared_ptr<UsbPort> port = open_usb(target);
    open_ports[port->serial()] = port;
    return port;
}

// "10 us", "3.8 ms", "65.535 s".
std::string shown_time(uint32_t microseconds) {
    const double value = microseconds;
    if (value < 1e3) return fmt::format("{:g} us", value);
    if (value < 1e6) return fmt::format("{:g} ms", 1e-3 * value);
    return fmt::format("{:.4g} s", 1e-6 * value);
}

template <class Model>
std::string spectrometer_capabilities(const Model& model, bool lamp) {
    return fmt::format("intensities of {} pixels, integration {} to {}{}", model.pixels,
                       shown_time(model.shortest_us), shown_time(model.longest_us),
                       lamp ? ", lamp line" : "");
}

}  // namespace

const std::vector<InstrumentDriver>& instrument_drivers() {
    static const std::vector<InstrumentDriver> drivers = {
        {"ooi", "spectrometer",
         "Ocean Optics USB2000+ / Flame-S, USB4000 / Flame-T, HR2000+, HR4000, QE65000, Maya, "
         "NIRQuest, Jaz, USB2000, HR2000, USB650",
         "intensities, calibration from its memory, lamp line"},
        {"obp", "spectrometer",
         "Ocean Optics STS, Spark, Ventana, HDX, QE Pro; Ocean Insight SR2, SR4, SR6, HR2, HR4, "
         "HR6, ST",
         "intensities, calibration from its memory, checksums"},
        {"ell", "rotator", "Thorlabs Elliptec rotation mounts (ELL14) on an FTDI FT230X",
         "turns an element; up to 16 mounts a bus, the address 0 to F stands after the slash"},
        {"apt", "rotator", "Thorlabs K10CR1", "turns an element or an arm"},
        {"usbtmc", "head or spectrometer", "SCPI instruments over USBTMC",
         "Psi and Delta, or intensities, as its firmware has them"},
    };
    return drivers;
}

std::string instrument_capabilities(const std::string& scheme, uint16_t vendor, uint16_t product) {
    if (scheme == "ooi") {
        if (const OoiModel* model = find_ooi_model(product)) {
            return spectrometer_capabilities(*model, true);
        }
    }
    if (scheme == "obp") {
        if (const ObpModel* model = find_obp_model(vendor, product)) {
            return spectrometer_capabilities(*model, false);
        }
    }
    for (const InstrumentDriver& driver : instrument_drivers()) {
        if (driver.scheme == scheme) return driver.capabilities;
    }
    return {};
}

std::shared_ptr<Spectrometer> open_spectrometer(const std::string& uri,
                                                const ScpiCommands& commands) {
    const InstrumentUri parsed = parse_for(uri, "spectrometer");
    std::shared_ptr<UsbPort> port = open_usb(target_of(parsed));
    if (parsed.scheme == "ooi") return open_ooi(std::move(port));
    if (parsed.scheme == "obp") return open_obp(std::move(port));
    return open_scpi_spectrometer(std::move(port), commands);
}

std::shared_ptr<Rotator> open_rotator(const std::string& uri) {
    const InstrumentUri parsed = parse_for(uri, "rotator");
    if (parsed.scheme == "ell") return open_elliptec(open_bus(parsed), parsed.address[0]);
    return open_apt(open_usb(target_of(parsed)));
}

std::shared_ptr<PsiDeltaHead> open_head(const std::string& uri, const ScpiCommands& commands) {
    return open_scpi_head(open_usb(target_of(parse_for(uri, "head"))), commands);
}

}  // namespace drude
