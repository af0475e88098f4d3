#include "report/study.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "base/files.h"
#include "base/interrupt.h"
#include "base/progress.h"
#include "base/sha256.h"
#include "device/virtual/virtual_bench.h"
#include "fitter/fit.h"
#include "fitter/fitted_material.h"
#include "fitter/lobe_scatter.h"
#include "fitter/row_residuals.h"
#include "materials/embedded_tables.h"
#include "materials/scalar.h"
#include "render/environment_choice.h"
#include "render/render.h"
#include "report/bench_capture.h"
#include "report/film_sample.h"
#include "report/study_folder.h"
#include "report/study_samples.h"

namespace drude {

namespace {

// Positions of the detector in a lobe scan: as far as the widest of the samples' lobes reaches.
std::vector<double> scan_offsets() {
    std::vector<double> offsets;
    for (int offset = -40; offset <= 40; offset += 2) offsets.push_back(offset);
    return offsets;
}

Recipe lobe_recipe(const VirtualBenchSettings& settings) {
    Recipe recipe = default_recipe(RecipeKind::lobe);
    recipe.offsets_deg = scan_offsets();
    recipe.detector_half_angle_deg = settings.detector_half_angle_deg;
    recipe.detector_solid_angle_sr =
        4 * pi * std::pow(std::sin(settings.detector_half_angle_deg * pi / 360), 2);
    return recipe;
}

class StudyRun {
  public:
    explicit StudyRun(const StudyOptions& options)
        : options_(options),
          progress_("study", 2 + (options.spectral ? 6 : 10) * study_samples().size(),
                    options.quiet) {}

    StudyResult run() {
        const auto start = std::chrono::steady_clock::now();
        prepare_scene();
        prepare_bench();
        Study& study = result_.study;
        for (const StudySample& sample : study_samples()) {
            study.metals.push_back(measure_and_render(sample));
        }
        const CaptureSite site = site_of("anodised-aluminium", study_samples().size());
        study.film = study_film(site, calibration_, provenance(), options_.threads);
        step();
        study.info.seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        write("study.json", format_study_record(study));
        return std::move(result_);
    }

  private:
    void prepare_scene() {
        make_folder(options_.folder);
        const auto& scenes = embedded_scenes();
        const auto half_sphere =
            std::find_if(scenes.begin(), scenes.end(),
                         [](const EmbeddedTable& scene) { return scene.name == "half-sphere"; });
        scene_ = parse_scene(std::string(half_sphere->text), "half-sphere.pbrt");
        replace_environment(&scene_, options_.environment, options_.threads);
        scene_.warnings.clear();  // of the scene's own text, which is the program's

        StudyInfo& info = result_.study.info;
        info.version = DRUDE_VERSION;
        info.command_line = options_.command_line;
        info.environment = std::filesystem::path(options_.environment).filename().string();
        if (info.environment == courtyard_name) {
            info.environment = "courtyard (made by the program)";
        } else if (info.environment.find("uffizi") != std::string::npos) {
            info.environment_credit =
                "Uffizi Gallery light probe courtesy of Paul Debevec, www.debevec.org";
        }
        info.samples_per_pixel = options_.samples_per_pixel;
        info.seed = options_.seed;
        info.lobe = options_.lobe;
        info.masking = options_.masking;
        info.beta = options_.beta;
        info.estimator = "psi-delta";
    }

    Provenance provenance() const {
        Provenance provenance;
        provenance.measurement = "measurement.csv";
        provenance.command = options_.command_line;
        provenance.version = DRUDE_VERSION;
        provenance.warnings = {weighed_by_common_error};
        return provenance;
    }

    // One bench for all samples, calibrated once; noise and jitter of its own for each of them, so
    // that their fits are independent tests.
    CaptureSite site_of(const std::string& within, size_t number) {
        CaptureSite site{options_.folder, within, "virtual " + within,
                         ordinary_bench_settings(options_.seed + number), &result_.files};
        make_folder(options_.folder + "/" + within);
        return site;
    }

