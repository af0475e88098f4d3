#include "report/study_folder.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "base/numbers.h"
#include "device/virtual/ellipsometer_simulation.h"
#include "fitter/literature.h"
#include "materials/json_tree.h"
#include "report/capture_record.h"

namespace drude {

namespace {

constexpr const char* format_name = "drude-study/2";
constexpr uint64_t largest_record = uint64_t{1} << 22;

// A folder within the study's: a single name, so that a record cannot lead elsewhere.
std::string folder_name(const JsonValue& value) {
    std::string name = value.string();
    if (name.empty() || name == "." || name == ".." || name.find('/') != std::string::npos) {
        user_error_at(value.place(), "{}: found '{}', expected the name of a folder in the study's",
                      value.shown(), name);
    }
    return name;
}

const OpticalConstants& set_of(const JsonValue& value) {
    return *value.located([&] { return &published_set(value.string()); });
}

// Psi and Delta of `material` without noise, on the grid of `like`.
Measurement curve_of(const Material& material, const Measurement& like) {
    SimulationSetup setup;
    setup.angles_deg = like.angles();
    setup.wavelengths_nm = like.wavelengths();
    setup.sigma_psi_deg = setup.sigma_delta_deg = 0;
    return simulate_ellipsometer(material, setup);
}

StudyInfo read_info(const JsonValue& root) {
    StudyInfo info;
    info.version = root.at("version").string();
    info.command_line = root.at("command_line").string();
    info.environment = root.at("environment").string();
    info.environment_credit = root.at("environment_credit").string();
    info.seconds = root.at("seconds").number();
    info.render_seconds = root.at("render_seconds").number();
    info.samples_per_pixel =
        static_cast<int>(std::clamp(root.at("samples_per_pixel").number(), 0.0, 2147483647.0));
    info.seed = root.at("seed").quoted_whole_number();
    info.lobe = root.at("lobe").string();
    info.masking = root.at("masking").string();
    info.beta = root.at("beta").number();
    info.estimator = root.at("estimator").string();
    info.bench = root.at("bench").string();
    info.notes = root.at("notes").strings();
    return info;
}

StudyMetal read_metal(const std::string& folder, const JsonValue& value) {
    value.allow_keys({"name", "folder", "sample_set", "literature_set", "capture", "reduced_chi2",
                      "noise_chi2", "dof", "lobe"});
    StudyMetal metal;
    metal.name = value.at("name").string();
    metal.folder = folder_name(value.at("folder"));
    const OpticalConstants& sample = set_of(value.at("sample_set"));
    metal.literature = set_of(value.at("literature_set"));
    metal.sample_set = sample.name;
    metal.sample_set_citation = sample.citation;
    metal.literature_set = metal.literature.name;
    metal.literature_set_citation = metal.literature.citation;
    metal.capture = read_capture(value.at("capture"));
    metal.reduced_chi2 = value.at("reduced_chi2").number();
    metal.noise_chi2 = value.at("noise_chi2").number();
    metal.dof = value.at("dof").number();
    for (const OpticalConstants& set : published_sets()) {
        if (set.material == sample.material) metal.published.push_back(set);
    }
    const std::string inside = folder + "/" + metal.folder + "/";
    metal.measurement = read_measurement(inside + "measurement.csv");
    const Material fitted = read_material(inside + "fitted.json");
    metal.fitted = fitted.substrate;
    metal.fitted_curve = curve_of(fitted, metal.measurement);
    compare_constants(&metal);
    if (value.has("lobe")) {
        metal.lobe = read_lobe(value.at("lobe"));
        metal.lobe->scan = read_lobe_scan(inside + "lobe-scan.csv");
        const Material made = read_material(inside + "sample.json");
        metal.lobe->true_lobe = made.lobe;
        metal.lobe->true_masking = made.masking;
        metal.lobe->true_beta = made.beta;
        metal.lobe->surface = read_material(inside + "fitted-rough.json");
    }
    return metal;
}

StudyFilm read_film(const std::string& folder, const JsonValue& value) {
    value.allow_keys({"name", "folder", "substrate_set", "film_set", "capture", "film_chi2",
                      "film_dof", "noise_chi2", "bare_chi2", "bare_dof", "parameters"});
    StudyFilm film;
    film.name = value.at("name").string();
    film.folder = folder_name(value.at("folder"));
    film.substrate_set = set_of(value.at("substrate_set")).name;
    film.film_set = set_of(value.at("film_set")).name;
    film.capture = read_capture(value.at("capture"));
    film.noise_chi2 = value.at("noise_chi2").number();
    film.film_chi2 = value.at("film_chi2").number();
    film.film_dof = value.at("film_dof").number();
    film.bare_chi2 = value.at("bare_chi2").number();
    film.bare_dof = value.at("bare_dof").number();
    for (const JsonValue& entry : value.at("parameters").array()) {
        entry.allow_keys({"name", "unit", "value", "sigma", "truth"});
        // Without a sigma the data do not determine it.
        film.parameters.push_back({entry.at("name").string(), entry.at("unit").string(),
                                   entry.at("value").number(),
                                   entry.has("sigma") ? entry.at("sigma").number()
                                                      : std::numeric_limits<double>::quiet_NaN(),
                                   entry.at("truth").number()});
    }
    const std::string inside = folder + "/" + film.folder + "/";
    film.measurement = read_measurement(inside + "measurement.csv");
    film.sample = read_material(inside + "sample.json");
    film.fitted = read_material(inside + "fitted.json");
    film.fitted_curve = curve_of(film.fitted, film.measurement);
    film.bare = read_material(inside + "bare.json").substrate;
    return film;
}

bool has_spectra(const Image& image) {
    return std::any_of(image.channels.begin(), image.channels.end(), [](const Channel& channel) {
        return channel.name.rfind("S0.", 0) == 0 && channel.name.find("nm") != std::string::npos;
    });
}

Image read_picture(const std::string& path) {
    Image image = read_exr(path);
    for (const char* layer : {"S0.", "S1.", "S2.", "S3."}) {
        for (const char c : {'R', 'G', 'B'}) image.at(std::string(layer) + c, path);
    }
    return image;
}

void expect_one_size(const Image& a, const Image& b, const std::string& folder) {
    if (a.width == b.width && a.height == b.height) return;
    user_error(
        "{}: the fitted picture has {} x {} pixels, the literature's {} x {}; render both "
        "with one resolution",
        folder, a.width, a.height, b.width, b.height);
}

}  // namespace

std::string format_study_record(const Study& study) {
    using nlohmann::ordered_json;
    const StudyInfo& info = study.info;
    // Whole numbers of 64 bits in quotes: JSON's numbers are doubles.
    const auto whole = [](uint64_t number) { return fmt::format("{}", number); };
    ordered_json record = {{"format", format_name},
                           {"version", info.version},
                           {"command_line", info.command_line},
                           {"environment", info.environment},
                           {"environment_credit", info.environment_credit},
                           {"seconds", info.seconds},
                           {"render_seconds", info.render_seconds},
                           {"samples_per_pixel", info.samples_per_pixel},
                           {"seed", whole(info.seed)},
                           {"lobe", info.lobe},
                           {"masking", info.masking},
                           {"beta", info.beta},
                           {"estimator", info.estimator},
                           {"bench", info.bench},
                           {"notes", info.notes},
                           {"metals", ordered_json::array()}};
    for (const StudyMetal& metal : study.metals) {
        record["metals"].push_back({{"name", metal.name},
                                    {"folder", metal.folder},
                                    {"sample_set", metal.sample_set},
                                    {"literature_set", metal.literature_set},
                                    {"capture", capture_json(metal.capture)},
                                    {"reduced_chi2", metal.reduced_chi2},
                                    {"noise_chi2", metal.noise_chi2},
                                    {"dof", metal.dof}});
        if (metal.lobe) record["metals"].back()["lobe"] = lobe_json(*metal.lobe);
    }
    if (study.film) {
        const StudyFilm& film = *study.film;
        ordered_json parameters = ordered_json::array();
        for (const StudyParameter& p : film.parameters) {
            parameters.push_back({{"name", p.name}, {"unit", p.unit}, {"value", p.value}});
            if (std::isfinite(p.sigma)) parameters.back()["sigma"] = p.sigma;
            parameters.back()["truth"] = p.truth;
        }
        record["film"] = {{"name", film.name},
                          {"folder", film.folder},
                          {"substrate_set", film.substrate_set},
                          {"film_set", film.film_set},
                          {"capture", capture_json(film.capture)},
                          {"film_chi2", film.film_chi2},
                          {"film_dof", film.film_dof},
                          {"noise_chi2", film.noise_chi2},
                          {"bare_chi2", film.bare_chi2},
                          {"bare_dof", film.bare_dof},
                          {"parameters", parameters}};
    }
    return record.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

Study read_study(const std::string& folder) {
    const std::string path = folder + "/study.json";
    if (!std::filesystem::exists(path)) {
        user_error(
            "{}: holds no study (no study.json); expected the folder that "
            "'drude reproduce -o DIR' wrote",
            folder);
    }
    const JsonDocument document = parse_json_tree(read_file(path, largest_record), path);
    const JsonValue root(document);
    const std::string format = root.at("format").string();
    if (format != format_name) {
        user_error_at(root.at("format").place(),
                      "found the format '{}', expected '{}'; 'drude reproduce -o DIR' of this "
                      "version makes the study again",
                      format, format_name);
    }
    root.allow_keys({"format", "version", "command_line", "environment", "environment_credit",
                     "seconds", "render_seconds", "samples_per_pixel", "seed", "lobe", "masking",
                     "beta", "estimator", "bench", "notes", "metals", "film"});
    Study study;
    study.info = read_info(root);
    for (const JsonValue& value : root.at("metals").array()) {
        study.metals.push_back(read_metal(folder, value));
    }
    if (study.metals.empty()) user_error_at(root.at("metals").place(), "a study without a metal");
    if (root.has("film")) study.film = read_film(folder, root.at("film"));
    return study;
}

std::string picture_file(bool fitted, Finish finish, bool spectral) {
    return fmt::format("{}{}{}.exr", fitted ? "fitted" : "literature",
                       finish == Finish::rough ? "-rough" : "", spectral ? "-spectral" : "");
}

StudyPair read_pair(const std::string& folder, const StudyMetal& metal, Finish finish) {
    const std::string inside = folder + "/" + metal.folder + "/";
    StudyPair pair;
    pair.fitted = read_picture(inside + picture_file(true, finish, false));
    pair.literature = read_picture(inside + picture_file(false, finish, false));
    expect_one_size(pair.fitted, pair.literature, inside);
    if (has_spectra(pair.fitted) && has_spectra(pair.literature)) {
        pair.fitted_spectral = pair.fitted;
        pair.literature_spectral = pair.literature;
        return pair;
    }
    const std::string a = inside + picture_file(true, finish, true);
    const std::string b = inside + picture_file(false, finish, true);
    if (!std::filesystem::exists(a) || !std::filesystem::exists(b)) return pair;
    pair.fitted_spectral = read_picture(a);
    pair.literature_spectral = read_picture(b);
    pair.spectral_is_smaller = true;
    expect_one_size(pair.fitted_spectral, pair.literature_spectral, inside);
    return pair;
}

void compare_constants(StudyMetal* metal) {
    const ConstantsDistance distance = constants_distance(metal->fitted, metal->literature);
    metal->rms_dn = distance.rms_dn;
    metal->rms_dk = distance.rms_dk;
}

}  // namespace drude
