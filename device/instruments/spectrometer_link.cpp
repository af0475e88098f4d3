#include "device/instruments/spectrometer_link.h"

#include <algorithm>
#include <cmath>

#include "base/numbers.h"

namespace drude {

namespace {

constexpr double quiet_s = 0.02;

bool is_in(uint8_t endpoint) {
    return (endpoint & 0x80) != 0;
}

}  // namespace

bool may_pass(Fault fault) {
    switch (fault) {
        case Fault::timeout:
        case Fault::stall:
        case Fault::short_read:
        case Fault::overflow:
        case Fault::bad_frame:
        case Fault::io:
            return true;
        case Fault::unplugged:
        case Fault::refused:
        case Fault::mechanical:
        case Fault::interrupted:
            break;
    }
    return false;
}

void clear_transport(UsbPort& port, std::initializer_list<uint8_t> endpoints) {
    for (const uint8_t endpoint : endpoints) {
        if (port.packet_size(endpoint) > 0) port.clear_halt(endpoint);
    }
    drain_all(port, endpoints);
}

void drain_all(UsbPort& port, std::initializer_list<uint8_t> endpoints) {
    const Deadline end = deadline_in(4);
    for (size_t dropped = 1; dropped > 0 && std::chrono::steady_clock::now() < end;) {
        dropped = 0;
        for (const uint8_t endpoint : endpoints) {
            if (!is_in(endpoint) || port.packet_size(endpoint) == 0) continue;
            dropped += port.drain(endpoint, quiet_s, deadline_in(1));
        }
    }
}

size_t whole_packets(const UsbPort& port, uint8_t endpoint, size_t bytes) {
    const size_t packet = std::max<size_t>(port.packet_size(endpoint), 1);
    return (bytes + packet - 1) / packet * packet;
}

uint32_t integration_units(double seconds, double shortest, double longest, uint32_t unit_us,
                           uint32_t step_us, const std::string& device) {
    // Half a unit of slack, so that limits survive the way through decimal text.
    const double slack = 0.5e-6 * unit_us;
    if (!(seconds >= shortest - slack && seconds <= longest + slack)) {
        user_error("{}: an integration time of {} s is not possible; it takes {} s to {} s", device,
                   format_double(seconds), format_double(shortest), format_double(longest));
    }
    const double least = std::ceil(shortest * 1e6 / step_us - 1e-6);
    const double most = std::floor(longest * 1e6 / step_us + 1e-6);
    const double steps = std::clamp(std::round(seconds * 1e6 / step_us), least, most);
    return static_cast<uint32_t>(std::llround(steps * (step_us / unit_us)));
}

void check_serial(const std::string& found, const std::string& expected,
                  const std::string& device) {
    if (found == expected) return;
    device_error(Fault::refused,
                 "{}: the spectrometer that came back has the serial number '{}'; expected '{}', "
                 "whose wavelengths are in use",
                 device, found, expected);
}

}  // namespace drude
