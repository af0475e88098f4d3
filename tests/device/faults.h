// Errors of devices, checked for what went wrong.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "device/device_error.h"
#include "device/spectrometer.h"

namespace drude {

// The fault of the DeviceError that `action` throws; fails the test where it throws none.
template <class Action>
Fault fault_of(const Action& action, std::string* message = nullptr) {
    try {
        action();
    } catch (const DeviceError& error) {
        if (message != nullptr) *message = error.message();
        return error.fault();
    }
    ADD_FAILURE() << "no DeviceError";
    return Fault::mechanical;
}

// The same, of a reader of bytes that was told to name the instrument "it" in its errors.
template <class Action>
Fault fault_of_it(const Action& action) {
    std::string message;
    const Fault fault = fault_of(action, &message);
    EXPECT_EQ(message.rfind("it:", 0), 0u) << message;
    return fault;
}

inline Fault fault_of_acquire(Spectrometer& spectrometer) {
    return fault_of([&] { spectrometer.acquire(); });
}

}  // namespace drude