    void prepare_bench() {
        const CaptureSite site = site_of("bench", study_samples().size() + 1);
        result_.study.info.bench = format_virtual_bench_settings(site.settings);
        BenchCalibration calibrated = calibrate_bench(site);
        calibration_ = std::move(calibrated.calibration);
        for (const std::string& warning : calibrated.warnings) note("calibration: " + warning);
        lobe_recipe_ = lobe_recipe(site.settings);
        write("bench/psi-delta.json", format_recipe(sweep_recipe_));
        write("bench/lobe.json", format_recipe(lobe_recipe_));
        step();
    }

    StudyMetal measure_and_render(const StudySample& sample) {
        StudyMetal metal;
        metal.name = sample.name;
        metal.folder = sample.folder;
        metal.sample_set = sample.set;
        metal.literature_set = sample.literature;
        const OpticalConstants& truth = published_set(sample.set);
        const OpticalConstants& literature = published_set(sample.literature);
        for (const OpticalConstants* set : {&truth, &literature}) {
            const std::string warning = set->range_warning(spectrum_first_nm, spectrum_last_nm);
            if (!warning.empty()) note(warning);
        }
        const CaptureSite site =
            site_of(sample.folder, static_cast<size_t>(&sample - study_samples().data()));
        const Material made = made_of(sample);
        const std::string folder = metal.folder + "/";
        write(folder + "sample.json", format_material(made));
        write(folder + "bench.json",
              virtual_bench_file(site, "sample.json", "../bench/calibration.json"));

        Captured sweep =
            capture_on_bench(site, made, sweep_recipe_, "measurement.journal", calibration_);
        write(folder + "measurement.csv", sweep.text);
        metal.capture = std::move(sweep.about);
        const Measurement measurement = parse_measurement(sweep.text, folder + "measurement.csv");
        step();

        FitOptions fit_options;
        fit_options.threads = options_.threads;
        fit_options.chi2_common_scatter = chi2_common_scatter(measurement, metal.capture.common);
        const Measurement weighed = with_common_error(measurement, metal.capture.common);
        const FitResult fit = fit_measurement(weighed, fit_options);
        metal.reduced_chi2 = fit.chi2_reduced();
        metal.dof = fit.dof();
        for (const RowResidual& row : row_residuals(fit, measurement, fit_options)) {
            if (std::isfinite(row.squared())) metal.noise_chi2 += row.squared() / fit.dof();
        }
        Provenance from = provenance();
        from.measurement_sha256 = sha256(sweep.text);
        Material fitted = fitted_material(fit, measurement, sample.folder, from);
        Material published = material_from_set(literature);

        metal.lobe = scan_lobe(site, made, fitted);
        step();

        render_finish(folder, fitted, published, Finish::rough, metal.lobe->fit);
        render_finish(folder, fitted, published, Finish::smooth, metal.lobe->fit);
        return metal;
    }

    StudyLobe scan_lobe(const CaptureSite& site, const Material& made, const Material& fitted) {
        Captured scan =
            capture_on_bench(site, made, lobe_recipe_, "lobe-scan.journal", calibration_);
        write(site.within + "/lobe-scan.csv", scan.text);
        StudyLobe lobe;
        lobe.true_lobe = made.lobe;
        lobe.true_masking = made.masking;
        lobe.true_beta = made.beta;
        lobe.capture = std::move(scan.about);
        lobe.scan = parse_lobe_scan(scan.text, site.within + "/lobe-scan.csv");
        lobe.fit = fit_lobes(lobe.scan, fitted);
        for (const FittedLobe& one : lobe.fit.lobes) {
            lobe.sigma.push_back(std::max(one.sigma_beta, scatter_of_beta(lobe.scan, fitted, one)));
        }
        return lobe;
    }

