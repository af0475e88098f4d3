// The measuring part of a sweep: points of a plan, with their darks and exposures, into a journal.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "device/sweep/bench_driver.h"
#include "device/sweep/retry.h"
#include "device/sweep/sweep.h"

namespace drude {

class SweepRun {
  public:
    // Goes on with what `journal` holds; `writer` is at its end. Bench, person and options outlive
    // it.
    SweepRun(Bench& bench, Operator& person, const SweepOptions& options, Journal journal,
             JournalWriter writer);

    // Measures what is missing; `resumed`: after it has been seen that the bench is still the one
    // that was left. False where it was stopped. Throws DeviceError where a part fails for good,
    // with the journal written to the disk.
    bool run(bool resumed);

  private:
    void log(const std::string& kind, const std::string& text);
    void measure_angles();
    void measure_points(bool resumed);
    void measure_point(uint32_t index);
    double exposure_of(uint32_t group);
    JournalDark take_dark(uint32_t block, double integration_s);
    JournalPoint take_point(uint32_t index, double integration_s);
    void check_saturation(const std::vector<Frame>& frames, bool* seen);
    std::vector<Frame> take_frames(int count);
    void check_against_before(const std::set<uint32_t>& done);

    BenchDriver driver_;
    Bench& bench_;
    const SweepOptions& options_;
    Journal journal_;
    JournalWriter writer_;
    Retrier retrier_;
    uint32_t session_ = 0;
    bool overexposed_ = false;  // full scale was read twice in a row
};

}  // namespace drude
