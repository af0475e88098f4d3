#include "render/film_checkpoint.h"

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "base/files.h"

namespace drude {

namespace {

constexpr double usual_period = 60;
// Time of rendering for each second of writing, where no period was asked for.
constexpr double render_per_write = 180;
// A first guess, of a slow disk; what was measured replaces it.
constexpr double bytes_per_second = 150e6;

CheckpointClock::Clock::duration of_seconds(double seconds) {
    return std::chrono::duration_cast<CheckpointClock::Clock::duration>(
        std::chrono::duration<double>(seconds));
}

}  // namespace

std::string checkpoint_path(const std::string& output) {
    const std::filesystem::path path(output);
    return (path.parent_path() / (path.stem().string() + ".checkpoint.exr")).string();
}

CheckpointClock::CheckpointClock(std::optional<double> seconds, uint64_t bytes)
    : enabled_(!seconds || *seconds > 0), period_(seconds) {
    wait(static_cast<double>(bytes) / bytes_per_second);
}

void CheckpointClock::wait(double for_a_write_of) {
    // Longer than a year is never: it would not fit the clock.
    const double seconds =
        std::min(period_.value_or(std::max(usual_period, render_per_write * for_a_write_of)), 4e7);
    next_ = Clock::now() + of_seconds(seconds);
}

void CheckpointClock::written(Clock::time_point begun) {
    const double taken = std::chrono::duration<double>(Clock::now() - begun).count();
    ++count_;
    seconds_ += taken;
    wait(taken);
}

void CheckpointClock::failed(Clock::time_point begun) {
    wait(std::chrono::duration<double>(Clock::now() - begun).count());
}

bool resume_from(const std::string& path, bool allow_mixed, FilmPart* part, FilmSums* sums) {
    remove_abandoned_files(path);
    std::error_code error;
    if (!std::filesystem::exists(path, error)) return false;
    PartialReader reader(path);
    const FilmPart& held = reader.part();
    const std::string differences = job_differences(held.job, part->job, true);
    if (!differences.empty()) {
        user_error(
            "--resume: {} holds another picture: {}; give the options it was begun with, or remove "
            "it to begin anew",
            path, differences);
    }
    if (!allow_mixed && held.job.instruction_set != part->job.instruction_set) {
        user_error(
            "--resume: {} was rendered with the instruction set {}, and this is {}, whose bits "
            "differ; pin it with --isa, or accept the mixture with --allow-mixed",
            path, held.job.instruction_set, part->job.instruction_set);
    }
    if (held.first != part->first) {
        user_error("--resume: {} begins at batch {}, another shard than this, which begins at {}",
                   path, held.first, part->first);
    }
    const auto width = static_cast<size_t>(part->job.width);
    for (int y = 0; y < part->job.height; ++y) {
        reader.read_row(y, sums, static_cast<size_t>(y) * width);
    }
    const uint32_t most = sums->most_batches();
    if (most > part->last - part->first) {
        const auto samples = [&](uint32_t batches) {
            return uint64_t{batches} * static_cast<uint64_t>(part->job.batch_size);
        };
        user_error(
            "--resume: {} holds {} samples a pixel already, and {} are wanted; ask for as many or "
            "remove it to begin anew",
            path, samples(most), samples(part->last - part->first));
    }
    part->fewest = held.fewest;
    part->counts = held.counts;
    part->job.instruction_set =
        joined_instruction_sets(held.job.instruction_set, part->job.instruction_set);
    return true;
}

void remove_checkpoint(const std::string& path) {
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error)) std::filesystem::remove(path, error);
}

}  // namespace drude
