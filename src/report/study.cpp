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
#include "device/ellipsometer_simulation.h"
#include "fitter/fit.h"
#include "fitter/fitted_material.h"
#include "fitter/literature.h"
#include "image/difference.h"
#include "image/image.h"
#include "image/sheet.h"
#include "image/tonemap.h"
#include "materials/embedded_tables.h"
#include "materials/fresnel.h"
#include "render/environment_choice.h"
#include "render/render.h"

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

class Study {
  public:
    explicit Study(const StudyOptions& options)
        : options_(options), progress_("study", 6 * std::size(samples), options.quiet) {}

    StudyResult run() {
        const auto start = std::chrono::steady_clock::now();
        prepare_scene();
        Sheet sheet;
        sheet.row_captions = {"fitted", "literature", "log10 difference"};
        sheet.cells.resize(3);
        sheet.bars[2] = log_difference_bar();
        for (const Sample& sample : samples) {
            StudyMetal metal = study(sample, &sheet);
            sheet.column_captions.push_back(sample.name);
            result_.metals.push_back(std::move(metal));
        }
        const Picture picture = compose_sheet(sheet);
        result_.info.sheet_png = encode_png(picture.width, picture.height, picture.rgb);
        write("comparison.png", result_.info.sheet_png);
        result_.info.seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        write("summary.csv", study_summary_csv(result_.info, result_.metals));
        write("index.html", study_page(result_.info, result_.metals));
        // The page says the first two in its own words.
        result_.notes = result_.info.notes;
        result_.notes.insert(
            result_.notes.begin(),
            {"No hardware was measured: each sample is virtual, made of one published set of "
             "optical constants, and its measurement is simulated.",
             "Zn-Werner-DFT is a calculation (density functional theory), not a measurement."});
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
        scene_.film.width = scene_.film.height = options_.resolution;
        scene_.warnings.clear();  // of the scene's own text, which is the program's

        StudyInfo& info = result_.info;
        info.version = DRUDE_VERSION;
        info.command_line = options_.command_line;
        info.environment = std::filesystem::path(options_.environment).filename().string();
        if (info.environment == courtyard_name) {
            info.environment = "courtyard (made by the program)";
        } else if (info.environment.find("uffizi") != std::string::npos) {
            info.environment_credit =
                "Uffizi Gallery light probe courtesy of Paul Debevec, www.debevec.org";
        }
        info.lobe = options_.lobe;
        info.masking = options_.masking;
        info.beta = options_.beta;
        info.estimator = "psi-delta";
    }

    StudyMetal study(const Sample& sample, Sheet* sheet) {
        StudyMetal metal;
        metal.name = sample.name;
        // Noise of its own for every metal, so that their fits are independent tests.
        metal.seed = options_.seed + static_cast<uint64_t>(&sample - samples);
        const OpticalConstants& truth = published_set(sample.set);
        const OpticalConstants& literature = published_set(sample.literature);
        metal.sample_set = truth.name;
        metal.sample_set_citation = truth.citation;
        metal.literature = literature;
        metal.literature_set = literature.name;
        metal.literature_set_citation = literature.citation;
        for (const OpticalConstants& set : published_sets()) {
            if (set.material == truth.material) metal.published.push_back(set);
        }
        for (const OpticalConstants* set : {&truth, &literature}) {
            const std::string warning = set->range_warning(spectrum_first_nm, spectrum_last_nm);
            if (!warning.empty()) result_.info.notes.push_back(warning);
        }

        // Measured at the angles of the original study, with its instrument's inaccuracy.
        SimulationSetup setup;
        setup.angles_deg = {45, 50, 60, 70, 75, 80};
        for (int nm = 380; nm <= 780; nm += 5) setup.wavelengths_nm.push_back(nm);
        setup.sigma_psi_deg = 0.05;
        setup.sigma_delta_deg = 0.1;
        setup.seed = metal.seed;
        metal.measurement = simulate_ellipsometer(material_from_set(truth), setup);
        const std::string folder = std::string(sample.folder) + "/";
        make_folder(options_.folder + "/" + sample.folder);
        const std::string measurement_text = format_measurement(metal.measurement);
        write(folder + "measurement.csv", measurement_text);
        step();

        FitOptions fit_options;
        fit_options.threads = options_.threads;
        const FitResult fit = fit_measurement(metal.measurement, fit_options);
        metal.reduced_chi2 = fit.chi2_reduced();
        metal.dof = fit.dof();
        Provenance provenance;
        provenance.measurement = "measurement.csv";
        provenance.measurement_sha256 = sha256(measurement_text);
        provenance.command = options_.command_line;
        provenance.version = DRUDE_VERSION;
        Material fitted = fitted_material(fit, metal.measurement, sample.folder, provenance);
        Material published = material_from_set(literature);
        for (Material* material : {&fitted, &published}) {
            material->lobe = parse_lobe(options_.lobe);
            material->masking = parse_masking(options_.masking);
            material->beta = options_.beta;
            material->check();
        }
        metal.fitted = fitted.substrate;
        write(folder + "fitted.json", format_material(fitted));
        write(folder + "literature.json", format_material(published));
        compare_constants(&metal);
        write(folder + "nk.csv", study_nk_csv(result_.info, metal));
        setup.sigma_psi_deg = setup.sigma_delta_deg = 0;
        metal.fitted_curve = simulate_ellipsometer(fitted, setup);
        step();

        // The same seed for both: equal paths, so that the difference is the metals' alone.
        const Image fitted_image = picture_of(fitted, folder + "fitted.exr");
        const Image published_image = picture_of(published, folder + "literature.exr");
        compare_pictures(fitted_image, published_image, folder, &metal, sheet);
        step();
        return metal;
    }

