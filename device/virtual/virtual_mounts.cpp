// The mounts and the arms of the virtual bench.
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/numbers.h"
#include "device/virtual/virtual_parts.h"

namespace drude {

namespace {

constexpr double pulses_per_turn = 143360;  // ELL14

class VirtualRotator : public Rotator {
  public:
    VirtualRotator(std::shared_ptr<VirtualRig> rig, const char* part, MountMoved moved)
        : rig_(std::move(rig)), part_(part), moved_(std::move(moved)) {
        info_.uri = std::string("virtual:") + part;
        info_.model = "virtual rotation mount";
        info_.serial = std::string("VIRTUAL-") + part;
        info_.units_per_degree = pulses_per_turn / 360;
        info_.repeatability_deg = rig_->optics().settings().mount_jitter_deg;
        info_.tolerance_deg = 0.1;
    }

    const RotatorInfo& info() const override { return info_; }
    void home() override {
        rig_->transfer(part_);
        go(0);
    }
    double move_to(double degrees) override {
        if (!(std::abs(degrees) <= 1e6)) {
            user_error("virtual {}: found an angle of {} degrees, expected one within 1e6", part_,
                       format_double(degrees));
        }
        rig_->transfer(part_);
        const double pulses = std::round(degrees * info_.units_per_degree);
        const double turns = std::floor(pulses / pulses_per_turn);
        go((pulses - turns * pulses_per_turn) / info_.units_per_degree);
        return pulses / info_.units_per_degree;
    }
    double position() override {
        rig_->transfer(part_);
        return position_deg_;
    }
    void recover() override {
        rig_->transfer(part_);
        rig_->clock()->sleep(0.1);
    }
    bool reconnect(double seconds) override { return rig_->comes_back(part_, seconds); }

  private:
    // In [0, 360), through the angles between, as a mount of absolute positions does.
    void go(double degrees) {
        rig_->clock()->sleep(0.06 + std::abs(degrees - position_deg_) / 430);
        position_deg_ = degrees;
        OpticalState state = rig_->state();
        moved_(degrees, &state);
        rig_->enter(state);
    }

    std::shared_ptr<VirtualRig> rig_;
    const char* part_;
    MountMoved moved_;
    RotatorInfo info_;
    double position_deg_ = 0;
};

class VirtualGoniometer : public Goniometer {
  public:
    explicit VirtualGoniometer(std::shared_ptr<VirtualRig> rig) : rig_(std::move(rig)) {}

    std::string description() const override { return "virtual goniometer"; }
    void move_to(double incidence_deg, double offset_deg) override {
        const double exit_deg = incidence_deg + offset_deg;
        if (!(incidence_deg > 0 && incidence_deg < 90)) {
            user_error(
                "virtual goniometer: found an angle of incidence of {} degrees, expected one above "
                "0 and below 90",
                format_double(incidence_deg));
        }
        if (!(exit_deg > -90 && exit_deg < 90)) {
            user_error(
                "virtual goniometer: found a detector at {} + {} degrees from the sample's normal, "
                "expected it above -90 and below 90",
                format_double(incidence_deg), format_double(offset_deg));
        }
        rig_->transfer(part);
        OpticalState state = rig_->state();
        // The detector's arm goes furthest.
        const double from_deg = state.straight_through ? 180 : state.incidence_deg * 2;
        travel(from_deg - incidence_deg * 2 - offset_deg + state.offset_deg);
        state.straight_through = false;
        state.incidence_deg = incidence_deg;
        state.offset_deg = offset_deg;
        rig_->enter(state);
    }
    void straight_through() override {
        rig_->transfer(part);
        OpticalState state = rig_->state();
        if (!state.straight_through) travel(180 - state.incidence_deg * 2 - state.offset_deg);
        state.straight_through = true;
        state.offset_deg = 0;
        rig_->enter(state);
    }
    void recover() override {
        rig_->transfer(part);
        rig_->clock()->sleep(0.1);
    }
    bool reconnect(double seconds) override { return rig_->comes_back(part, seconds); }

  private:
    static constexpr const char* part = "goniometer";
    void travel(double degrees) { rig_->clock()->sleep(0.2 + std::abs(degrees) / 10); }

    std::shared_ptr<VirtualRig> rig_;
};

}  // namespace

std::shared_ptr<Rotator> make_virtual_rotator(std::shared_ptr<VirtualRig> rig, const char* part,
                                              MountMoved moved) {
    return std::make_shared<VirtualRotator>(std::move(rig), part, std::move(moved));
}

std::shared_ptr<Goniometer> make_virtual_goniometer(std::shared_ptr<VirtualRig> rig) {
    return std::make_shared<VirtualGoniometer>(std::move(rig));
}

}  // namespace drude
