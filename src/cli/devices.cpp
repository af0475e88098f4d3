// `drude devices`: what a measurement could be made with.
#include <cstdio>
#include <memory>

#include "base/error.h"
#include "cli/command_list.h"
#include "cli/json_output.h"
#include "cli/warnings.h"
#include "device/instruments/registry.h"
#include "device/usb/usb_listing.h"

namespace drude {

namespace {

using nlohmann::ordered_json;

struct DevicesOptions {
    bool all = false;
    bool udev_rules = false;
};

// What the driver of a scheme plays in a bench, or an empty string.
std::string role_of(const std::string& scheme) {
    for (const InstrumentDriver& driver : instrument_drivers()) {
        if (driver.scheme == scheme) return driver.plays;
    }
    return {};
}

std::string capabilities_of(const UsbDevice& device) {
    return instrument_capabilities(device.family.scheme, device.vendor, device.product);
}

void print_json(const UsbListing& listing) {
    ordered_json devices = ordered_json::array();
    for (const UsbDevice& device : listing.devices) {
        ordered_json entry = {{"vendor", fmt::format("{:04x}", device.vendor)},
                              {"product", fmt::format("{:04x}", device.product)},
                              {"bus", device.bus},
                              {"address", device.address},
                              {"serial", device.serial},
                              {"manufacturer", device.manufacturer},
                              {"product_name", device.product_name},
                              {"family", device.family.name},
                              {"kind", device.family.kind},
                              {"family_certain", device.family.certain},
                              {"uri", device.uri},
                              {"plays", role_of(device.family.scheme)},
                              {"capabilities", capabilities_of(device)},
                              {"speed", device.high_speed ? "high" : "full"},
                              {"permitted", device.permitted},
                              {"problem", device.problem}};
        if (!device.permitted) entry["udev_rule"] = udev_rule(device.vendor, device.product);
        devices.push_back(std::move(entry));
    }
    const ordered_json document = {
        {"usb", devices}, {"note", listing.note}, {"virtual", "virtual:MATERIAL"}};
    print_json_document(document);
}

void print_device(const UsbDevice& device) {
    const bool known = !device.family.name.empty();
    std::string what = known ? device.family.name : device.product_name;
    if (what.empty()) what = "no instrument known here";
    fmt::print("usb {:03}:{:03}  {:04x}:{:04x}  serial {:<16}  {}{}\n", device.bus, device.address,
               device.vendor, device.product, device.serial.empty() ? "-" : device.serial, what,
               known ? fmt::format(" ({}{})", device.family.certain ? "" : "perhaps a ",
                                   device.family.kind)
                     : "");
    if (!device.uri.empty()) fmt::print("  {:<28}{}\n", device.uri, capabilities_of(device));
}

void print_text(const UsbListing& listing, bool all) {
    size_t others = 0, known = 0;
    for (const UsbDevice& device : listing.devices) {
        const bool is_known = !device.family.name.empty();
        ++(is_known ? known : others);
        if (is_known || all) print_device(device);
    }
    if (known == 0) {
        fmt::print("No instrument found on USB{}.\n",
                   listing.note.empty() ? "" : ": " + listing.note);
    }
    if (others > 0 && !all) {
        fmt::print("{} other USB device{}; --all lists {} too.\n", others, others == 1 ? "" : "s",
                   others == 1 ? "it" : "them");
    }
    fmt::print(
        "virtual:MATERIAL  always there: a simulated ellipsometer, e.g. virtual:Cu, "
        "virtual:Au-Johnson (drude materials lists the sets)\n");
    for (const UsbDevice& device : listing.devices) {
        if (device.family.name.empty() || device.problem.empty()) continue;
        print_warning(fmt::format("{:04x}:{:04x} on bus {:03}, device {:03}: {}", device.vendor,
                                  device.product, device.bus, device.address, device.problem));
        if (device.permitted) continue;
        fmt::print(stderr,
                   "  To let the user at this machine open it, put this line into\n"
                   "  /etc/udev/rules.d/{}, then plug the device in again (drude devices\n"
                   "  --udev-rules prints a file for all instruments that are known here):\n"
                   "    {}\n",
                   udev_rules_name, udev_rule(device.vendor, device.product));
    }
}

}  // namespace

Command devices_command() {
    Command command;
    command.name = "devices";
    command.summary = "List the instruments that are plugged in";
    command.description =
        "Lists USB devices that belong to an instrument family known here: Ocean Optics "
        "spectrometers, Thorlabs rotation mounts (behind FTDI serial-port chips), and USBTMC "
        "instruments. A device that this user may not open is named with the udev rule that "
        "changes it. Devices are only asked for their names. Below each stands the URI by which a "
        "bench file names it, and what it can do; an Elliptec URI ends with the mount's address on "
        "its bus, 0 where nobody changed it. The simulated ellipsometer virtual:MATERIAL is always "
        "there.\n\n"
        "--udev-rules prints the rules file that 'cmake --install' puts into lib/udev/rules.d; it "
        "belongs into /etc/udev/rules.d where the program was installed elsewhere than /usr.\n\n"
        "A machine without USB is no error: the list is then empty.";
    command.example =
        "$ drude devices\n"
        "usb 001:004  2457:1022  serial FLMT01234         Ocean Optics USB4000 / Flame-T "
        "(spectrometer)\n"
        "  ooi:FLMT01234               intensities of 3840 pixels, integration 10 us to 65.53 s, "
        "lamp line\n"
        "virtual:MATERIAL  always there: a simulated ellipsometer, ...\n";
    command.declare = [](OptionSet& options, const CommonOptions& common) {
        const auto values = std::make_shared<DevicesOptions>();
        options.flag("--all", values->all, "list every USB device, hubs excepted");
        options.flag("--udev-rules", values->udev_rules,
                     "print the udev rules of all instruments known here, and list nothing");
        return [values, &common] {
            if (values->udev_rules) {
                if (common.json) {
                    print_json_document(ordered_json{{"file_name", udev_rules_name},
                                                     {"udev_rules", udev_rules_file()}});
                } else {
                    fmt::print("{}", udev_rules_file());
                }
                return 0;
            }
            const UsbListing listing = list_usb_devices();
            if (common.json) {
                print_json(listing);
            } else {
                print_text(listing, values->all);
            }
            return 0;
        };
    };
    return command;
}

}  // namespace drude
