#include "render/film_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <optional>

#include "base/error.h"
#include "base/executor.h"
#include "base/interrupt.h"
#include "base/progress.h"

namespace drude {

namespace {

constexpr int tile_size = 16;

class FilmLoop {
  public:
    FilmLoop(const BatchTracer& tracer, const FilmLoopOptions& options, FilmPart* part,
             FilmSums* sums)
        : tracer_(tracer),
          options_(options),
          part_(*part),
          sums_(*sums),
          width_(part->job.width),
          height_(part->job.height),
          tiles_x_((width_ + tile_size - 1) / tile_size),
          tiles_y_((height_ + tile_size - 1) / tile_size),
          tile_counts_(static_cast<size_t>(tiles_x_) * tiles_y_),
          earlier_(part->counts),
          clock_(options.checkpoint.empty() ? std::optional<double>(0) : options.checkpoint_seconds,
                 uint64_t{part->job.layout().pixels()} * part->job.layout().words() * 4) {}

    FilmLoopResult run() {
        const FilmSchedule schedule(options_.stop);
        const bool at_a_count = !options_.stop.error && !options_.stop.seconds;
        if (at_a_count) start_progress("render", options_.stop.most);
        uint32_t done = sums_.fewest_batches();
        // Where a resumed run was in the middle of a step, this step ends first: with an error to
        // reach, at the next look, since those before it have been in vain.
        if (const uint32_t most = sums_.most_batches(); done < most) {
            const uint32_t target =
                options_.stop.error
                    ? std::min(options_.stop.most, FilmSchedule::next_look(most - 1))
                    : most;
            if (!at_a_count) start_progress("render", target);
            if (!step_to(target)) return finish(true);
            done = target;
        }
        for (;;) {
            std::string title = "render";
            if (options_.stop.error && FilmSchedule::is_look(done)) {
                const double error = relative_error(sums_);
                if (error <= *options_.stop.error) break;
                title = fmt::format("render, error {:.3g} so far", error);
            }
            const uint32_t target = schedule.next(done, seconds());
            if (target == done) break;
            if (!at_a_count) start_progress(title, target);
            if (!step_to(target)) return finish(true);
            done = target;
        }
        return finish(false);
    }

  private:
    using Clock = std::chrono::steady_clock;

    double seconds() const {
        return earlier_.seconds + std::chrono::duration<double>(Clock::now() - start_).count();
    }

    void start_progress(const std::string& title, uint32_t target) {
        progress_.reset();  // its last line stands before the next one's first
        uint64_t held = 0;
        const size_t pixels = sums_.layout().pixels();
        for (size_t p = 0; p < pixels; ++p) held += std::min(target, sums_.batches(p));
        progress_.emplace(title, pixels * target, options_.quiet);
        progress_->step(held);
    }

    // Until every pixel holds `target` batches; false where an interrupt came first.
    bool step_to(uint32_t target) {
        for (;;) {
            const bool may_stop = !options_.checkpoint.empty() || sums_.fewest_batches() > 0;
            // A checkpoint needs all threads at rest; they come to rest at the next row of a tile.
            std::atomic<bool> paused{false};
            parallel_for(tile_counts_.size(), options_.threads,
                         [&](size_t tile) { trace_tile(tile, target, may_stop, &paused); });
            part_.fewest = sums_.fewest_batches();
            if (part_.fewest >= target) return true;
            if (may_stop && interrupted()) return false;
            if (paused) save_now_and_then();
        }
    }

    void trace_tile(size_t tile, uint32_t target, bool may_stop, std::atomic<bool>* paused) {
        FilmCounts& counts = tile_counts_[tile];
        const int x0 = static_cast<int>(tile % tiles_x_) * tile_size;
        const int y0 = static_cast<int>(tile / tiles_x_) * tile_size;
        PathStatistics statistics;
        size_t traced = 0;
        BatchResult batch;
        for (int y = y0; y < std::min(height_, y0 + tile_size); ++y) {
            if ((may_stop && interrupted()) || *paused) break;
            for (int x = x0; x < std::min(width_, x0 + tile_size); ++x) {
                const size_t pixel = static_cast<size_t>(y) * width_ + x;
                for (uint32_t held = sums_.batches(pixel); held < target; ++held, ++traced) {
                    tracer_.trace({x, y, part_.first + held, part_.job.batch_size}, &batch,
                                  &statistics);
                    if (!sums_.add(pixel, batch)) ++counts.out_of_range;
                }
            }
            // After a row, not before it: however short the period, every turn gets further.
            if (clock_.due()) *paused = true;
        }
        counts.rays += statistics.rays;
        counts.projections += statistics.projections;
        counts.not_finite += statistics.not_finite;
        if (traced > 0) progress_->step(traced);
    }

    void add_up_counts() {
        part_.counts = earlier_;
        for (const FilmCounts& counts : tile_counts_) part_.counts += counts;
        part_.counts.seconds = seconds();
    }

    void save() {
        const Clock::time_point begun = Clock::now();
        add_up_counts();
        write_partial(options_.checkpoint, part_, sums_, options_.command_line);
        clock_.written(begun);
    }

    // A disk that is full for now is no reason to give up what is rendered.
    void save_now_and_then() {
        const Clock::time_point begun = Clock::now();
        try {
            save();
        } catch (const Error& error) {
            checkpoint_error_ = error.message();
            clock_.failed(begun);
        }
    }

    FilmLoopResult finish(bool interrupted_here) {
        progress_.reset();
        part_.fewest = sums_.fewest_batches();
        if (interrupted_here && !options_.checkpoint.empty()) save();
        add_up_counts();
        return {interrupted_here, clock_.count(), clock_.seconds(), checkpoint_error_};
    }

    const BatchTracer& tracer_;
    const FilmLoopOptions& options_;
    FilmPart& part_;
    FilmSums& sums_;
    const int width_, height_, tiles_x_, tiles_y_;
    std::vector<FilmCounts> tile_counts_;
    const FilmCounts earlier_;  // of the runs that this one resumes
    CheckpointClock clock_;
    std::string checkpoint_error_;
    std::optional<Progress> progress_;
    const Clock::time_point start_ = Clock::now();
};

}  // namespace

FilmLoopResult run_film_loop(const BatchTracer& tracer, const FilmLoopOptions& options,
                             FilmPart* part, FilmSums* sums) {
    return FilmLoop(tracer, options, part, sums).run();
}

}  // namespace drude
