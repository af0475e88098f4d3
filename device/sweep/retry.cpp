#include "device/sweep/retry.h"

#include <optional>

namespace drude {

void Retrier::run(const std::function<void()>& operation) {
    Budget used;
    retries_ = 0;
    for (;;) {
        std::optional<DeviceError> failed;
        try {
            operation();
            return;
        } catch (const DeviceError& error) {
            failed = error;
        }
        repair(*failed, &used);
    }
}

void Retrier::count(const DeviceError& error, Budget* used) {
    const auto spend = [&](int* spent, int limit) {
        if (++*spent <= limit) return;
        throw DeviceError(
            error.fault(),
            retries_ == 0
                ? error.message()
                : fmt::format("{} ({} {} not help)", error.message(),
                              retries_ == 1 ? "a retry" : fmt::format("{} retries", retries_),
                              "did"));
    };
    switch (error.fault()) {
        case Fault::unplugged:
            spend(&used->unplugged, limits_.unplugged);
            break;
        case Fault::mechanical:
        case Fault::refused:
            spend(&used->mechanical, limits_.mechanical);
            break;
        default:
            spend(&used->transfer, limits_.transfer);
    }
    ++retries_;
}

void Retrier::repair(DeviceError error, Budget* used) {
    for (;;) {
        count(error, used);
        const bool gone = error.fault() == Fault::unplugged;
        log_(fmt::format("{}: {}: {}; {}", driver_.part_name(), fault_name(error.fault()),
                         error.message(), gone ? "waiting for it to come back" : "measured again"));
        try {
            if (!gone) {
                driver_.recover();
            } else if (!driver_.reconnect(limits_.reconnect_s)) {
                // Spent: nothing is waited for a second time.
                used->unplugged = limits_.unplugged;
                throw DeviceError(Fault::unplugged,
                                  fmt::format("{}; it did not come back within {} s",
                                              error.message(), limits_.reconnect_s));
            }
            return;
        } catch (const DeviceError& next) {
            error = next;
        }
    }
}

}  // namespace drude
