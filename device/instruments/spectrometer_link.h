// What the drivers of spectrometers share: fresh starts, retries, ranges.
#pragma once

#include <initializer_list>
#include <string>

#include "device/bench_clock.h"
#include "device/device_error.h"
#include "device/usb/usb_port.h"

namespace drude {

// A fault that clearing and trying again may cure.
bool may_pass(Fault fault);

// Clears the halts of all endpoints and drops what the IN endpoints hold.
void clear_transport(UsbPort& port, std::initializer_list<uint8_t> endpoints);

// Only drops what they hold, and what arrives meanwhile: of a message in two parts the second must
// not stay behind because the first came to an endpoint whose turn was over.
void drain_all(UsbPort& port, std::initializer_list<uint8_t> endpoints);

// Buffer size for a message of `bytes` from `endpoint`: a multiple of its packet size, so that a
// message that is longer than it should be is seen as such instead of spilling over.
size_t whole_packets(const UsbPort& port, uint8_t endpoint, size_t bytes);

// The integration time in units of `unit_us` microseconds, at the nearest multiple of `step_us` (a
// multiple of the unit) that is not below `shortest`. Throws Error (user) outside `shortest` to
// `longest` seconds, and for NaN.
uint32_t integration_units(double seconds, double shortest, double longest, uint32_t unit_us,
                           uint32_t step_us, const std::string& device);

// Throws DeviceError (refused) where the spectrometer that came back is another one.
void check_serial(const std::string& found, const std::string& expected, const std::string& device);

// Runs `attempt` until it succeeds, at most three times, with `cure` after a fault that may pass.
template <class Attempt, class Cure>
void with_retries(const Attempt& attempt, const Cure& cure) {
    for (int i = 0;; ++i) {
        try {
            attempt();
            return;
        } catch (const DeviceError& error) {
            if (i == 2 || !may_pass(error.fault())) throw;
        }
        cure();
    }
}

}  // namespace drude
