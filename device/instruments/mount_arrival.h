// How a mount is known to have arrived, whatever it is commanded with.
#pragma once

#include <cmath>
#include <string>

#include "device/device_error.h"

namespace drude {

// `move` goes to `degrees` (`sent_deg` is the same place as the mount counts it) and returns what
// the mount reports then, modulo a turn. The result is the angle that it reports on the branch of
// `degrees`. Farther off than `tolerance_deg`, it is sent once more after `drop_late`, for what
// came may have answered an earlier command; then throws DeviceError (mechanical).
template <class Move, class DropLate>
double arrive(double degrees, double sent_deg, double tolerance_deg, const std::string& mount,
              const Move& move, const DropLate& drop_late) {
    for (int attempt = 0;; ++attempt) {
        const double at = move();
        const double off = std::remainder(at - degrees, 360);
        if (std::abs(off) <= tolerance_deg) return degrees + off;
        if (attempt > 0) {
            device_error(Fault::mechanical,
                         "{}: was sent to {:.3f} degrees twice and reports {:.3f}, more than {} "
                         "degrees away; check that nothing holds it",
                         mount, sent_deg, at, tolerance_deg);
        }
        drop_late();
    }
}

}  // namespace drude
