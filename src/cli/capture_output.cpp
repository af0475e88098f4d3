#include "cli/capture_output.h"

#include <chrono>
#include <cstdio>
#include <filesystem>

#include "base/error.h"
#include "base/files.h"
#include "base/numbers.h"
#include "base/progress.h"
#include "base/sha256.h"
#include "cli/json_output.h"
#include "cli/warnings.h"

namespace drude {

namespace {

using nlohmann::ordered_json;

JournalReductionOptions reduction_options(const CaptureOutput& what) {
    JournalReductionOptions options;
    if (!what.calibration.empty()) {
        const std::string text = read_file(what.calibration);
        options.calibration = parse_calibration(text, what.calibration);
        options.calibration_name =
            fmt::format("{} (SHA-256 {})",
                        std::filesystem::path(what.calibration).filename().string(), sha256(text));
    }
    options.journal_name = std::filesystem::path(what.journal).filename().string();
    options.journal_sha256 = sha256(read_file(what.journal, uint64_t{1} << 32));
    if (!what.wavelengths.empty()) {
        const BinRange bins = parse_bins(what.wavelengths);
        options.first_nm = bins.first_nm;
        options.last_nm = bins.last_nm;
        options.step_nm = bins.step_nm;
    }
    return options;
}

ordered_json times_json(const SweepTimes& times) {
    return {{"total_s", times.total},
            {"integration_s", times.integration},
            {"discarded_s", times.discarded},
            {"motion_s", times.motion},
            {"elsewhere_s", times.elsewhere()}};
}

ordered_json quality_json(const Reduction& reduction) {
    ordered_json scans = ordered_json::array();
    for (const ScanQuality& scan : reduction.quality) {
        scans.push_back({{"angle_deg", scan.incidence_deg},
                         {"analyser_deg", scan.analyser_deg},
                         {"retarder", scan.retarder_in},
                         {"harmonic_4", scan.harmonic_4},
                         {"drift", scan.drift},
                         {"residual_over_noise", scan.residual_over_noise},
                         {"step_jitter_deg", scan.step_jitter_deg},
                         {"saturated", scan.saturated}});
    }
    return scans;
}

size_t points_done(const Journal& journal) {
    return journal.header->has_spectrometer ? journal.points.size() : journal.rows.size();
}

size_t points_planned(const Journal& journal) {
    return journal.header->has_spectrometer ? journal.plan.size()
                                            : journal.header->recipe.angles_deg.size();
}

void print_summary(const Journal& journal, const JournalReduction& result,
                   const CaptureOutput& what) {
    const JournalHeader& header = *journal.header;
    const std::string sample = header.recipe.sample.empty() ? "the sample" : header.recipe.sample;
    if (result.rows > 0) {
        fmt::print("{}: {} rows of {} ({}{})\n", what.output, result.rows, sample,
                   header.bench_name, header.is_virtual ? "; simulated, no hardware was used" : "");
    } else {
        fmt::print("{}: calibration from {} points ({})\n", what.output, points_done(journal),
                   header.bench_name);
    }
    const SweepTimes& times = journal.times;
    if (times.total > 0) {
        const auto share = [&](double seconds) { return 100 * seconds / times.total; };
        fmt::print(
            "{}: {} points, {} retries; {} by the bench's clock: {:.0f} % integrating, "
            "{:.0f} % discarding stale frames, {:.0f} % moving, {:.1f} % elsewhere\n",
            what.journal, points_done(journal), journal.retries(), format_duration(times.total),
            share(times.integration), share(times.discarded), share(times.motion),
            share(times.elsewhere()));
    }
}

}  // namespace

BinRange parse_bins(const std::string& text) {
    const std::vector<double> grid = parse_grid(text, "--wavelengths");
    if (text.find(':') == std::string::npos && grid.size() > 1) {
        user_error("--wavelengths: found '{}', expected bins of one width, as in 380:780:5", text);
    }
    BinRange bins{grid.front(), grid.back(), 1};
    if (grid.size() > 1) bins.step_nm = grid[1] - grid[0];
    return bins;
}

void write_reduction(const Journal& journal, const CaptureOutput& what,
                     const CommonOptions& common) {
    const JournalReductionOptions options = reduction_options(what);
    const auto start = std::chrono::steady_clock::now();
    const JournalReduction result = reduce_journal(journal, options);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    write_file(what.output, result.text);
    print_warnings(result.warnings);
    if (!common.json) return print_summary(journal, result, what);
    std::vector<double> exposures;
    for (const JournalExposure& exposure : journal.exposures) {
        exposures.push_back(exposure.integration_s);
    }
    const ordered_json document = {
        {"rows", result.rows},
        {"retries", journal.retries()},
        {"resumed", what.resumed},
        {"warnings", result.warnings},
        {"output", what.output},
        {"journal", what.journal},
        {"journal_sha256", options.journal_sha256},
        {"recipe_sha256", journal.recipe_sha256},
        {"points", points_done(journal)},
        {"points_planned", points_planned(journal)},
        {"complete", journal.complete},
        {"sample", journal.header->recipe.sample},
        {"virtual", journal.header->is_virtual},
        {"integration_s", exposures},
        {"times", times_json(journal.times)},
        {"reduction_s", seconds},
        {"sigma_common_psi_deg", result.reduction.common_sigma_psi_deg},
        {"sigma_common_delta_deg", result.reduction.common_sigma_delta_deg},
        {"scans", quality_json(result.reduction)}};
    print_json_document(document);
}

}  // namespace drude
