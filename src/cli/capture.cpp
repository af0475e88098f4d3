// `drude capture`: drives a bench through a recipe.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/error.h"
#include "base/files.h"
#include "base/interrupt.h"
#include "base/numbers.h"
#include "base/progress.h"
#include "cli/capture_output.h"
#include "cli/command_list.h"
#include "cli/live_plot.h"
#include "device/sweep/bench_file.h"
#include "device/sweep/correct_azimuths.h"
#include "device/sweep/sweep.h"

namespace drude {

namespace {

struct CaptureOptions {
    std::string recipe, instrument, output, journal, calibration;
    std::string kind, sample, angles, zones, wavelengths, offsets;
    int steps = 0, cycles = 0, averages = 0, darks = 0;
    double integration_ms = 0, solid_angle_sr = 0, half_angle_deg = 0, wait_s = 120;
    uint64_t seed = 0;
    bool resume = false, yes = false;
};

Recipe make_recipe(const CaptureOptions& options, const OptionSet& set) {
    Recipe recipe;
    if (!options.recipe.empty()) recipe = read_recipe(options.recipe);
    if (set.given("--kind")) {
        const RecipeKind kind = recipe_kind(options.kind);
        if (options.recipe.empty()) {
            recipe = default_recipe(kind);
        } else if (kind != recipe.kind) {
            user_error("--kind {}: the recipe {} is of the kind {}", options.kind, options.recipe,
                       recipe_kind_name(recipe.kind));
        }
    }
    if (set.given("--sample")) recipe.sample = options.sample;
    if (set.given("--angles")) recipe.angles_deg = parse_grid(options.angles, "--angles");
    if (set.given("--zones")) recipe.zones_deg = parse_grid(options.zones, "--zones");
    if (set.given("--offsets")) recipe.offsets_deg = parse_grid(options.offsets, "--offsets");
    if (set.given("--steps")) recipe.steps = options.steps;
    if (set.given("--cycles")) recipe.cycles = options.cycles;
    if (set.given("--averages")) recipe.averages = options.averages;
    if (set.given("--darks")) recipe.dark_frames = options.darks;
    if (set.given("--integration")) recipe.integration_s = options.integration_ms / 1000;
    if (set.given("--seed")) recipe.seed = options.seed;
    if (set.given("--solid-angle")) recipe.detector_solid_angle_sr = options.solid_angle_sr;
    if (set.given("--half-angle")) recipe.detector_half_angle_deg = options.half_angle_deg;
    if (set.given("--wavelengths")) {
        const BinRange bins = parse_bins(options.wavelengths);
        recipe.first_nm = bins.first_nm;
        recipe.last_nm = bins.last_nm;
        recipe.step_nm = bins.step_nm;
    }
    recipe.check(options.recipe.empty() ? "recipe" : options.recipe);
    return recipe;
}

// Whoever is asked answers with a line break below the picture.
class AskBelowPlot : public TerminalOperator {
  public:
    AskBelowPlot(bool confirmed, std::shared_ptr<LivePlot> plot)
        : TerminalOperator(confirmed), plot_(std::move(plot)) {}
    void ask(const std::string& request) override {
        TerminalOperator::ask(request);
        plot_->begin_anew();
    }

