// What every fuzz target of an instrument does: bytes from a wire are read or refused as the
// device's fault.
//
// Anything but a return or a DeviceError that says what was wrong with them is a finding.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <span>

#include "device/device_error.h"

namespace drude {

// Whatever `read` is given, it throws nothing but these.
template <class Read>
void fuzz_answer(const Read& read) {
    try {
        read();
    } catch (const DeviceError& error) {
        const bool answer = error.fault() == Fault::bad_frame ||
                            error.fault() == Fault::short_read || error.fault() == Fault::refused;
        if (!answer || error.message().empty()) std::abort();
    }
}

}  // namespace drude
