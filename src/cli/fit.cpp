// `drude fit`: optical constants from a measurement.
#include "fitter/fit.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>

#include "base/error.h"
#include "base/files.h"
#include "base/numbers.h"
#include "base/sha256.h"
#include "cli/command_list.h"
#include "cli/fit_output.h"
#include "cli/fit_paper.h"
#include "fitter/fitted_material.h"
#include "fitter/import.h"
#include "fitter/lobe_fit.h"
#include "fitter/named_constants.h"

namespace drude {

namespace {

struct FitCommandOptions {
    std::string measurement, format = "auto";
    std::string estimator = "psi-delta", model = "bulk", lobe;
    std::vector<std::string> overlayers;
    std::string substrate, film_material = "Al2O3-Malitson-o", porosity = "fit";
    double largest_thickness_nm = 10000;
    bool angle_offset = false, unweighted = false;
    std::string range;
    std::string lobe_scan, constants;
    PaperCommandOptions paper;
    std::string name, output;
};

void set_film(const FitCommandOptions& options, FilmModel* film) {
    film->material = find_constants(options.film_material, "--film-material");
    if (!options.substrate.empty()) {
        film->substrate = find_constants(options.substrate, "--substrate");
    }
    film->largest_thickness_nm = options.largest_thickness_nm;
    if (options.porosity == "fit") return;
    const auto porosity = parse_double(options.porosity);
    if (!porosity) {
        user_error("--porosity: found '{}', expected a volume fraction from 0 to 0.95, or fit",
                   options.porosity);
    }
    film->porosity = *porosity;
}

void set_range(const std::string& text, FitOptions* options) {
    if (text.empty()) return;
    const size_t colon = text.find(':');
    const std::string_view view = text;
    const auto first = parse_double(view.substr(0, colon));
    const auto last =
        colon == std::string::npos ? std::nullopt : parse_double(view.substr(colon + 1));
    if (!first || !last || !(*first >= 0) || !(*last > *first)) {
        user_error(
            "--range: found '{}', expected the first and the last wavelength in nm, as in "
            "380:750",
            text);
    }
    options->first_nm = *first;
    options->last_nm = *last;
}

FitOptions make_fit_options(const FitCommandOptions& options, const CommonOptions& common) {
    FitOptions fit;
    fit.estimator = options.estimator;
    fit.model = options.model;
    fit.lobe = options.lobe;
    fit.fit_angle_offset = options.angle_offset;
    fit.unweighted = options.unweighted;
    fit.threads = common.threads;
    for (const std::string& layer : options.overlayers) {
        fit.overlayers.push_back(find_layer(layer, "--overlayer"));
    }
    set_film(options, &fit.film);
    set_range(options.range, &fit);
    return fit;
}

// Of the bytes on disk, as sha256sum gives it; `text` is those bytes unless they were gzip.
std::string file_sha256(const std::string& path, const std::string& text) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return sha256(text);
    std::ifstream file(path, std::ios::binary);
    return sha256(std::string(std::istreambuf_iterator<char>(file), {}));
}

// The command line as a shell would take it again.
std::string joined(const std::vector<std::string>& words) {
    constexpr std::string_view special = " \t\n'\"\\$`;|&<>()*?#~!{}[]";
    std::string line;
    for (const std::string& word : words) {
        if (!line.empty()) line += ' ';
        if (!word.empty() && word.find_first_of(special) == std::string::npos) {
            line += word;
            continue;
        }
        line += '\'';
        for (const char c : word) {
            if (c == '\'') {
                line += "'\\''";
            } else {
                line += c;
            }
        }
        line += '\'';
    }
    return line;
}

Provenance provenance_of(const std::string& file, const std::string& text,
                         const CommonOptions& common) {
    Provenance provenance;
    provenance.measurement = file;
    provenance.measurement_sha256 = file_sha256(file, text);
    provenance.command = joined(common.command_line);
    provenance.version = DRUDE_VERSION;
    return provenance;
}

void check_combination(const FitCommandOptions& options, const OptionSet& given) {
    if (options.measurement.empty() == options.constants.empty()) {
        user_error("{}",
                   options.measurement.empty()
                       ? "expected a measurement of Psi and Delta, or --lobe-scan with --constants"
                       : "found a measurement and --constants, expected one of them: n and k come "
                         "from either");
    }
    if (!options.constants.empty() && options.lobe_scan.empty()) {
        user_error("found --constants without --lobe-scan: there is nothing to fit");
    }
    if (options.model == "film" || options.model == "auto") return;
    for (const char* option : {"--film-material", "--porosity", "--max-thickness"}) {
        if (given.given(option)) user_error("found {}, which belongs to --model film", option);
    }
}

void warn(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) fmt::print(stderr, "warning: {}\n", warning);
}

