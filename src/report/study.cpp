#include "report/study.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "base/error.h"
#include "base/files.h"
#include "base/interrupt.h"
#include "base/progress.h"
#include "base/sha256.h"
#include "device/virtual/ellipsometer_simulation.h"
#include "fitter/fit.h"
#include "fitter/fitted_material.h"
#include "materials/embedded_tables.h"
#include "render/environment_choice.h"
#include "render/render.h"
#include "report/film_sample.h"
#include "report/study_folder.h"

namespace drude {

namespace {

struct Sample {
    const char* name;
    const char* folder;
    const char* set;         // what the virtual sample is made of
    const char* literature;  // what it is compared with
};

// Two independent publications for each metal: one stands for the sample on the table, the other
// for the handbook.
constexpr Sample samples[] = {
    {"Copper", "copper", "Cu-McPeak", "Cu-Hagemann"},
    {"Silver", "silver", "Ag-McPeak", "Ag-Ferrera-298K"},
    {"Gold", "gold", "Au-McPeak", "Au-Johnson"},
    {"Aluminium", "aluminium", "Al-McPeak", "Al-Rakic"},
    {"Zinc coating", "zinc", "Zn-Werner-DFT", "Zn-Werner"},
};

class StudyRun {
  public:
    explicit StudyRun(const StudyOptions& options)
        : options_(options), progress_("study", 5 * std::size(samples) + 1, options.quiet) {}

    StudyResult run() {
        const auto start = std::chrono::steady_clock::now();
        prepare_scene();
        Study& study = result_.study;
        for (const Sample& sample : samples) study.metals.push_back(measure_and_render(sample));
        // Noise of its own, as every metal has.
        study.film = study_film(options_.folder, options_.seed + std::size(samples), provenance(),
                                options_.threads, &result_.files);
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
        return provenance;
    }

    StudyMetal measure_and_render(const Sample& sample) {
        StudyMetal metal;
        metal.name = sample.name;
        metal.folder = sample.folder;
        metal.sample_set = sample.set;
        metal.literature_set = sample.literature;
        // Noise of its own for every metal, so that their fits are independent tests.
        metal.seed = options_.seed + static_cast<uint64_t>(&sample - samples);
        const OpticalConstants& truth = published_set(sample.set);
        const OpticalConstants& literature = published_set(sample.literature);
        for (const OpticalConstants* set : {&truth, &literature}) {
            const std::string warning = set->range_warning(spectrum_first_nm, spectrum_last_nm);
            if (!warning.empty()) note(warning);
        }

        // Measured at the angles of the original study, with its instrument's inaccuracy.
        SimulationSetup setup;
        setup.angles_deg = {45, 50, 60, 70, 75, 80};
        for (int nm = 380; nm <= 780; nm += 5) setup.wavelengths_nm.push_back(nm);
        setup.seed = metal.seed;
        const Measurement measurement = simulate_ellipsometer(material_from_set(truth), setup);
        const std::string folder = metal.folder + "/";
        make_folder(options_.folder + "/" + metal.folder);
        const std::string measurement_text = format_measurement(measurement);
        write(folder + "measurement.csv", measurement_text);

        FitOptions fit_options;
        fit_options.threads = options_.threads;
        const FitResult fit = fit_measurement(measurement, fit_options);
        metal.reduced_chi2 = fit.chi2_reduced();
        metal.dof = fit.dof();
        Provenance from = provenance();
        from.measurement_sha256 = sha256(measurement_text);
        Material fitted = fitted_material(fit, measurement, sample.folder, from);
        Material published = material_from_set(literature);
        for (Material* material : {&fitted, &published}) {
            material->lobe = parse_lobe(options_.lobe);
            material->masking = parse_masking(options_.masking);
            material->beta = options_.beta;
            material->check();
        }
        write(folder + "fitted.json", format_material(fitted));
        write(folder + "literature.json", format_material(published));
        step();

        // The same seed for both: equal paths, so that the difference is the metals' alone.
        const int side = options_.resolution, small = std::max(1, side / 4);
        render_to(folder + "fitted.exr", fitted, side, options_.spectral);
        render_to(folder + "literature.exr", published, side, options_.spectral);
        if (!options_.spectral) {
            render_to(folder + "fitted-spectral.exr", fitted, small, true);
            render_to(folder + "literature-spectral.exr", published, small, true);
        }
        return metal;
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
    StudyResult result_;
};

}  // namespace

StudyResult run_study(const StudyOptions& options) {
    if (options.resolution < 1 || options.resolution > 16384) {
        user_error("a resolution of {} pixels; expected 1 to 16384", options.resolution);
    }
    return StudyRun(options).run();
}

}  // namespace drude
