#include "device/sweep/sweep.h"

#include <chrono>
#include <ctime>
#include <filesystem>
#include <optional>

#include "base/error.h"
#include "base/sha256.h"
#include "device/sweep/sweep_run.h"

namespace drude {

namespace {

std::string utc_now() {
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    std::tm parts{};
    gmtime_r(&now, &parts);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text;
}

JournalHeader make_header(const Bench& bench, const Recipe& recipe,
                          const std::vector<std::string>& warnings) {
    JournalHeader header;
    header.recipe = recipe;
    header.bench_name = bench.name;
    header.bench_description = bench.description;
    header.is_virtual = bench.is_virtual;
    header.notes = bench.notes;
    header.warnings = bench.warnings;
    header.warnings.insert(header.warnings.end(), warnings.begin(), warnings.end());
    header.has_spectrometer = bench.spectrometer != nullptr;
    if (bench.spectrometer) {
        header.spectrometer = bench.spectrometer->info();
        const auto& own = bench.spectrometer->info().warnings;
        header.warnings.insert(header.warnings.end(), own.begin(), own.end());
    }
    if (bench.head) header.head_identity = bench.head->identity();
    if (bench.polariser.rotator) {
        header.mount_repeatability_deg = bench.polariser.rotator->info().repeatability_deg;
    }
    if (bench.analyser.rotator) {
        header.analyser_repeatability_deg = bench.analyser.rotator->info().repeatability_deg;
    }
    header.software = "drude " DRUDE_VERSION;
    // A virtual bench gives the same bytes whenever it is run.
    if (!bench.is_virtual) header.started = utc_now();
    return header;
}

void check_same(const Journal& before, const JournalHeader& now, const std::string& path) {
    const std::string recipe = sha256(format_recipe(now.recipe));
    if (before.recipe_sha256 != recipe) {
        user_error(
            "{}: was made with another recipe (SHA-256 {}..., now {}...); go on with the options "
            "it was begun with, or begin another one with --journal",
            path, before.recipe_sha256.substr(0, 12), recipe.substr(0, 12));
    }
    if (before.header->bench_description != now.bench_description) {
        user_error(
            "{}: was made with another bench: {}; found {}; connect the same instruments, or begin "
            "another journal with --journal",
            path, before.header->bench_description, now.bench_description);
    }
    const auto& old_nm = before.header->spectrometer.wavelength_nm;
    if (old_nm != now.spectrometer.wavelength_nm) {
        user_error(
            "{}: the spectrometer's wavelength calibration has changed since; begin another "
            "journal with --journal",
            path);
    }
}

std::string how_to_go_on(const Journal& journal, const std::string& path) {
    const size_t total = journal.header->has_spectrometer
                             ? journal.plan.size()
                             : journal.header->recipe.angles_deg.size();
    const size_t done =
        journal.header->has_spectrometer ? journal.points.size() : journal.rows.size();
    return fmt::format(
        "{} holds {} of {} {}: put right what this says and go on with the same command and "
        "--resume",
        path, done, total, journal.header->has_spectrometer ? "points" : "angles");
}

}  // namespace

SweepOutcome run_sweep(Bench& bench, const Recipe& recipe, Operator& person,
                       const SweepOptions& options) {
    std::vector<std::string> warnings;
    const Recipe adapted = adapt_recipe(recipe, bench, &warnings);
    const JournalHeader header = make_header(bench, adapted, warnings);
    SweepOutcome outcome;
    std::optional<JournalWriter> writer;
    Journal journal;
    if (options.resume && std::filesystem::exists(options.journal)) {
        journal = read_journal(options.journal);
        if (!journal.header) {
            // Stopped before anything was written: nothing is lost.
            std::filesystem::remove(options.journal);
        } else {
            check_same(journal, header, options.journal);
            outcome.resumed = true;
            if (!journal.complete) writer.emplace(JournalWriter::append(options.journal, journal));
        }
    }
    if (!outcome.resumed) {
        writer.emplace(JournalWriter::create(options.journal, header));
        journal = read_journal(options.journal);
    }
    if (!journal.complete) {
        const bool had_points = !journal.points.empty() || !journal.darks.empty();
        SweepRun sweep(bench, person, options, std::move(journal), std::move(*writer));
        writer.reset();
        try {
            outcome.stopped = !sweep.run(had_points);
        } catch (const Error& error) {
            if (error.cause() != Cause::outside) throw;
            throw Error(Cause::outside,
                        error.message() + "; " +
                            how_to_go_on(read_journal(options.journal), options.journal));
        }
        journal = read_journal(options.journal);
    }
    outcome.retries = journal.retries();
    outcome.journal = std::move(journal);
    return outcome;
}

}  // namespace drude
