#include "device/sweep/fresh_frame.h"

#include <algorithm>
#include <limits>

#include "device/device_error.h"

namespace drude {

namespace {

constexpr int most_discarded = 8;

}  // namespace

double earliest_begin(const Frame& frame, double requested_before_s, double integration_s,
                      double readout_s) {
    const double in_buffer = requested_before_s - integration_s;
    const bool waited_for = frame.arrived_s - frame.requested_s > readout_s + 1e-6;
    return waited_for ? std::max(in_buffer, frame.arrived_s - integration_s - readout_s)
                      : in_buffer;
}

FreshFrame acquire_fresh(Spectrometer& spectrometer, double settled_s,
                         const std::function<void()>& between, int least) {
    FreshFrame fresh;
    double before_s = -std::numeric_limits<double>::infinity();
    for (;;) {
        if (between) between();
        fresh.frame = spectrometer.acquire();
        const double begun_s = earliest_begin(
            fresh.frame, before_s, spectrometer.integration_time(), spectrometer.info().readout_s);
        before_s = fresh.frame.requested_s;
        if (fresh.discarded >= least && begun_s >= settled_s) return fresh;
        if (++fresh.discarded > most_discarded) {
            device_error(Fault::bad_frame,
                         "{}: {} frames in a row arrived sooner than an integration time of {} s "
                         "after the bench stood still: they began before",
                         spectrometer.info().uri, fresh.discarded, spectrometer.integration_time());
        }
    }
}

}  // namespace drude
