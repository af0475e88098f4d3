#include "device/virtual/free_run.h"

#include <cmath>

namespace drude {

FreeRun::Exposure FreeRun::running_at(double now_s) const {
    if (now_s < later_.start_s) return before_;
    const double period = later_.integration_s + clearing_s;
    Exposure running = later_;
    running.start_s += std::floor((now_s - later_.start_s) / period) * period;
    return running;
}

void FreeRun::set_integration(double now_s, double integration_s) {
    if (integration_s == later_.integration_s) return;
    if (now_s >= later_.start_s) {
        before_ = running_at(now_s);
        later_.start_s = before_.end_s() + clearing_s;
    }
    later_.integration_s = integration_s;
    // A frame that has not begun yet begins with the new time.
    if (next_.start_s >= later_.start_s) next_ = later_;
}

FreeRun::Exposure FreeRun::hand_out(double now_s) {
    const Exposure given = next_;
    next_ = running_at(now_s);
    if (next_.start_s <= given.start_s) {
        // Read as it ends: rounding, or the clearing, still counts that instant to it.
        next_ = running_at(given.end_s() + 1.5 * clearing_s);
    }
    return given;
}

}  // namespace drude