  private:
    std::shared_ptr<LivePlot> plot_;
};

// m.csv is measured through m.journal.
std::string journal_beside(const std::string& output) {
    return std::filesystem::path(output).replace_extension(".journal").string();
}

int run_capture(const CaptureOptions& options, const OptionSet& set, const CommonOptions& common) {
    if (options.instrument.empty()) {
        user_error(
            "capture: no instrument; name it with --instrument: a bench file, or virtual:MATERIAL");
    }
    if (options.output.empty()) user_error("capture: no output; name the file with -o M.csv");
    if (!(options.wait_s >= 0 && options.wait_s <= 1e6)) {
        user_error("--wait {}: expected seconds from 0 to 1e6", options.wait_s);
    }
    const Recipe recipe = make_recipe(options, set);
    CaptureOutput what;
    what.output = options.output;
    what.journal = options.journal.empty() ? journal_beside(options.output) : options.journal;
    if (what.journal == what.output) {
        user_error("capture: the journal and the output are both '{}'", what.output);
    }
    // What would fail at the end fails now.
    AtomicFile(what.output);
    if (!options.calibration.empty()) read_calibration(options.calibration);

    catch_interrupts();
    const auto plot = std::make_shared<LivePlot>(common.quiet);
    const auto person = std::make_shared<AskBelowPlot>(options.yes, plot);
    Bench bench = open_bench(options.instrument, recipe.seed, person);
    what.calibration = options.calibration.empty() ? bench.calibration : options.calibration;
    if (recipe.kind == RecipeKind::lobe && !what.calibration.empty()) {
        correct_azimuths(read_calibration(what.calibration), &bench);
    }
    std::optional<Progress> progress;
    size_t shown = 0;
    SweepOptions sweep;
    sweep.journal = what.journal;
    sweep.resume = options.resume;
    sweep.retries.reconnect_s = options.wait_s;
    sweep.stop = [] { return interrupted() != 0; };
    sweep.observer.progress = [&](size_t done, size_t total) {
        if (!progress) progress.emplace("capture", total, common.quiet);
        if (done > shown) progress->step(done - shown);
        shown = done;
    };
    sweep.observer.message = [&](const std::string& text) {
        // Over the progress bar. Not fmt::print, which throws where stderr cannot be written: the
        // sweep goes on.
        const char* const clear = can_redraw_stderr() && !common.quiet ? "\r\033[K" : "";
        std::fputs(fmt::format("{}drude: {}\n", clear, text).c_str(), stderr);
        plot->begin_anew();
    };
    sweep.observer.scan_finished = [&](const Journal& so_far) { plot->draw(so_far); };
    const SweepOutcome outcome = run_sweep(bench, recipe, *person, sweep);
    progress.reset();
    if (outcome.stopped) {
        fmt::print(stderr,
                   "drude: interrupted; {} holds {} of {} points, --resume goes on with them\n",
                   what.journal, outcome.journal.points.size(), outcome.journal.plan.size());
        return 128 + interrupted();
    }
    what.resumed = outcome.resumed;
    write_reduction(outcome.journal, what, common);
    return 0;
}

}  // namespace

Command capture_command() {
    Command command;
    command.name = "capture";
    command.summary = "Measure a sample on a bench";
    command.description =
        "Drives a spectroscopic step-scan ellipsometer through a recipe and writes the measurement "
        "(CSV), a lobe scan (CSV), or a calibration of the bench (JSON).\n\n"
        "--instrument is a bench file that says which instruments play polariser, analyser, "
        "retarder, goniometer and spectrometer, virtual:MATERIAL for the simulated bench, or "
        "usbtmc:VID:PID:SERIAL for an instrument that returns Psi and Delta. A bench file:\n"
        "  {\"format\": \"drude-bench/1\", \"spectrometer\": \"ooi:USB4C00001\",\n"
        "   \"polariser\": {\"rotator\": \"ell:DK0AELL1/0\", \"zero_deg\": 12.4, \"direction\": "
        "1},\n"
        "   \"analyser\": {\"fixed_deg\": 45}, \"retarder\": \"manual\",\n"
        "   \"goniometer\": \"manual\", \"calibration\": \"calibration.json\"}\n\n"
        "A bench that has \"head\": \"usbtmc:VID:PID:SERIAL\" instead may say which commands the "
        "instrument knows, where they are not the default ones:\n"
        "  \"scpi\": {\"angle\": \"SOUR:ANG {}\", \"psi_delta\": \"MEAS:PSID?\",\n"
        "   \"wavelengths\": \"SENS:WAV?\", \"next_error\": \"SYST:ERR?\", \"done\": \"*OPC?\",\n"
        "   \"setup\": [], \"format\": \"ascii\", \"move_s\": 120, \"measure_s\": 300}\n\n"
        "RECIPE is a file of format drude-recipe/1; options replace what it says, and without it "
        "they are the recipe:\n"
        "  {\"format\": \"drude-recipe/1\", \"kind\": \"psi-delta\", \"angles_deg\": [65, 70, "
        "75],\n"
        "   \"steps\": 24, \"cycles\": 2, \"zones_deg\": [45, -45], \"averages\": 4}\n"
        "Kinds: psi-delta; lobe (reflectance against the detector's offset, for the roughness); "
        "straight-through (no sample: source, retarder, depth of modulation); azimuth (with a "
        "sample: the plane of incidence; --calibration names what it is added to). A recipe of "
        "kind "
        "lobe also takes straight_through_readings (4: how often the lamp is looked at), "
        "analyser_follows (true), longest_integration_s (10) and relative_floor (2e-4, part of "
        "each sigma).\n\n"
        "Every raw frame goes into a journal beside the output (m.csv: m.journal), which is never "
        "overwritten. After an interrupt, a crash, a full disk or an instrument that was unplugged "
        "for good, the same command with --resume measures what is missing: it checks recipe, "
        "serial numbers and dark, and measures one old point again. `drude reduce` derives the "
        "result again from the journal, e.g. with a new calibration.\n\n"
        "Faults of the bus are tried again; an instrument that is unplugged is waited for. The "
        "drivers are verified against virtual instruments; no hardware was used.";
    command.example =
        "$ drude capture --kind straight-through --instrument virtual:Au-McPeak -o straight.json\n"
        "$ drude capture --kind azimuth --calibration straight.json \\\n"
        "      --instrument virtual:Au-McPeak -o calibration.json\n"
        "$ drude capture --calibration calibration.json --instrument virtual:Cu-McPeak \\\n"
        "      --angles 60,70 -o cu.csv\n"
        "$ drude fit cu.csv -o cu.json\n"
        "$ drude capture --kind lobe --angles 45 --offsets -20:20:1 --solid-angle 2.4e-4 \\\n"
        "      --half-angle 0.5 --instrument bench.json -o lobe.csv\n";
    command.declare = [](OptionSet& set, const CommonOptions& common) {
        const auto options = std::make_shared<CaptureOptions>();
        set.positional("RECIPE", options->recipe, "a recipe (JSON)", false);
        set.option("--instrument", options->instrument, "a bench file, virtual:MATERIAL, or a URI");
        set.option("-o,--output", options->output, "the measurement (CSV) or calibration (JSON)");
        set.option("--journal", options->journal, "raw frames (default: beside the output)");
        set.flag("--resume", options->resume, "go on with the journal");
        set.option("--calibration", options->calibration,
                   "of the bench (default: what the bench file names)");
        set.choice("--kind", options->kind, {"psi-delta", "lobe", "straight-through", "azimuth"},
                   "what to measure (default psi-delta)");
        set.option("--sample", options->sample, "its name, for the header");
        set.option("--angles", options->angles,
                   "of incidence, degrees (default 45,50,60,70,75,80)");
        set.option("--steps", options->steps, "of the polariser in a turn (default 24)");
        set.option("--cycles", options->cycles,
                   "1: without retarder, 2: without and with (default 2)");
        set.option("--zones", options->zones, "azimuths of the analyser (default 45,-45)");
        set.option("--averages", options->averages, "frames at every step (default 4)");
        set.option("--darks", options->darks, "dark frames at every angle (default 16)");
        set.option("--integration", options->integration_ms,
                   "time of a frame in ms (default: automatic)");
        set.option("--wavelengths", options->wavelengths,
                   "bins of the measurement, nm (default 380:780:5)");
        set.option("--seed", options->seed,
                   "of the order of the steps, and of virtual:MATERIAL's noise (default 1)");
        set.option("--offsets", options->offsets, "of the detector, degrees (lobe)");
        set.option("--solid-angle", options->solid_angle_sr, "of the detector, sr (lobe)");
        set.option("--half-angle", options->half_angle_deg,
                   "of the detector's cone, degrees (lobe)");
        set.option("--wait", options->wait_s, "seconds to wait for an unplugged instrument");
        set.flag("--yes", options->yes,
                 "ask nobody: arms, retarder and shutter that are moved by hand are seen to");
        OptionSet* given = &set;
        return [options, given, &common] { return run_capture(*options, *given, common); };
    };
    return command;
}

}  // namespace drude
