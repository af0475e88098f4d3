// What a sweep asks of anything that turns: polariser, analyser, retarder arm, goniometer.
#pragma once

#include <string>

namespace drude {

struct RotatorInfo {
    std::string uri;  // "ell:DK0AELL1/0", "apt:55000001"
    std::string model, serial;
    double units_per_degree = 0;   // of the device's own encoder
    double repeatability_deg = 0;  // standard deviation of where it ends against what it reports
    double tolerance_deg = 0;      // reported against commanded: more is a fault
};

class Rotator {
  public:
    virtual ~Rotator() = default;
    virtual const RotatorInfo& info() const = 0;
    // Finds the reference mark; the position afterwards is near 0.
    virtual void home() = 0;
    // Goes to an angle (any real number; the device takes it modulo a turn) and returns the angle
    // that it reports, on the same branch: within tolerance_deg of `degrees`. Every wait has a
    // deadline; a mount that reports another place, an error, or nothing throws DeviceError.
    virtual double move_to(double degrees) = 0;
    // What it reports now, in [0, 360).
    virtual double position() = 0;
    virtual void recover() = 0;
    virtual bool reconnect(double seconds) = 0;
};

}  // namespace drude
