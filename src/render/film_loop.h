// The loop over tiles and batches: sums of a film up to a rule, with checkpoints between.
#pragma once

#include "render/batch_tracer.h"
#include "render/film_checkpoint.h"
#include "render/film_job.h"
#include "render/film_schedule.h"

namespace drude {

struct FilmLoopOptions {
    StopRule stop;
    int threads = 0;
    bool quiet = false;
    std::string checkpoint;  // empty: none
    std::optional<double> checkpoint_seconds;
    std::string command_line;
};

struct FilmLoopResult {
    bool interrupted = false;
    int checkpoints = 0;
    double checkpoint_seconds = 0;
    std::string checkpoint_error;  // of the last checkpoint that could not be written
};

// Adds batches from part->first on to what `sums` holds of them, and keeps part->fewest and
// part->counts. An interrupt ends it at once where there is a checkpoint file, which then holds
// what is done; otherwise not before every pixel holds a batch.
FilmLoopResult run_film_loop(const BatchTracer& tracer, const FilmLoopOptions& options,
                             FilmPart* part, FilmSums* sums);

}  // namespace drude
