// A sweep: a recipe carried out on a bench, with every frame in a journal.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "device/bench.h"
#include "device/sweep/journal.h"
#include "device/sweep/operator.h"
#include "device/sweep/retry.h"

namespace drude {

// What a sweep tells while it runs; every function may be empty.
struct SweepObserver {
    std::function<void(size_t done, size_t total)> progress;
    std::function<void(const std::string&)> message;  // retries and warnings, as they happen
    // After the last point of a scan or lobe position: the points measured in this session so far
    // (the scan's are the last ones).
    std::function<void(const Journal& so_far)> scan_finished;
};

struct SweepOptions {
    std::string journal;  // its path
    bool resume = false;
    RetryLimits retries;
    std::function<bool()> stop;  // asked between transfers; true ends the sweep
    SweepObserver observer;
};

struct SweepOutcome {
    Journal journal;       // as read back from the disk
    size_t retries = 0;    // of all sessions
    bool resumed = false;  // went on with a journal that held something
    bool stopped = false;  // by `stop`; the journal holds what was finished
};

// Measures what the journal does not hold yet. A journal that is there already is an Error (user)
// without `resume`; with it the recipe and the bench (serial numbers included) must be those of the
// journal, the dark of the block under way is taken again and may differ by its noise and 0.5 % of
// the range, and the last point is measured again: it must read the same within 5 %, and the ratio
// is written down, so that both parts of a scan that was interrupted are on one scale.
//
// Throws Error (outside) where a part fails for good: the message says how to go on, the journal
// holds everything that was finished.
SweepOutcome run_sweep(Bench& bench, const Recipe& recipe, Operator& person,
                       const SweepOptions& options);

}  // namespace drude
