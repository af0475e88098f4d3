// What goes wrong with an instrument, in kinds that a sweep acts on.
#pragma once

#include <string>
#include <utility>

#include "base/error.h"

namespace drude {

enum class Fault {
    timeout,      // no answer before the deadline
    stall,        // the endpoint is halted
    short_read,   // fewer bytes than the protocol says
    overflow,     // more bytes than asked for
    bad_frame,    // a sync byte, checksum, echo or length that is wrong
    unplugged,    // gone from the bus
    io,           // the host controller or the kernel says no
    refused,      // the instrument answered that it will not or cannot
    mechanical,   // a mount that did not arrive, or not where it was sent
    interrupted,  // a signal asked the program to stop (base/interrupt.h); nothing is wrong
};

// "time-out", "stall", ...: what journals and tests call it.
const char* fault_name(Fault fault);

// Of the outside (exit 3). Devices that are not there, ambiguous, busy or not permitted are plain
// Errors: no retry helps.
class DeviceError : public Error {
  public:
    DeviceError(Fault fault, const std::string& message)
        : Error(Cause::outside, message), fault_(fault) {}
    Fault fault() const { return fault_; }

  private:
    Fault fault_;
};

template <class... Args>
[[noreturn]] void device_error(Fault fault, fmt::format_string<Args...> format, Args&&... args) {
    throw DeviceError(fault, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace drude
