#include "device/bench_clock.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "base/interrupt.h"

namespace drude {

namespace {

class RealClock : public BenchClock {
  public:
    double now() const override {
        return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
            .count();
    }
    void sleep(double seconds) override {
        const double end = now() + seconds;
        for (double left = seconds; left > 0 && !interrupted(); left = end - now()) {
            // In pieces, so that a signal does not wait for the whole of it.
            std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left, 0.05)));
        }
    }
};

}  // namespace

BenchClock& real_clock() {
    static RealClock clock;
    return clock;
}

}  // namespace drude
