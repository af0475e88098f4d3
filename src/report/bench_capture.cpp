#include "report/bench_capture.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "base/interrupt.h"
#include "base/sha256.h"
#include "device/sweep/correct_azimuths.h"
#include "device/sweep/journal_reduction.h"
#include "device/sweep/sweep.h"
#include "device/virtual/virtual_bench.h"

namespace drude {

namespace {

// All parts are motorised.
class NobodyThere : public Operator {
  public:
    void ask(const std::string& request) override {
        outside_error("virtual bench: found nobody to {}", request);
    }
};

void describe(const SweepOutcome& outcome, const JournalReduction& reduction, StudyCapture* about) {
    const Journal& journal = outcome.journal;
    for (const JournalExposure& exposure : journal.exposures) {
        about->integration_s = exposure.integration_s;
    }
    for (const JournalPoint& point : journal.points) about->frames += point.frames.size();
    about->bench_seconds = journal.times.total;
    about->retries = outcome.retries;
    const Reduction& r = reduction.reduction;
    for (size_t i = 0; i < r.angles_deg.size(); ++i) {
        about->common.push_back(
            {r.angles_deg[i], r.common_sigma_psi_deg[i], r.common_sigma_delta_deg[i]});
    }
    double squares = 0;
    for (const ScanQuality& scan : r.quality) {
        about->harmonic_4 = std::max(about->harmonic_4, scan.harmonic_4);
        about->drift = std::max(about->drift, std::abs(scan.drift));
        about->step_jitter_deg += scan.step_jitter_deg;
        about->saturated += static_cast<size_t>(scan.saturated);
        squares += scan.residual_over_noise * scan.residual_over_noise;
    }
    const double scans = std::max<double>(1, static_cast<double>(r.quality.size()));
    about->step_jitter_deg /= scans;
    about->residual_over_noise = std::sqrt(squares / scans);
    about->warnings = reduction.warnings;
}

void write(const CaptureSite& site, const std::string& file, const std::string& text) {
    const std::string name = site.within + "/" + file;
    write_file(site.folder + "/" + name, text);
    site.files->push_back(name);
}

}  // namespace

Captured capture_on_bench(const CaptureSite& site, const Material& sample, const Recipe& recipe,
                          const std::string& journal, const Calibration& calibration) {
    const std::string name = site.within + "/" + journal, path = site.folder + "/" + name;
    std::filesystem::remove(path);
    Bench bench = make_virtual_bench(sample, site.settings);
    bench.name = site.bench;
    if (recipe.kind == RecipeKind::lobe) correct_azimuths(calibration, &bench);
    NobodyThere nobody;
    SweepOptions options;
    options.journal = path;
    options.stop = [] { return interrupted(); };
    const SweepOutcome outcome = run_sweep(bench, recipe, nobody, options);
    site.files->push_back(name);
    if (outcome.stopped) {
        throw Error(Cause::outside,
                    fmt::format("interrupted; {} holds what is finished", site.folder));
    }
    JournalReductionOptions reduction_options;
    reduction_options.calibration = calibration;
    if (!calibration.provenance.empty()) reduction_options.calibration_name = "calibration.json";
    reduction_options.journal_name = journal;
    reduction_options.journal_sha256 = sha256(read_file(path));
    const JournalReduction reduction = reduce_journal(outcome.journal, reduction_options);
    Captured captured;
    captured.text = reduction.text;
    captured.about.seed = site.settings.seed;
    describe(outcome, reduction, &captured.about);
    return captured;
}

std::string virtual_bench_file(const CaptureSite& site, const std::string& material,
                               const std::string& calibration) {
    const nlohmann::ordered_json bench = {
        {"format", "drude-bench/1"},
        {"name", site.bench},
        {"virtual",
         {{"material", material},
          {"settings",
           nlohmann::ordered_json::parse(format_virtual_bench_settings(site.settings))}}},
        {"calibration", calibration}};
    return bench.dump(2) + "\n";
}

BenchCalibration calibrate_bench(const CaptureSite& site) {
    BenchCalibration result;
    Material gold = material_from_set(published_set("Au-McPeak"));
    gold.name = "gold mirror";
    write(site, "reference.json", format_material(gold));
    const auto run = [&](RecipeKind kind, const std::string& file) {
        Recipe recipe = default_recipe(kind);
        // What a calibration leaves is common to everything that is measured with it.
        recipe.averages = 16;
        write(site, file + ".json", format_recipe(recipe));
        const Captured captured =
            capture_on_bench(site, gold, recipe, file + ".journal", result.calibration);
        result.calibration = parse_calibration(captured.text, file);
        result.warnings.insert(result.warnings.end(), captured.about.warnings.begin(),
                               captured.about.warnings.end());
    };
    run(RecipeKind::straight_through, "straight-through");
    run(RecipeKind::azimuth, "azimuth");
    write(site, "calibration.json", format_calibration(result.calibration));
    write(site, "bench.json", virtual_bench_file(site, "reference.json", "calibration.json"));
    return result;
}

}  // namespace drude