    // The surface of both: that of the options, or what the lobe scan says.
    void render_finish(const std::string& folder, Material fitted, Material published,
                       Finish finish, const LobeFitResult& scan) {
        const bool rough = finish == Finish::rough;
        if (rough) {
            // Of lobes that the scan does not tell apart the best stands for all.
            set_fitted_lobe(scan, std::string(lobe_name(scan.lobes.front().lobe)), &fitted);
        } else {
            fitted.lobe = parse_lobe(options_.lobe);
            fitted.masking = parse_masking(options_.masking);
            fitted.beta = options_.beta;
        }
        published.lobe = fitted.lobe;
        published.masking = fitted.masking;
        published.beta = fitted.beta;
        fitted.check();
        published.check();
        const std::string end = rough ? "-rough.json" : ".json";
        write(folder + "fitted" + end, format_material(fitted));
        write(folder + "literature" + end, format_material(published));
        render_pair(folder, fitted, published, finish);
    }

    // The same seed for both: equal paths, so that the difference is the metals' alone.
    void render_pair(const std::string& folder, const Material& fitted, const Material& published,
                     Finish finish) {
        const int side = options_.resolution, small = std::max(1, side / 4);
        for (const bool spectral : {false, true}) {
            if (spectral && options_.spectral) break;
            for (const bool is_fitted : {true, false}) {
                render_to(folder + picture_file(is_fitted, finish, spectral),
                          is_fitted ? fitted : published, spectral ? small : side,
                          spectral || options_.spectral);
            }
        }
    }

    void render_to(const std::string& file, const Material& material, int side, bool spectral) {
        ConductorMaterial conductor;
        conductor.surface = material;
        scene_.materials.assign(scene_.materials.size(), conductor);
        scene_.film.width = scene_.film.height = side;
        RenderOptions options;
        options.samples_per_pixel = options_.samples_per_pixel;
        options.seed = options_.seed;
        options.stokes = true;
        options.spectral = spectral;
        options.threads = options_.threads;
        options.quiet = true;
        RenderResult rendered = render(scene_, options);
        if (rendered.interrupted) stop();
        for (const std::string& warning : rendered.warnings) note(warning);
        StudyInfo& info = result_.study.info;
        info.render_seconds += rendered.render_seconds;
        Image& image = rendered.image;
        image.attributes["commandLine"] = options_.command_line;
        image.attributes["material"] = material.substrate.name;
        if (!info.environment_credit.empty()) image.attributes["credit"] = info.environment_credit;
        write_exr(options_.folder + "/" + file, image, Compression::piz);
        result_.files.push_back(file);
        step();
    }

    void note(const std::string& text) {
        std::vector<std::string>& notes = result_.study.info.notes;
        if (std::find(notes.begin(), notes.end(), text) == notes.end()) notes.push_back(text);
    }

    void write(const std::string& file, const std::string& bytes) {
        write_file(options_.folder + "/" + file, bytes);
        result_.files.push_back(file);
    }

    [[noreturn]] void stop() const {
        throw Error(Cause::outside,
                    fmt::format("interrupted; {} holds what is finished", options_.folder));
    }

    void step() {
        progress_.step();
        if (interrupted()) stop();
    }

    StudyOptions options_;
    Progress progress_;
    Scene scene_;
    Recipe sweep_recipe_ = default_recipe(RecipeKind::psi_delta), lobe_recipe_;
    Calibration calibration_;
    StudyResult result_;
};

}  // namespace

StudyResult run_study(const StudyOptions& options) {
    if (options.resolution < 1 || options.resolution > 16384) {
        user_error("a resolution of {} pixels; expected 1 to 16384", options.resolution);
    }
    if (options.samples_per_pixel < 1) {
        user_error("{} samples per pixel; expected at least 1", options.samples_per_pixel);
    }
    return StudyRun(options).run();
}

}  // namespace drude
