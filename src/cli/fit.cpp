// `drude fit`: optical constants from a measurement.
#include "fitter/fit.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include "base/error.h"
#include "base/files.h"
#include "base/numbers.h"
#include "base/sha256.h"
#include "cli/command_list.h"
#include "cli/json_output.h"
#include "fitter/fitted_material.h"
#include "fitter/import.h"

namespace drude {

namespace {

using nlohmann::ordered_json;

struct FitCommandOptions {
    std::string measurement, format = "auto";
    std::string estimator = "psi-delta", model = "bulk", lobe;
    std::string name, output;
};

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

template <class Value>
ordered_json column(const FitResult& fit, Value FittedPoint::*member) {
    ordered_json values = ordered_json::array();
    for (const FittedPoint& point : fit.points) values.push_back(point.*member);
    return values;
}

ordered_json parameter(const FitResult& fit, const char* name) {
    size_t identified = 0;
    for (const FittedPoint& point : fit.points) identified += point.identifiable ? 1 : 0;
    return {{"name", name},
            {"per_wavelength", true},
            {"identifiable", identified == fit.points.size()},
            {"wavelengths", identified}};
}

void print_json(const FitResult& fit, const Measurement& measurement, const Material& material,
                const std::string& output) {
    ordered_json document = {
        {"model", fit.model},
        {"estimator", fit.estimator},
        {"name", material.name},
        {"measurement", material.provenance.measurement},
        {"measurement_sha256", material.provenance.measurement_sha256},
        {"angles_deg", measurement.angles()},
        {"wavelengths_nm", column(fit, &FittedPoint::wavelength_nm)},
        {"n", column(fit, &FittedPoint::n)},
        {"k", column(fit, &FittedPoint::k)},
        {"sigma_n", column(fit, &FittedPoint::sigma_n)},
        {"sigma_k", column(fit, &FittedPoint::sigma_k)},
        {"correlation", column(fit, &FittedPoint::correlation)},
        {"identifiable", column(fit, &FittedPoint::identifiable)},
        {"chi2", column(fit, &FittedPoint::chi2)},
        {"data", column(fit, &FittedPoint::data)},
        {"condition", column(fit, &FittedPoint::condition)},
        {"spread_n", column(fit, &FittedPoint::spread_n)},
        {"spread_k", column(fit, &FittedPoint::spread_k)},
        {"chi2_total", fit.chi2},
        {"dof", fit.dof()},
        {"chi2_reduced", fit.chi2_reduced()},
        {"parameters", ordered_json::array({parameter(fit, "n"), parameter(fit, "k")})},
        {"pseudo", true},
        {"warnings", fit.warnings}};
    document["output"] = output.empty() ? ordered_json(nullptr) : ordered_json(output);
    print_json_document(document);
}

void print_table(const FitResult& fit) {
    fmt::print("{:>10}  {:>10} {:>9}  {:>10} {:>9}  {:>8}  {:>9}\n", "nm", "n", "+-", "k", "+-",
               "chi2/dof", "condition");
    for (const FittedPoint& point : fit.points) {
        if (!point.identifiable) {
            fmt::print("{:>10}  not determined\n", format_double(point.wavelength_nm));
            continue;
        }
        const int dof = point.data - 2;
        fmt::print("{:>10}  {:>10.5f} {:>9.5f}  {:>10.5f} {:>9.5f}  {:>8}  {:>9.3g}\n",
                   format_double(point.wavelength_nm), point.n, point.sigma_n, point.k,
                   point.sigma_k, dof > 0 ? fmt::format("{:.3f}", point.chi2 / dof) : "-",
                   point.condition);
    }
}

void print_text(const FitResult& fit, const Material& material, const std::string& output) {
    if (output.empty()) print_table(fit);
    fmt::print(
        "{}: {} model, estimator {}: pseudo n and k of a bare surface at {} of {} "
        "wavelengths, {:g} to {:g} nm\n",
        material.name, fit.model, fit.estimator, material.substrate.n.size(), fit.points.size(),
        fit.points.front().wavelength_nm, fit.points.back().wavelength_nm);
    if (fit.dof() > 0) {
        fmt::print("reduced chi-square {:.4f} with {} degrees of freedom (1 +- {:.2g} expected)\n",
                   fit.chi2_reduced(), fit.dof(), std::sqrt(2.0 / fit.dof()));
    }
    if (!output.empty()) fmt::print("written to {}\n", output);
}

int run_fit(const FitCommandOptions& options, const CommonOptions& common) {
    const std::string text = read_file(options.measurement);
    const Measurement measurement = parse_measurement_as(text, options.measurement, options.format);
    FitOptions fit_options;
    fit_options.estimator = options.estimator;
    fit_options.model = options.model;
    fit_options.lobe = options.lobe;
    fit_options.threads = common.threads;
    const FitResult fit = fit_measurement(measurement, fit_options);
    Provenance provenance;
    provenance.measurement = options.measurement;
    provenance.measurement_sha256 = file_sha256(options.measurement, text);
    provenance.command = joined(common.command_line);
    provenance.version = DRUDE_VERSION;
    const Material material = fitted_material(fit, measurement, options.name, provenance);
    for (const std::string& warning : fit.warnings) fmt::print(stderr, "warning: {}\n", warning);
    if (!options.output.empty()) write_material(options.output, material);
    if (common.json) {
        print_json(fit, measurement, material, options.output);
    } else {
        print_text(fit, material, options.output);
    }
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
        "are therefore pseudo-values. Wavelengths at which the data determine nothing are left "
        "out and named; a measurement that determines nothing at all is refused (exit status 1). "
        "The roughness of a lobe cannot be had from Psi and Delta and is refused with the reason.";
    command.example =
        "$ drude fit cu.csv -o cu.json\n"
        "Cu-McPeak: bulk model, estimator psi-delta: pseudo n and k of a bare surface at 81 of 81 "
        "wavelengths, 380 to 780 nm\n"
        "reduced chi-square 0.9424 with 810 degrees of freedom (1 +- 0.05 expected)\n"
        "written to cu.json\n";
    command.declare = [](OptionSet& options, const CommonOptions& common) {
        const auto values = std::make_shared<FitCommandOptions>();
        options.positional("MEASUREMENT", values->measurement, "CSV or a vendor's export", true);
        options.choice("--estimator", values->estimator, estimator_names(), "what is minimised");
        options.option("--model", values->model, "the sample's structure: bulk");
        options.option("--lobe", values->lobe, "ask for the roughness of a lobe");
        options.choice("--format", values->format, measurement_formats(),
                       "of the measurement; auto goes by content");
        options.option("--name", values->name, "of the material");
        options.option("-o,--output", values->output, "the material file (JSON)");
        return [values, &common] { return run_fit(*values, common); };
    };
    return command;
}

}  // namespace drude
