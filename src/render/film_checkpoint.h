// When checkpoints are due, where they lie, and what a resumed run takes from them.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "render/film_partial.h"

namespace drude {

// "DIR/OUT.checkpoint.exr" beside "DIR/OUT.exr".
std::string checkpoint_path(const std::string& output);

class CheckpointClock {
  public:
    using Clock = std::chrono::steady_clock;

    // `seconds` between the end of one checkpoint and the next; 0: never. Without it a minute, and
    // longer where a checkpoint of `bytes` takes more than a third of a second, so that all of
    // them stay below 0.6 % of the time.
    CheckpointClock(std::optional<double> seconds, uint64_t bytes);

    // From any thread.
    bool due() const { return enabled_ && Clock::now() >= next_; }
    // After a checkpoint that was begun at `begun`.
    void written(Clock::time_point begun);
    // After one that could not be written; the next try comes as if it had been.
    void failed(Clock::time_point begun);

    int count() const { return count_; }
    double seconds() const { return seconds_; }  // spent on writing

  private:
    void wait(double for_a_write_of);

    bool enabled_;
    std::optional<double> period_;
    Clock::time_point next_;
    int count_ = 0;
    double seconds_ = 0;
};

// Fills `sums` and `part` (fewest and counts) from the checkpoint at `path`. False where there is
// none. Throws Error (user) where it is damaged, of another job (differences in the instruction
// set pass with `allow_mixed`), of another range's beginning, or holds more batches than
// part->last.
bool resume_from(const std::string& path, bool allow_mixed, FilmPart* part, FilmSums* sums);

// Removes a checkpoint whose picture is complete, and nothing where there is none.
void remove_checkpoint(const std::string& path);

}  // namespace drude
