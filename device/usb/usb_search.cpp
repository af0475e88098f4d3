#include "device/usb/usb_search.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "device/instrument_family.h"

namespace drude {

namespace {

bool fits(const UsbTarget& target, const libusb_device_descriptor& descriptor,
          const InstrumentFamily& family) {
    if (target.ids.empty()) return family.scheme == target.scheme;
    return std::find(target.ids.begin(), target.ids.end(),
                     UsbId{descriptor.idVendor, descriptor.idProduct}) != target.ids.end();
}

// Candidates by bus and address; `others` names instruments that do not fit.
std::vector<UsbCandidate> list_candidates(libusb_context* context, const UsbTarget& target,
                                          std::vector<std::string>* others) {
    std::vector<UsbCandidate> candidates;
    std::string problem;
    for (DevicePointer& device : list_devices(context, &problem)) {
        libusb_device_descriptor descriptor;
        libusb_get_device_descriptor(device.get(), &descriptor);
        const InstrumentFamily family = instrument_family(descriptor.idVendor, descriptor.idProduct,
                                                          read_interfaces(device.get()));
        if (!fits(target, descriptor, family)) {
            if (!family.name.empty()) others->push_back(family.name);
            continue;
        }
        UsbCandidate candidate;
        candidate.vendor = descriptor.idVendor;
        candidate.product = descriptor.idProduct;
        candidate.bus = libusb_get_bus_number(device.get());
        candidate.address = libusb_get_device_address(device.get());
        candidate.family_name = family.name.empty() ? target.what : family.name;
        libusb_device_handle* raw = nullptr;
        candidate.open_status = libusb_open(device.get(), &raw);
        if (candidate.open_status == 0) {
            candidate.handle.reset(raw);
            int failed = 0;
            candidate.serial = read_string(raw, descriptor.iSerialNumber, &failed);
            if (failed == LIBUSB_ERROR_NO_DEVICE) continue;  // it has just left
            if (failed != 0) candidate.serial_problem = libusb_strerror(failed);
        }
        candidate.device = std::move(device);
        candidates.push_back(std::move(candidate));
    }
    if (!problem.empty()) outside_error("the USB devices could not be listed ({})", problem);
    return candidates;
}

std::string uri_of(const UsbTarget& target, const UsbCandidate& candidate) {
    return instrument_uri(target.scheme, candidate.vendor, candidate.product, candidate.serial);
}

std::vector<std::string> uris_of(const UsbTarget& target,
                                 const std::vector<UsbCandidate>& candidates) {
    std::vector<std::string> uris;
    for (const UsbCandidate& candidate : candidates) uris.push_back(uri_of(target, candidate));
    return uris;
}

// "Ocean Optics USB4000 / Flame-T on bus 001, device 004".
std::string placed(const UsbCandidate& candidate) {
    return fmt::format("{} on bus {:03}, device {:03}", candidate.family_name, candidate.bus,
                       candidate.address);
}

[[noreturn]] void serial_unknown(const UsbTarget& target, const UsbCandidate& candidate) {
    outside_error(
        "{} may be the one with the serial number {}, or not: its own could not be read ({}); "
        "unplug it, plug it in again, and try again",
        placed(candidate), target.serial, candidate.serial_problem);
}

// A serial number chooses among those that differ in it; the others have to be alone.
[[noreturn]] void several_fit(const UsbTarget& target,
                              const std::vector<const UsbCandidate*>& candidates) {
    std::vector<std::string> named, nameless;
    for (const UsbCandidate* one : candidates) {
        const auto same =
            std::count_if(candidates.begin(), candidates.end(),
                          [&](const UsbCandidate* other) { return other->serial == one->serial; });
        if (!one->serial.empty() && same == 1) {
            named.push_back(uri_of(target, *one));
            continue;
        }
        nameless.push_back(placed(*one));
        if (!one->serial_problem.empty()) {
            nameless.back() +=
                fmt::format(" (its serial number could not be read: {})", one->serial_problem);
        }
    }
    std::string message = fmt::format("{} devices fit '{}:{}' ({})", candidates.size(),
                                      target.scheme, target.serial, target.what);
    if (!named.empty()) message += fmt::format("; say which one: {}", fmt::join(named, ", "));
    if (!nameless.empty()) {
        message += fmt::format(
            "; no serial number tells {} apart: unplug all of these but the one that is meant{}: "
            "{}",
            named.empty() ? "them" : "some of them", named.empty() ? "" : ", or name another",
            fmt::join(nameless, ", "));
    }
    user_error("{}", message);
}

[[noreturn]] void none_fits(const UsbTarget& target, const std::vector<UsbCandidate>& candidates,
                            const std::vector<std::string>& others) {
    std::string message = fmt::format("no {}", target.what);
    if (!target.serial.empty()) message += fmt::format(" with the serial number {}", target.serial);
    message += " is plugged in";
    std::vector<std::string> serials;
    for (const UsbCandidate& candidate : candidates) serials.push_back(candidate.serial);
    if (!target.serial.empty()) message += did_you_mean(target.serial, serials);
    if (!candidates.empty()) {
        message += fmt::format("; there is {}", fmt::join(uris_of(target, candidates), ", "));
    } else if (!others.empty()) {
        message += fmt::format("; there is {}", fmt::join(others, ", "));
    }
    throw NoSuchDevice(Cause::outside,
                       message +
                           "; check its cable and power ('drude devices' lists what is "
                           "plugged in)");
}

[[noreturn]] void cannot_open(const UsbTarget& target, const UsbCandidate& candidate) {
    const std::string name = shown_device(target.scheme, candidate);
    if (candidate.open_status == LIBUSB_ERROR_ACCESS) {
        outside_error("{}: {}", name, explain_access(candidate.vendor, candidate.product));
    }
    if (candidate.open_status == LIBUSB_ERROR_NO_DEVICE) {
        throw NoSuchDevice(Cause::outside, name + ": it was unplugged while it was opened");
    }
    outside_error("{}: the system does not open it ({})", name,
                  libusb_strerror(candidate.open_status));
}

}  // namespace

UsbCandidate find_device(libusb_context* context, const UsbTarget& target,
                         const std::function<void(UsbCandidate&)>& ask) {
    std::vector<std::string> others;
    std::vector<UsbCandidate> candidates = list_candidates(context, target, &others);
    if (candidates.empty()) none_fits(target, candidates, others);

    const auto with_serial = [&] {
        std::vector<size_t> found;
        for (size_t i = 0; i < candidates.size(); ++i) {
            if (target.serial.empty() || candidates[i].serial == target.serial) found.push_back(i);
        }
        return found;
    };
    std::vector<size_t> meant = with_serial();
    // Ask only where a descriptor's silence leaves open which device is meant.
    if (meant.size() != 1) {
        for (UsbCandidate& candidate : candidates) {
            if (candidate.handle && candidate.serial.empty()) ask(candidate);
        }
        meant = with_serial();
    }
    if (meant.size() == 1) {
        UsbCandidate& chosen = candidates[meant[0]];
        if (!chosen.handle) cannot_open(target, chosen);
        return std::move(chosen);
    }
    if (meant.empty()) {
        // A device that may not be opened keeps its serial number to itself.
        for (const UsbCandidate& candidate : candidates) {
            if (!candidate.handle) cannot_open(target, candidate);
            if (!candidate.serial_problem.empty()) serial_unknown(target, candidate);
        }
        none_fits(target, candidates, others);
    }
    std::vector<const UsbCandidate*> all;
    for (const size_t i : meant) all.push_back(&candidates[i]);
    several_fit(target, all);
}

std::string shown_device(const std::string& scheme, const UsbCandidate& candidate) {
    std::string uri = instrument_uri(scheme, candidate.vendor, candidate.product, candidate.serial);
    // Which mount of the bus is meant is for the mount to say.
    if (scheme == "ell") uri.resize(uri.size() - 2);
    return fmt::format("{} ({})", candidate.family_name, uri);
}

std::string explain_access(uint16_t vendor, uint16_t product) {
    return fmt::format(
        "this user may not open it. Put this line into /etc/udev/rules.d/{}, run 'sudo udevadm "
        "control --reload', then plug the device in again:\n  {}",
        udev_rules_name, udev_rule(vendor, product));
}

}  // namespace drude