    void compare_constants(StudyMetal* metal) const {
        const ConstantsDistance distance = constants_distance(metal->fitted, metal->literature);
        metal->rms_dn = distance.rms_dn;
        metal->rms_dk = distance.rms_dk;
    }

    Image picture_of(const Material& material, const std::string& file) {
        ConductorMaterial conductor;
        conductor.surface = material;
        scene_.materials.assign(scene_.materials.size(), conductor);
        RenderOptions options;
        options.samples_per_pixel = options_.samples_per_pixel;
        options.seed = options_.seed;
        options.stokes = true;
        options.spectral = options_.spectral;
        options.threads = options_.threads;
        options.quiet = true;
        RenderResult rendered = render(scene_, options);
        if (rendered.interrupted) {
            throw Error(Cause::outside,
                        fmt::format("interrupted; {} holds what is finished", options_.folder));
        }
        for (const std::string& warning : rendered.warnings) {
            std::vector<std::string>& notes = result_.info.notes;
            if (std::find(notes.begin(), notes.end(), warning) == notes.end()) {
                notes.push_back(warning);
            }
        }
        result_.render_seconds += rendered.render_seconds;
        Image& image = rendered.image;
        image.attributes["commandLine"] = options_.command_line;
        image.attributes["material"] = material.substrate.name;
        if (!result_.info.environment_credit.empty()) {
            image.attributes["credit"] = result_.info.environment_credit;
        }
        write_exr(options_.folder + "/" + file, image, Compression::piz);
        result_.files.push_back(file);
        step();
        return std::move(rendered.image);
    }

    void compare_pictures(const Image& fitted, const Image& published, const std::string& folder,
                          StudyMetal* metal, Sheet* sheet) {
        const int width = fitted.width, height = fitted.height;
        const std::vector<double> differences = log_difference(fitted, published, {"R", "G", "B"});
        metal->log10_difference = summary(differences);
        const ColourBar bar = log_difference_bar();
        const Picture difference = map_values(width, height, differences, bar);
        const Picture with_bar = with_colour_bar(difference, bar);
        metal->difference_png = encode_png(with_bar.width, with_bar.height, with_bar.rgb);
        write(folder + "difference.png", metal->difference_png);

        // One compression, that of the fitted picture, for both of the pair.
        DurandOptions durand;
        durand.threads = options_.threads;
        const std::vector<float> fitted_rgb = interleaved(fitted);
        const DurandParameters parameters = durand_parameters(width, height, fitted_rgb, durand);
        Picture a, b;
        a.width = b.width = width;
        a.height = b.height = height;
        a.rgb = tonemap_durand(width, height, fitted_rgb, parameters, durand);
        b.rgb = tonemap_durand(width, height, interleaved(published), parameters, durand);
        metal->fitted_png = encode_png(width, height, a.rgb);
        metal->literature_png = encode_png(width, height, b.rgb);
        write(folder + "fitted.png", metal->fitted_png);
        write(folder + "literature.png", metal->literature_png);
        sheet->cells[0].push_back(std::move(a));
        sheet->cells[1].push_back(std::move(b));
        sheet->cells[2].push_back(difference);
        step();
    }

    static std::vector<float> interleaved(const Image& image) {
        std::vector<float> rgb(image.pixels() * 3);
        for (size_t c = 0; c < 3; ++c) {
            const Channel& channel = image.at(std::string(1, "RGB"[c]), "the rendered picture");
            for (size_t i = 0; i < image.pixels(); ++i) rgb[3 * i + c] = channel.data[i];
        }
        return rgb;
    }

    // Over the pixels that differ: the background, equal to the bit, has no logarithm.
    static Log10Difference summary(const std::vector<double>& differences) {
        std::vector<double> finite;
        for (const double d : differences) {
            if (std::isfinite(d)) finite.push_back(d);
        }
        Log10Difference s;
        if (finite.empty()) return s;
        std::sort(finite.begin(), finite.end());
        double total = 0;
        for (const double d : finite) total += d;
        s.mean = total / static_cast<double>(finite.size());
        s.p50 = finite[(finite.size() - 1) / 2];
        s.p99 = finite[(finite.size() - 1) * 99 / 100];
        s.max = finite.back();
        return s;
    }

    void write(const std::string& file, const std::string& bytes) {
        write_file(options_.folder + "/" + file, bytes);
        result_.files.push_back(file);
    }

    void step() {
        progress_.step();
        if (interrupted()) {
            throw Error(Cause::outside,
                        fmt::format("interrupted; {} holds what is finished", options_.folder));
        }
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
    return Study(options).run();
}

}  // namespace drude