// n and k are known; the lobe is what is asked for.
int run_lobe_fit(const FitCommandOptions& options, const CommonOptions& common) {
    const std::string text = read_file(options.lobe_scan);
    // "1.04,2.59" as well, where other options take it.
    const bool numbers = options.constants.find(',') != std::string::npos;
    Material material = numbers
                            ? material_from_set(find_constants(options.constants, "--constants"))
                            : find_material(options.constants);
    const LobeFitResult lobes = fit_lobes(parse_lobe_scan(text, options.lobe_scan), material);
    if (!options.name.empty()) material.name = options.name;
    material.provenance = provenance_of(options.lobe_scan, text, common);
    warn(lobes.warnings);
    if (common.json) {
        print_lobe_json(lobes, material, options.output);
    } else {
        print_lobe_text(lobes);
    }
    if (options.output.empty()) return 0;
    set_fitted_lobe(lobes, options.lobe, &material);
    write_material(options.output, material);
    if (!common.json) fmt::print("written to {}\n", options.output);
    return 0;
}

int run_fit(const FitCommandOptions& options, const OptionSet& given, const CommonOptions& common) {
    check_paper_options(options.paper, given);
    if (options.paper.wanted) {
        return run_like_the_paper(options.paper, options.measurement, options.format, common);
    }
    check_combination(options, given);
    if (options.measurement.empty()) return run_lobe_fit(options, common);
    const std::string text = read_file(options.measurement);
    const Measurement measurement = parse_measurement_as(text, options.measurement, options.format);
    FitOptions fit_options = make_fit_options(options, common);
    // With a lobe scan the question has an answer.
    if (!options.lobe_scan.empty()) fit_options.lobe.clear();
    const FitResult fit = fit_measurement(measurement, fit_options);
    Material material = fitted_material(fit, measurement, options.name,
                                        provenance_of(options.measurement, text, common));
    warn(fit.warnings);
    std::optional<LobeFitResult> lobes;
    if (!options.lobe_scan.empty()) {
        lobes = fit_lobes(read_lobe_scan(options.lobe_scan), material);
        warn(lobes->warnings);
    }
    if (common.json) {
        print_fit_json(fit, measurement, material, options.output, lobes ? &*lobes : nullptr);
    } else {
        print_fit_text(fit, material, options.output.empty(), options.unweighted);
        if (lobes) print_lobe_text(*lobes);
    }
    if (options.output.empty()) return 0;
    if (lobes) set_fitted_lobe(*lobes, options.lobe, &material);
    write_material(options.output, material);
    if (!common.json) fmt::print("written to {}\n", options.output);
    return 0;
}

}  // namespace

