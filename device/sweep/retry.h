// What a sweep does where a part of the bench fails.
#pragma once

#include <functional>
#include <string>

#include "device/device_error.h"
#include "device/sweep/bench_driver.h"

namespace drude {

struct RetryLimits {
    int transfer = 2;          // stalls, time-outs, short and bad frames, of one operation
    int mechanical = 1;        // a mount that did not arrive, an instrument that refused
    int unplugged = 3;         // times that a part may come back
    double reconnect_s = 120;  // to wait for it
};

// Runs operations again after faults: each is repeated from its beginning, so that no frame of a
// setting that was disturbed is kept.
class Retrier {
  public:
    // `log` is called once for each retry, with what failed and what is done about it.
    Retrier(BenchDriver& driver, RetryLimits limits, std::function<void(const std::string&)> log)
        : driver_(driver), limits_(limits), log_(std::move(log)) {}

    // Throws the last DeviceError, with the number of retries that did not help.
    void run(const std::function<void()>& operation);
    int retries() const { return retries_; }  // of the last run()

  private:
    struct Budget {
        int transfer = 0, mechanical = 0, unplugged = 0;
    };
    // Puts the failed part in order, or throws. What fails on the way counts as another fault.
    void repair(DeviceError error, Budget* used);
    void count(const DeviceError& error, Budget* used);

    BenchDriver& driver_;
    RetryLimits limits_;
    std::function<void(const std::string&)> log_;
    int retries_ = 0;
};

}  // namespace drude
