// Goniometers that a bench file can name: two motors, or a person.
#pragma once

#include <memory>
#include <string>

#include "device/goniometer.h"
#include "device/rotator.h"
#include "device/sweep/operator.h"

namespace drude {

struct GoniometerAxis {
    std::shared_ptr<Rotator> rotator;
    double zero_deg = 0;
    int direction = 1;
};

// The sample's stage reports sample.zero_deg where the sample's normal points at the source, and
// zero + direction * theta at the angle of incidence theta. The detector's arm reports arm.zero_deg
// where it stands in line with the source, and zero + direction * (180 - 2 theta - offset) where
// the detector is `offset` beyond the mirror direction: light that meets the mirror at theta is
// turned by 180 - 2 theta, less the further the detector is from the normal.
class MotorGoniometer : public Goniometer {
  public:
    MotorGoniometer(GoniometerAxis sample, GoniometerAxis arm, std::shared_ptr<Operator> person)
        : sample_(std::move(sample)), arm_(std::move(arm)), person_(std::move(person)) {}

    std::string description() const override;
    void move_to(double incidence_deg, double offset_deg) override;
    void straight_through() override;
    void recover() override;
    bool reconnect(double seconds) override;

  private:
    void go(GoniometerAxis& axis, double degrees);

    GoniometerAxis sample_, arm_;
    std::shared_ptr<Operator> person_;
    Rotator* last_ = nullptr;  // the one that an error is about
    bool homed_ = false, sample_out_ = false;
};

class ManualGoniometer : public Goniometer {
  public:
    explicit ManualGoniometer(std::shared_ptr<Operator> person) : person_(std::move(person)) {}

    std::string description() const override { return "moved by hand"; }
    void move_to(double incidence_deg, double offset_deg) override;
    void straight_through() override;
    void recover() override {}
    bool reconnect(double) override { return true; }

  private:
    std::shared_ptr<Operator> person_;
};

}  // namespace drude