Command fit_command() {
    Command command;
    command.name = "fit";
    command.summary = "Fit optical constants to a measurement";
    command.description =
        "Fits n and k with their standard deviations to Psi and Delta, wavelength by wavelength, "
        "all angles of incidence together, and writes a material that the renderer reads. No "
        "start values are needed: a closed form gives them.\n\n"
        "Estimators: psi-delta uses both angles, weighted by their standard deviations; rho2 uses "
        "tan^2 Psi alone, as Berger, Weidlich, Wilkie and Magnor did in 2012, and needs two angles "
        "or more; inversion solves each angle by itself and averages.\n\n"
        "The model bulk is a bare surface: an oxide or roughness is absorbed into n and k, which "
        "are therefore pseudo-values. The model overlayer fits n and k below layers of a material "
        "and thickness that you know (--overlayer, the first is the outermost). The model film "
        "fits the thickness of a film and its porosity, as a Bruggeman mixture of --film-material "
        "with void, on the known --substrate, all wavelengths together; the fringes of cos 2Psi "
        "give its starts, and the next best thickness is reported.\n\n"
        "The model auto climbs a ladder: bulk, overlayer where one is given, film where a "
        "substrate is, an angle offset from three angles on. A rung is taken only where the "
        "Bayesian information criterion falls by more than 10 and the reduced chi-square moves "
        "towards 1; the ladder is printed.\n\n"
        "A material is a set (drude materials), a material file, n,k, or a Cauchy formula "
        "cauchy:A,B,C in micrometres. --angle-offset takes a common error of the angles of "
        "incidence as one more parameter and needs three angles.\n\n"
        "Wavelengths at which the data determine nothing (the standard deviations exceed n + ik "
        "a hundred times, or the data are Psi = 45 and Delta = 180 degrees within their noise) are "
        "left out and named; a measurement that determines nothing at all is refused (exit status "
        "1).\n\n"
        "The roughness of a lobe cannot be had from Psi and Delta and is refused with the reason. "
        "--lobe-scan takes reflectance against the detector's offset and fits beta of all four "
        "lobes, with V-groove masking, averaged over the detector's cone, with a free scale for "
        "every wavelength; n and k are those of the measurement, or of --constants. Lobes within "
        "18 "
        "of the best chi-square are a tie and are reported together; a lobe narrower than the cone "
        "gives an upper bound. A material is written for one lobe: --lobe names it where some "
        "tie.\n\n"
        "--like-the-paper repeats Table 1 of Berger, Weidlich, Wilkie and Magnor (2012) with the "
        "measurement: tan^2 Psi at one wavelength, from literature values, the ratio of the "
        "Fresnel terms alone and under each of the four lobes with beta as a third unknown; beside "
        "it what psi-delta finds, the paper's own values of that metal, and a note of what of it "
        "is information. Without a measurement the printed table itself is put to the test.";
    command.example =
        "$ drude fit cu.csv -o cu.json\n"
        "Cu-McPeak: bulk model, estimator psi-delta: pseudo n and k of a bare surface at 81 of 81 "
        "wavelengths, 380 to 780 nm\n"
        "reduced chi-square 0.9424 with 810 degrees of freedom (1 +- 0.05 expected)\n"
        "written to cu.json\n";
    command.declare = [](OptionSet& options, const CommonOptions& common) {
        const auto values = std::make_shared<FitCommandOptions>();
        options.positional("MEASUREMENT", values->measurement, "CSV or a vendor's export", false);
        options.choice("--estimator", values->estimator, estimator_names(), "what is minimised");
        options.choice("--model", values->model, fit_model_names(), "the sample's structure");
        options.option("--overlayer", values->overlayers,
                       "MATERIAL,NM: a known layer on what is fitted; repeats");
        options.option("--substrate", values->substrate, "MATERIAL below a fitted film");
        options.option("--film-material", values->film_material, "MATERIAL of a fitted film");
        options.option("--porosity", values->porosity, "of a fitted film, 0 to 0.95; or fit");
        options.option("--max-thickness", values->largest_thickness_nm,
                       "of a fitted film, in nm: where the search ends");
        options.flag("--angle-offset", values->angle_offset,
                     "fit a common error of the angles of incidence");
        options.option("--range", values->range, "A:B: only wavelengths from A to B nm");
        options.flag("--unweighted", values->unweighted,
                     "every row counts alike; sigmas from the residuals");
        options.option("--lobe-scan", values->lobe_scan,
                       "a lobe scan (CSV): fit the roughness beta of every lobe");
        options.option("--constants", values->constants,
                       "MATERIAL of a lobe scan, where no measurement gives n and k");
        options.option("--lobe", values->lobe, "of a lobe scan: the one to write where some tie");
        declare_paper_options(options, values->paper);
        options.choice("--format", values->format, measurement_formats(),
                       "of the measurement; auto goes by content");
        options.option("--name", values->name, "of the material");
        options.option("-o,--output", values->output, "the material file (JSON)");
        return [values, &options, &common] { return run_fit(*values, options, common); };
    };
    return command;
}

}  // namespace drude
