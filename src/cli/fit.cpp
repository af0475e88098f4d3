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
#include "base/interrupt.h"
#include "base/numbers.h"
#include "base/sha256.h"
#include "cli/command_list.h"
#include "cli/fit_output.h"
#include "cli/fit_paper.h"
#include "cli/fit_statistics.h"
#include "cli/warnings.h"
#include "fitter/angle_choice.h"
#include "fitter/common_error.h"
#include "fitter/decisions.h"
#include "fitter/fitted_material.h"
#include "fitter/import.h"
#include "fitter/lobe_fit.h"
#include "fitter/named_constants.h"

namespace drude {

namespace {

struct FitCommandOptions {
    std::string measurement, format = "auto";
    std::string estimator = "psi-delta", model = "bulk", dispersion, lobe;
    std::vector<std::string> overlayers;
    std::string substrate, film_material = "Al2O3-Malitson-o", porosity = "fit";
    double largest_thickness_nm = 10000, bandwidth_nm = 0;
    std::string spread, roughness;
    bool angle_offset = false, unweighted = false, explain = false;
    std::string range, angles;
    std::string lobe_scan, constants;
    PaperCommandOptions paper;
    std::string name, output;
    FitStatisticsOptions statistics;
};

KnownOrFitted known_or_fitted(const std::string& text, const char* option) {
    if (text.empty()) return {};
    if (text == "fit") return {0, true};
    const auto value = parse_double(text);
    if (!value || !(*value >= 0)) {
        user_error("{}: found '{}', expected a length in nm, or fit", option, text);
    }
    return {*value, false};
}

void set_film(const FitCommandOptions& options, FilmModel* film) {
    film->material = find_constants(options.film_material, "--film-material");
    if (!options.substrate.empty()) {
        film->substrate = find_constants(options.substrate, "--substrate");
    }
    film->largest_thickness_nm = options.largest_thickness_nm;
    film->bandwidth_nm = options.bandwidth_nm;
    film->spread_nm = known_or_fitted(options.spread, "--spread");
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
    fit.dispersion = options.dispersion;
    fit.lobe = options.lobe;
    fit.fit_angle_offset = options.angle_offset;
    fit.unweighted = options.unweighted;
    fit.robust = options.statistics.robust;
    fit.threads = common.threads;
    for (const std::string& layer : options.overlayers) {
        fit.overlayers.push_back(find_layer(layer, "--overlayer"));
    }
    set_film(options, &fit.film);
    fit.roughness_nm = known_or_fitted(options.roughness, "--roughness");
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
    const std::vector<const char*> film_only = {"--film-material", "--porosity", "--max-thickness",
                                                "--spread", "--bandwidth"};
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
    check_fit_statistics(options.statistics, given, !options.measurement.empty());
    if (options.measurement.empty()) {
        refuse_options(
            given,
            {"--estimator", "--model", "--dispersion", "--overlayer", "--substrate", "--roughness",
             "--angle-offset", "--range", "--angles", "--unweighted", "--explain", "--format"},
            "belongs to a fit of n and k to a measurement");
        refuse_options(given, film_only, "belongs to a fit of n and k to a measurement");
    }
    if (options.model == "auto" && options.substrate.empty()) {
        refuse_options(given, film_only,
                       "belongs to a film: --model auto tries one where --substrate is given");
        if (options.roughness == "fit") {
            user_error(
                "--roughness fit: a roughness is fitted on a film only, which --model auto "
                "tries where --substrate is given");
        }
    }
    if (options.model == "film" || options.model == "auto") return;
    refuse_options(given, film_only, "belongs to --model film");
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
    print_warnings(lobes.warnings);
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

// What the wavelengths of an angle share belongs to a row's error as much as its own noise.
void weigh_by_common_error(FitReport* report) {
    if (report->options.unweighted) return;
    report->common_errors = common_errors(report->measurement);
    if (report->common_errors.empty()) return;
    report->options.chi2_common_scatter =
        chi2_common_scatter(report->measurement, report->common_errors);
    report->measurement = with_common_error(std::move(report->measurement), report->common_errors);
}

int run_fit(const FitCommandOptions& options, const OptionSet& given, const CommonOptions& common) {
    // Everything is written at the end and at once: there is nothing to save on the way.
    let_interrupts_end();
    check_paper_options(options.paper, given);
    if (options.paper.wanted) {
        return run_like_the_paper(options.paper, options.measurement, options.format, common);
    }
    check_combination(options, given);
    if (options.measurement.empty()) return run_lobe_fit(options, common);
    const std::string text = read_file(options.measurement);
    FitReport report;
    report.measurement = parse_measurement_as(text, options.measurement, options.format);
    report.options = make_fit_options(options, common);
    // With a lobe scan the question has an answer.
    if (!options.lobe_scan.empty()) report.options.lobe.clear();
    if (!options.angles.empty()) {
        report.measurement = at_angles(report.measurement, parse_grid(options.angles, "--angles"));
    }
    weigh_by_common_error(&report);
    report.fit = fit_measurement(report.measurement, report.options);
    std::vector<std::string> imported = import_warnings(report.measurement);
    if (report.measurement.header_value("calibration") == "none") {
        imported.emplace_back(
            "the measurement was captured without a calibration of the bench: what the source's "
            "polarisation and azimuths that are off add to Psi and Delta is in no standard "
            "deviation, here neither ('drude help capture')");
    }
    report.fit.warnings.insert(report.fit.warnings.begin(), imported.begin(), imported.end());
    // What "auto" took is what bootstrap and profiles go on with.
    const FitOptions asked = report.options;
    if (report.options.robust == "auto") {
        report.options.robust = report.fit.robust.empty() ? "none" : report.fit.robust;
    }
    run_fit_statistics(options.statistics, &report);
    if (options.explain) {
        report.decisions = decisions(
            report.measurement, asked, report.fit,
            report.literature ? report.substrates
                              : other_substrates(report.measurement, report.options, report.fit));
    }
    Material material = fitted_material(report.fit, report.measurement, options.name,
                                        provenance_of(options.measurement, text, common));
    report.name = material.name;
    report.provenance = material.provenance;
    print_warnings(report.fit.warnings);
    std::optional<LobeFitResult> lobes;
    if (!options.lobe_scan.empty()) {
        lobes = fit_lobes(read_lobe_scan(options.lobe_scan), material);
        print_warnings(lobes->warnings);
    }
    write_fit_figures(options.statistics, report);
    if (!report.common_errors.empty()) {
        material.provenance.warnings.emplace_back(weighed_by_common_error);
    }
    if (common.json) {
        print_fit_json(report, material, options.output, lobes ? &*lobes : nullptr);
    } else {
        print_fit_text(report, options.output.empty());
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
        "or more; inversion solves each angle by itself and averages. "
        "An error that the wavelengths of an angle share, as drude capture states it in the "
        "header (sigma_common_deg), counts among the standard deviations of every row, and widens "
        "what is expected of the reduced chi-square.\n\n"
        "The model bulk is a bare surface: an oxide or roughness is absorbed into n and k, which "
        "are therefore pseudo-values. The model overlayer fits n and k below layers of a material "
        "and thickness that you know (--overlayer, the first is the outermost). The model film "
        "fits the thickness of a film and its porosity, as a Bruggeman mixture of --film-material "
        "with void, on the known --substrate, all wavelengths together; the fringes of cos 2Psi "
        "give its starts, and the next best thickness is reported.\n\n"
        "A thick film is rarely even, and a spectrometer's slit sees more than one wavelength: "
        "--spread and --bandwidth average the intensities over a Gaussian of thicknesses and over "
        "the slit, without which washed-out fringes are fitted with a wrong porosity. --roughness "
        "puts a layer of half void, half what lies below it on the film, or, of known thickness, "
        "on what is fitted otherwise.\n\n"
        "The model auto climbs a ladder: bulk, overlayer where one is given, film where a "
        "substrate is, an angle offset from three angles on, a spread of the film's thickness. A "
        "rung is taken only where the "
        "Bayesian information criterion falls by more than 10 and the reduced chi-square falls, "
        "or is not above 1; the ladder is printed.\n\n"
        "--dispersion lets n and k follow a formula over all wavelengths, of the models bulk and "
        "overlayer: drude, drude+2cp (free electrons and two critical points), drude+3lorentz, "
        "cauchy, sellmeier or 2sellmeier, bruggeman:A,B (a mixture of two materials), spline:N "
        "(a cubic spline of N intervals as the absorption and its Kramers-Kronig transform). "
        "auto takes compact where it holds, otherwise every wavelength by itself; "
        "compact is the smallest of drude, drude+cp and drude+2cp that the data need, spline "
        "chooses its intervals so; what was tried is printed. A formula that is too small shows "
        "in the reduced chi-square: without one every wavelength stands for itself, which is "
        "never wrong.\n\n"
        "--explain says what was chosen, or would be by auto, with its reason, cost and error: "
        "model, formula, angles (which carry what is known, and how few would do), estimator, "
        "robust loss, substrate, search (docs/decisions.md).\n\n"
        "A material is a set (drude materials), a material file, n,k, or a Cauchy formula "
        "cauchy:A,B,C in micrometres. --angle-offset takes a common error of the angles of "
        "incidence as one more parameter and needs three angles.\n\n"
        "Wavelengths at which the data determine nothing (the standard deviations exceed n + ik "
        "a hundred times, or the data are Psi = 45 and Delta = 180 degrees within their noise) are "
        "left out and named; a measurement that determines nothing at all is refused (exit status "
        "1).\n\n"
        "n and k are compared with the published sets of --literature, of the metal that the "
        "measurement's sample is called, or of the metal that is nearest: root mean square "
        "differences over the wavelengths that each set covers; a film is fitted again on other "
        "published sets of its substrate. --robust lets rows far from the "
        "model count less (huber, cauchy, tukey; constants 1.345, 2.385 and 4.685 standard "
        "deviations); auto takes tukey where rows are further off than noise brings; huber "
        "withstands a few bad rows, tukey grosser ones. --profile finds where "
        "chi-square, smallest over all other parameters, rises by 1 and by 3.84 on either side of "
        "every parameter, or that it never does (open); not with "
        "--dispersion, --robust or the inversion, which the bootstrap takes. --bootstrap draws "
        "measurements from the "
        "fitted model and refits them: scatter and quantiles of every parameter, the same for any "
        "number of threads. --plots writes psi, delta, residuals, n and k as SVG, --html all of it "
        "as one page.\n\n"
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
        "published sets of Cu, which the sample is called, nearest first\n"
        "  Cu-McPeak               rms dn 0.0038  rms dk 0.0036\n"
        "  Cu-Babar                rms dn 0.0703  rms dk 0.0797\n"
        "  ...\n"
        "written to cu.json\n";
    command.declare = [](OptionSet& options, const CommonOptions& common) {
        const auto values = std::make_shared<FitCommandOptions>();
        options.positional("MEASUREMENT", values->measurement, "CSV or a vendor's export", false);
        options.choice("--estimator", values->estimator, estimator_names(), "what is minimised");
        options.choice("--model", values->model, fit_model_names(), "the sample's structure");
        options.option(
            "--dispersion", values->dispersion,
            "FORMULA of n and k over the wavelengths: auto, compact, drude+2cp, cauchy, ...");
        options.option("--overlayer", values->overlayers,
                       "MATERIAL,NM: a known layer on what is fitted; repeats");
        options.option("--substrate", values->substrate, "MATERIAL below a fitted film");
        options.option("--film-material", values->film_material, "MATERIAL of a fitted film");
        options.option("--porosity", values->porosity, "of a fitted film, 0 to 0.95; or fit");
        options.option("--max-thickness", values->largest_thickness_nm,
                       "of a fitted film, in nm: where the search ends");
        options.option("--spread", values->spread,
                       "of a film's thickness over the beam, in nm; or fit");
        options.option("--bandwidth", values->bandwidth_nm,
                       "of the spectrometer, full width at half maximum in nm, for a film");
        options.option("--roughness", values->roughness,
                       "thickness in nm of a layer of half void; fit on a film");
        options.flag("--angle-offset", values->angle_offset,
                     "fit a common error of the angles of incidence");
        options.option("--range", values->range, "A:B: only wavelengths from A to B nm");
        options.option("--angles", values->angles,
                       "LIST in degrees: only rows at these angles of incidence");
        options.flag("--explain", values->explain,
                     "say what was chosen automatically, why, its cost and error, and what "
                     "overrides it");
        options.flag("--unweighted", values->unweighted,
                     "every row counts alike; sigmas from the residuals");
        declare_fit_statistics(options, &values->statistics);
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
