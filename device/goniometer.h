// The arms of an ellipsometer: which angle the light meets the sample at, and where the detector
// is.
#pragma once

#include <string>

namespace drude {

class Goniometer {
  public:
    virtual ~Goniometer() = default;
    virtual std::string description() const = 0;  // for journals and prompts
    // Light meets the sample `incidence_deg` from its normal, in (0, 90), and the detector stands
    // `offset_deg` beyond the mirror direction (positive: away from the normal), in the plane of
    // incidence. Throws Error where it cannot go there, DeviceError where it did not.
    virtual void move_to(double incidence_deg, double offset_deg) = 0;
    // Arms in one line, no sample in the beam.
    virtual void straight_through() = 0;
    virtual void recover() = 0;
    virtual bool reconnect(double seconds) = 0;
};

}  // namespace drude
