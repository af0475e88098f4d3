#include "device/sweep/bench_driver.h"

#include <algorithm>

#include "base/error.h"
#include "device/sweep/fresh_frame.h"

namespace drude {

BenchDriver::BenchDriver(Bench& bench, Operator& person, std::function<bool()> stop)
    : bench_(bench), person_(person), stop_(std::move(stop)), start_s_(bench.clock->now()) {
    // Nobody is asked to light a lamp that burns.
    if (bench.spectrometer && !bench.spectrometer->info().has_lamp_control) lamp_ = true;
}

void BenchDriver::check_stop() const {
    if (stop_ && stop_()) throw SweepStopped{};
}

void BenchDriver::begin_move() {
    check_stop();
    move_start_s_ = bench_.clock->now();
}

void BenchDriver::end_move() {
    settled_s_ = bench_.clock->now();
    times_.motion += settled_s_ - move_start_s_;
    stale_ = true;
}

void BenchDriver::home() {
    if (bench_.head) return;
    for (const Part part : {Part::polariser, Part::analyser, Part::retarder}) {
        Rotator* rotator = rotator_of(part);
        if (rotator == nullptr) continue;
        part_ = part;
        begin_move();
        rotator->home();
        end_move();
    }
    forget();
}

void BenchDriver::turn(Part part, Rotator& rotator, double reported_deg, Stand* stand) {
    if (stand->commanded_deg == reported_deg) return;
    part_ = part;
    stand->commanded_deg.reset();
    begin_move();
    stand->reported_deg = rotator.move_to(reported_deg);
    end_move();
    stand->commanded_deg = reported_deg;
}

void BenchDriver::set(const PlanPoint& point) {
    const Arms arms{point.straight_through, point.straight_through ? 0 : point.incidence_deg,
                    point.straight_through ? 0 : point.offset_deg};
    if (bench_.goniometer && arms_ != arms) {
        part_ = Part::goniometer;
        arms_.reset();
        begin_move();
        if (arms.straight_through) {
            bench_.goniometer->straight_through();
        } else {
            bench_.goniometer->move_to(arms.incidence_deg, arms.offset_deg);
        }
        end_move();
        // A person who was asked and stopped the program instead has moved nothing.
        check_stop();
        arms_ = arms;
    }
    const RetarderArm& retarder = bench_.retarder;
    if (retarder.present && retarder.rotator) {
        turn(Part::retarder, *retarder.rotator,
             point.retarder_in ? retarder.in_deg : retarder.out_deg, &retarder_);
    } else if (retarder.present && retarder_by_hand_in_ != point.retarder_in) {
        part_ = Part::retarder;
        begin_move();
        person_.ask(point.retarder_in
                        ? "put the retarder into the beam, its fast axis in the plane of incidence"
                        : "take the retarder out of the beam");
        end_move();
        check_stop();
        retarder_by_hand_in_ = point.retarder_in;
    }
    const auto reading = [](const Azimuth& azimuth, double axis_deg) {
        return azimuth.zero_deg + azimuth.direction * axis_deg;
    };
    if (bench_.analyser.rotator) {
        turn(Part::analyser, *bench_.analyser.rotator, reading(bench_.analyser, point.analyser_deg),
             &analyser_);
    }
    if (bench_.polariser.rotator) {
        turn(Part::polariser, *bench_.polariser.rotator,
             reading(bench_.polariser, point.polariser_deg), &polariser_);
    }
}

void BenchDriver::set_integration_time(double seconds) {
    if (integration_s_ == seconds) return;
    check_stop();
    part_ = Part::spectrometer;
    integration_s_ = 0;
    bench_.spectrometer->set_integration_time(seconds);
    integration_s_ = seconds;
    settled_s_ = bench_.clock->now();
    stale_ = true;
}

void BenchDriver::set_lamp(bool on) {
    if (lamp_ == on) return;
    check_stop();
    part_ = Part::spectrometer;
    lamp_.reset();
    if (bench_.spectrometer->info().has_lamp_control) {
        bench_.spectrometer->set_lamp(on);
        settled_s_ = bench_.clock->now();
        stale_ = true;
    } else {
        begin_move();
        person_.ask(on ? "let the light of the lamp in again"
                       : "block the light of the lamp, for a dark reading");
        end_move();
        check_stop();
    }
    lamp_ = on;
}

Frame BenchDriver::acquire() {
    check_stop();
    part_ = Part::spectrometer;
    Spectrometer& spectrometer = *bench_.spectrometer;
    const double begin = bench_.clock->now();
    if (!stale_) {
        Frame frame = spectrometer.acquire();
        times_.integration += std::min(bench_.clock->now() - begin, integration_s_);
        return frame;
    }
    FreshFrame fresh = acquire_fresh(spectrometer, settled_s_, [this] { check_stop(); });
    stale_ = false;
    const double whole = bench_.clock->now() - begin;
    const double last = std::min(whole, integration_s_);
    times_.integration += last;
    times_.discarded += std::min(whole - last, fresh.discarded * integration_s_);
    return std::move(fresh.frame);
}

std::vector<MeasurementRow> BenchDriver::measure_with_head(double incidence_deg) {
    if (bench_.goniometer) {
        part_ = Part::goniometer;
        begin_move();
        bench_.goniometer->move_to(incidence_deg, 0);
        end_move();
    }
    check_stop();
    part_ = Part::head;
    const double begin = bench_.clock->now();
    std::vector<MeasurementRow> rows = bench_.head->measure(incidence_deg);
    times_.integration += bench_.clock->now() - begin;
    return rows;
}

double BenchDriver::axis(const Azimuth& azimuth, double reported_deg) const {
    if (!azimuth.rotator) return azimuth.fixed_deg;
    return azimuth.direction * (reported_deg - azimuth.zero_deg);
}

double BenchDriver::polariser_deg() const {
    return axis(bench_.polariser, polariser_.reported_deg);
}

double BenchDriver::analyser_deg() const {
    return axis(bench_.analyser, analyser_.reported_deg);
}

Rotator* BenchDriver::rotator_of(Part part) const {
    if (part == Part::polariser) return bench_.polariser.rotator.get();
    if (part == Part::analyser) return bench_.analyser.rotator.get();
    if (part == Part::retarder) return bench_.retarder.rotator.get();
    return nullptr;
}

const char* BenchDriver::part_name() const {
    switch (part_) {
        case Part::none:
            return "bench";
        case Part::spectrometer:
            return "spectrometer";
        case Part::polariser:
            return "polariser";
        case Part::analyser:
            return "analyser";
        case Part::retarder:
            return "retarder";
        case Part::goniometer:
            return "goniometer";
        case Part::head:
            return "head";
    }
    return "";
}

void BenchDriver::forget() {
    polariser_.commanded_deg.reset();
    analyser_.commanded_deg.reset();
    retarder_.commanded_deg.reset();
    // Arms and a retarder that somebody moved stand where they were put.
    if (!bench_.goniometer_by_hand) arms_.reset();
    if (bench_.spectrometer && bench_.spectrometer->info().has_lamp_control) lamp_.reset();
    integration_s_ = 0;
    settled_s_ = bench_.clock->now();
    stale_ = true;
}

void BenchDriver::recover() {
    check_stop();
    forget();
    if (part_ == Part::spectrometer) {
        bench_.spectrometer->recover();
    } else if (part_ == Part::goniometer) {
        bench_.goniometer->recover();
    } else if (part_ == Part::head) {
        bench_.head->recover();
    } else if (Rotator* rotator = rotator_of(part_)) {
        rotator->recover();
    }
    settled_s_ = bench_.clock->now();
}

bool BenchDriver::reconnect(double seconds) {
    check_stop();
    forget();
    bool back = false;
    if (part_ == Part::spectrometer) {
        back = bench_.spectrometer->reconnect(seconds);
    } else if (part_ == Part::goniometer) {
        back = bench_.goniometer->reconnect(seconds);
    } else if (part_ == Part::head) {
        back = bench_.head->reconnect(seconds);
    } else if (Rotator* rotator = rotator_of(part_)) {
        back = rotator->reconnect(seconds);
        // A mount that was without power does not know where it stands.
        if (back) rotator->home();
    }
    settled_s_ = bench_.clock->now();
    return back;
}

SweepTimes BenchDriver::times() const {
    SweepTimes times = times_;
    times.total = bench_.clock->now() - start_s_;
    return times;
}

}  // namespace drude
