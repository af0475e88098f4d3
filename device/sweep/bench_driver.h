// Sets a bench to the points of a plan, one part at a time, and keeps account of the time.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "device/bench.h"
#include "device/sweep/journal.h"
#include "device/sweep/operator.h"

namespace drude {

// Thrown between two transfers where the sweep is asked to stop.
struct SweepStopped {};

class BenchDriver {
  public:
    // `stop` is asked between transfers. All three outlive the driver.
    BenchDriver(Bench& bench, Operator& person, std::function<bool()> stop);

    // Finds the reference mark of every mount.
    void home();
    // Moves what does not stand there yet.
    void set(const PlanPoint& point);
    void set_integration_time(double seconds);
    double integration_time() const { return integration_s_; }
    void set_lamp(bool on);
    // The first frame of a setting discards what is stale.
    Frame acquire();

    // What the mounts reported last, and the azimuths of the axes that follow.
    double polariser_reported_deg() const { return polariser_.reported_deg; }
    double polariser_deg() const;
    double analyser_reported_deg() const { return analyser_.reported_deg; }
    double analyser_deg() const;
    double settled_s() const { return settled_s_; }

    // The part that was used last, which is the one that an error is about.
    enum class Part { none, spectrometer, polariser, analyser, retarder, goniometer, head };
    Part part() const { return part_; }
    const char* part_name() const;
    // Of that part. What the bench stands at is not taken for granted afterwards.
    void recover();
    bool reconnect(double seconds);

    SweepTimes times() const;
    void check_stop() const;
    // An action on the head, timed as integration.
    std::vector<MeasurementRow> measure_with_head(double incidence_deg);

  private:
    struct Stand {
        std::optional<double> commanded_deg;
        double reported_deg = 0;
    };
    void turn(Part part, Rotator& rotator, double reported_deg, Stand* stand);
    void begin_move();
    void end_move();
    void forget();
    Rotator* rotator_of(Part part) const;
    double axis(const Azimuth& azimuth, double reported_deg) const;

    Bench& bench_;
    Operator& person_;
    std::function<bool()> stop_;
    Part part_ = Part::none;
    Stand polariser_, analyser_, retarder_;
    std::optional<bool> retarder_by_hand_in_;
    struct Arms {
        bool straight_through = false;
        double incidence_deg = 0, offset_deg = 0;
        bool operator==(const Arms&) const = default;
    };
    std::optional<Arms> arms_;
    std::optional<bool> lamp_;
    double integration_s_ = 0;
    double settled_s_ = 0;
    bool stale_ = true;  // frames that are under way may have begun before the last change
    double start_s_ = 0, move_start_s_ = 0;
    SweepTimes times_;
};

}  // namespace drude
