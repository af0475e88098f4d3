// How a sweep's time is spent: 6 angles, 2 cycles, 2 zones, 24 steps, 3648 pixels on the virtual
// bench. The bench's clock says how long a bench would take; what this program itself takes for it
// (journal, checks, and here the simulation too) is real time that a bench would have to wait for.
//
//     capture_throughput [FOLDER]     (for the journal; default: the current folder)
#include <fmt/format.h>
#include <sys/resource.h>

#include <filesystem>

#include "base/error.h"
#include "device/sweep/journal_reduction.h"
#include "device/sweep/sweep.h"
#include "device/virtual/virtual_bench.h"

namespace {

using namespace drude;

class Nobody : public Operator {
  public:
    void ask(const std::string& request) override { user_error("asked to {}", request); }
};

double processor_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// The part of the bench's making that no real bench costs: the frames alone.
double simulation_seconds(const VirtualBenchSettings& settings, size_t frames) {
    const VirtualOptics optics(find_material("Cu-McPeak"), settings);
    const double start = processor_seconds();
    OpticalState state;
    uint64_t sum = 0;
    for (size_t i = 0; i < frames; ++i) {
        state.polariser_deg = static_cast<double>(i % 24) * 15;
        sum += optics.frame(state, 0.05, 0, i).front();
    }
    const double seconds = processor_seconds() - start;
    return sum == 0 ? 0 : seconds;
}

void run(const std::string& folder) {
    VirtualBenchSettings settings = ordinary_bench_settings(1);
    settings.pixels = 3648;
    Bench bench = make_virtual_bench(find_material("Cu-McPeak"), settings);
    const Recipe recipe;
    Nobody nobody;
    SweepOptions options;
    options.journal = (std::filesystem::path(folder) / "capture_throughput.journal").string();
    std::filesystem::remove(options.journal);
    const double start = processor_seconds();
    const SweepOutcome outcome = run_sweep(bench, recipe, nobody, options);
    const double processor = processor_seconds() - start;
    const Journal& journal = outcome.journal;
    const SweepTimes& times = journal.times;
    size_t frames = 0;
    for (const JournalPoint& point : journal.points) frames += point.frames.size();
    const size_t discarded = journal.points.size();
    const double simulated = simulation_seconds(settings, frames + discarded);
    const double own = std::max(0.0, processor - simulated);

    const auto line = [&](const char* what, double seconds) {
        fmt::print("{:<28}{:9.2f} s {:7.2f} %\n", what, seconds, 100 * seconds / times.total);
    };
    fmt::print("{} points, {} frames kept, {} pixels, {:.1f} MB of journal\n",
               journal.points.size(), frames, settings.pixels,
               static_cast<double>(journal.valid_bytes) / 1e6);
    line("bench's clock", times.total);
    line("  integrating", times.integration);
    line("  discarding stale frames", times.discarded);
    line("  moving", times.motion);
    line("  elsewhere", times.elsewhere());
    line("processor, simulation", simulated);
    line("processor, the sweep itself", own);
    fmt::print(
        "outside integration and motion, the sweep's own processor time included: {:.2f} % "
        "(with discarded frames {:.2f} %)\n",
        100 * (times.elsewhere() + own) / times.total,
        100 * (times.elsewhere() + own + times.discarded) / times.total);
    fmt::print("processor time of the sweep itself a point: {:.2f} ms\n",
               1000 * own / static_cast<double>(journal.points.size()));
    const double before = processor_seconds();
    const JournalReduction result = reduce_journal(journal, {});
    fmt::print("reduction to {} rows of Psi and Delta: {:.3f} s of processor time\n", result.rows,
               processor_seconds() - before);
    std::filesystem::remove(options.journal);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        run(argc > 1 ? argv[1] : ".");
    } catch (const Error& error) {
        fmt::print(stderr, "capture_throughput: {}\n", error.message());
        return static_cast<int>(error.cause());
    }
    return 0;
}
