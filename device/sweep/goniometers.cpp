#include "device/sweep/goniometers.h"

#include <cmath>

#include "base/error.h"

namespace drude {

namespace {

void check(double incidence_deg, double offset_deg) {
    if (incidence_deg > 0 && incidence_deg < 90 && std::abs(incidence_deg + offset_deg) < 90)
        return;
    user_error(
        "goniometer: found an angle of incidence of {} degrees and the detector {} degrees beyond "
        "the mirror direction, expected both directions within 90 degrees of the normal",
        incidence_deg, offset_deg);
}

}  // namespace

std::string MotorGoniometer::description() const {
    return fmt::format("sample on {}, detector on {}", sample_.rotator->info().uri,
                       arm_.rotator->info().uri);
}

void MotorGoniometer::go(GoniometerAxis& axis, double degrees) {
    last_ = axis.rotator.get();
    axis.rotator->move_to(axis.zero_deg + axis.direction * degrees);
}

void MotorGoniometer::move_to(double incidence_deg, double offset_deg) {
    check(incidence_deg, offset_deg);
    if (!homed_) {
        for (const GoniometerAxis* axis : {&sample_, &arm_}) {
            last_ = axis->rotator.get();
            axis->rotator->home();
        }
        homed_ = true;
    }
    if (sample_out_) {
        person_->ask("put the sample back");
        sample_out_ = false;
    }
    go(sample_, incidence_deg);
    go(arm_, 180 - 2 * incidence_deg - offset_deg);
}

void MotorGoniometer::straight_through() {
    if (!homed_) {
        last_ = arm_.rotator.get();
        arm_.rotator->home();
    }
    if (!sample_out_) {
        person_->ask("take the sample out of the beam");
        sample_out_ = true;
    }
    go(arm_, 0);
}

void MotorGoniometer::recover() {
    if (last_ != nullptr) last_->recover();
}

bool MotorGoniometer::reconnect(double seconds) {
    if (last_ == nullptr || !last_->reconnect(seconds)) return false;
    last_->home();
    return true;
}

void ManualGoniometer::move_to(double incidence_deg, double offset_deg) {
    check(incidence_deg, offset_deg);
    if (offset_deg == 0) {
        person_->ask(
            fmt::format("set both arms to {} degrees from the sample's normal", incidence_deg));
    } else {
        person_->ask(
            fmt::format("set the sample to {} degrees of incidence and the detector to {} "
                        "degrees from its normal",
                        incidence_deg, incidence_deg + offset_deg));
    }
}

void ManualGoniometer::straight_through() {
    person_->ask("take the sample out and set both arms in one line");
}

}  // namespace drude
