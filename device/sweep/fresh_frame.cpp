#include "device/sweep/fresh_frame.h"

#include "device/device_error.h"

namespace drude {

namespace {

constexpr int most_discarded = 8;

}  // namespace

FreshFrame acquire_fresh(Spectrometer& spectrometer, double settled_s,
                         const std::function<void()>& between) {
    FreshFrame fresh;
    for (;;) {
        if (between) between();
        fresh.frame = spectrometer.acquire();
        const double earliest_begin =
            fresh.frame.arrived_s - spectrometer.integration_time() - spectrometer.info().readout_s;
        if (fresh.discarded > 0 && earliest_begin >= settled_s) return fresh;
        if (++fresh.discarded > most_discarded) {
            device_error(Fault::bad_frame,
                         "{}: {} frames in a row arrived sooner than an integration time of {} s "
                         "after the bench stood still: they began before",
                         spectrometer.info().uri, fresh.discarded, spectrometer.integration_time());
        }
    }
}

}  // namespace drude
