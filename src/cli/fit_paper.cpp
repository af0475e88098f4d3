#include "cli/fit_paper.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "base/files.h"
#include "base/numbers.h"
#include "cli/json_output.h"
#include "cli/warnings.h"
#include "fitter/import.h"
#include "fitter/like_the_paper.h"
#include "fitter/named_constants.h"

namespace drude {

namespace {

using nlohmann::ordered_json;

constexpr double required_error = 1e-6;
constexpr const char* reason =
    "at the mirror direction the facet distribution D and the masking G multiply the parallel and "
    "the perpendicular reflectance alike and cancel in their ratio: the Jacobian's column of beta "
    "is zero but for rounding, and a fit ends at the beta that it started from";

std::string beta_trips(const PaperFitBlock& block) {
    std::string text;
    for (size_t i = 0; i < block.beta_end.size(); ++i) {
        text += fmt::format("{}{:g} -> {:.4g}", i > 0 ? ", " : "", block.beta_start[i],
                            block.beta_end[i]);
    }
    return text;
}

std::string printed_values(const PaperValues& values) {
    return fmt::format("{:>8.3f}{:>8.3f}{:>8}", values.n, values.k,
                       std::isnan(values.beta) ? "" : fmt::format("{:.3f}", values.beta));
}

std::string trimmed(std::string line) {
    line.erase(line.find_last_not_of(' ') + 1);
    return line;
}

void print_fit(const PaperFit& fit, const std::string& name) {
    fmt::print("{} at {} nm, {} angles of incidence, started from {} ({:.4f} + {:.4f}i{})\n", name,
               format_double(fit.wavelength_nm), fit.angles_deg.size(), fit.literature, fit.start_n,
               fit.start_k, fit.nearest_literature ? "; the nearest set, no metal is named" : "");
    fmt::print("{:<18}{:>10}{:>10}   {}\n", "", "n", "k",
               fit.printed ? fmt::format("{:<32}printed: {} at {} nm", "beta: start -> end",
                                         fit.printed->name, fit.printed->wavelength_nm)
                           : "beta: start -> end");
    for (size_t i = 0; i < fit.blocks.size(); ++i) {
        const PaperFitBlock& block = fit.blocks[i];
        fmt::print("{}\n",
                   trimmed(fmt::format("{:<18}{:>10.5f}{:>10.5f}   {:<30}{}", block.name, block.n,
                                       block.k, beta_trips(block),
                                       fit.printed ? printed_values(fit.printed->blocks[i]) : "")));
    }
}

void print_ours(const PaperFit& fit) {
    const FittedPoint& ours = fit.psi_delta;
    if (!ours.identifiable) {
        fmt::print("Psi and Delta do not determine n and k here: {}\n", ours.reason);
        return;
    }
    fmt::print("{:<18}{:>10}{:>10}{:>10}{:>10}   beta\n", "ours", "n", "+-", "k", "+-");
    fmt::print("{:<18}{:>10.5f}{:>10.5f}{:>10.5f}{:>10.5f}\n", "psi-delta", ours.n, ours.sigma_n,
               ours.k, ours.sigma_k);
    fmt::print("{:<18}{:>10.5f}{:>10.5f}{:>10.5f}{:>10.5f}\n", "tan^2 Psi alone", fit.blocks[0].n,
               fit.sigma_n, fit.blocks[0].k, fit.sigma_k);
}

void print_note(const PaperFit& fit) {
    const PaperFitBlock& block = fit.blocks[1];
    fmt::print(
        "What of the table is information:\n"
        "  n, k   one pair; the lobes repeat it.\n"
        "  beta   nothing: {}.\n"
        "         Lengths of d|rho|^2/d(n, k, beta): {:.3g}, {:.3g}, {:.2g}.\n"
        "         A scan of the lobe holds beta (--lobe-scan).\n",
        reason, block.column_n, block.column_k, block.column_beta);
}

ordered_json to_json(const PaperValues& values) {
    return {{"n", values.n}, {"k", values.k}, {"beta", values.beta}};
}

ordered_json to_json(const PaperFit& fit) {
    ordered_json blocks = ordered_json::array();
    for (size_t i = 0; i < fit.blocks.size(); ++i) {
        const PaperFitBlock& block = fit.blocks[i];
        ordered_json one = {{"name", block.name},
                            {"n", block.n},
                            {"k", block.k},
                            {"rms", block.rms},
                            {"converged", block.converged},
                            {"beta_start", block.beta_start},
                            {"beta_end", block.beta_end},
                            {"jacobian_column_n", block.column_n},
                            {"jacobian_column_k", block.column_k},
                            {"jacobian_column_beta", block.column_beta}};
        if (fit.printed) one["printed"] = to_json(fit.printed->blocks[i]);
        blocks.push_back(std::move(one));
    }
    return {{"wavelength_nm", fit.wavelength_nm},
            {"angles_deg", fit.angles_deg},
            {"literature", fit.literature},
            {"start", {{"n", fit.start_n}, {"k", fit.start_k}}},
            {"printed_metal", fit.printed ? ordered_json(fit.printed->name) : nullptr},
            {"blocks", blocks},
            {"sigma_n", fit.sigma_n},
            {"sigma_k", fit.sigma_k},
            {"psi_delta",
             {{"n", fit.psi_delta.n},
              {"k", fit.psi_delta.k},
              {"sigma_n", fit.psi_delta.sigma_n},
              {"sigma_k", fit.psi_delta.sigma_k},
              {"identifiable", fit.psi_delta.identifiable},
              {"beta", nullptr}}},
            {"beta_identifiable", false},
            {"beta_reason", reason},
            {"warnings", fit.warnings}};
}

ordered_json to_json(const PaperCheck& check) {
    ordered_json one = {{"metal", check.metal->name},
                        {"largest_error", check.largest_error},
                        {"returns", check.largest_error <= required_error},
                        {"largest_psi_difference_deg", check.largest_psi_difference_deg},
                        {"chi2_per_datum", check.largest_chi2},
                        {"largest_at", check.largest_at},
                        {"beta_repeated", check.beta_repeated}};
    one["fit"] = to_json(check.fit);
    return one;
}

// "a, b and c".
std::string list_of(const std::vector<std::string>& words) {
    std::string text;
    for (size_t i = 0; i < words.size(); ++i) {
        text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
    }
    return text;
}

void print_contradictions(const std::vector<PaperCheck>& checks) {
    std::vector<std::string> repeated;
    size_t betas = 0;
    for (const PaperCheck& check : checks) {
        betas += check.metal->blocks.size() - 1;
        if (check.beta_repeated) repeated.push_back(check.metal->name);
        if (check.largest_chi2 < 1) continue;
        fmt::print(
            "  n, k   {}: the {} pair is {:.2f} degrees (rms) of Psi from the first, chi-square "
            "{:.0f} a datum at 0.05 degrees; the same data cannot have given both.\n",
            check.metal->name, check.largest_at, check.largest_psi_difference_deg,
            check.largest_chi2);
    }
    fmt::print("  beta   none of the {} printed values carries information: {}.\n", betas, reason);
    fmt::print(
        "         {} have one value for Blinn-Phong (a half-height angle) and Beckmann (a "
        "slope).\n",
        list_of(repeated));
}

int print_check(const CommonOptions& common) {
    const std::vector<PaperCheck> checks = check_paper_table();
    bool all = true;
    ordered_json metals = ordered_json::array();
    for (const PaperCheck& check : checks) {
        all = all && check.largest_error <= required_error;
        metals.push_back(to_json(check));
    }
    if (common.json) {
        print_json_document({{"model", "like-the-paper"},
                             {"required_error", required_error},
                             {"all_return", all},
                             {"metals", metals}});
        return all ? 0 : 1;
    }
    fmt::print(
        "Table 1 of Berger, Weidlich, Wilkie & Magnor 2012, fitted again from |rho|^2 made with "
        "the n and k printed for the Fresnel terms\n\n");
    for (const PaperCheck& check : checks) {
        print_fit(check.fit, check.metal->name);
        fmt::print("largest error of n and k {:.1e}, {} {:g}\n\n", check.largest_error,
                   check.largest_error <= required_error ? "within" : "beyond", required_error);
    }
    fmt::print("What of the table is information:\n");
    print_contradictions(checks);
    return all ? 0 : 1;
}

}  // namespace

void declare_paper_options(OptionSet& options, PaperCommandOptions& values) {
    options.flag("--like-the-paper", values.wanted,
                 "the procedure and the table of Berger et al. 2012");
    options.option("--wavelength", values.wavelength_nm,
                   "of --like-the-paper, in nm; the paper's where not given");
    options.option("--paper-start", values.literature,
                   "MATERIAL where --like-the-paper starts; by the sample's name where not given");
}

void check_paper_options(const PaperCommandOptions& options, const OptionSet& given) {
    if (!options.wanted) {
        refuse_options(given, {"--wavelength", "--paper-start"}, "belongs to --like-the-paper");
        return;
    }
    // The procedure has nothing to choose but where it starts.
    refuse_options(given, {"--estimator",     "--model",      "--overlayer",     "--angle-offset",
                           "--range",         "--unweighted", "--lobe-scan",     "--constants",
                           "--lobe",          "--substrate",  "--film-material", "--porosity",
                           "--max-thickness", "--dispersion", "--spread",        "--bandwidth",
                           "--roughness",     "--robust",     "--literature",    "--profile",
                           "--profile-at",    "--bootstrap",  "--seed",          "--plots",
                           "--html",          "--name",       "--output"},
                   "--like-the-paper has no use for: it fits tan^2 Psi of a bare surface at one "
                   "wavelength and writes no material");
    if (given.given("--wavelength") && !(options.wavelength_nm > 0)) {
        user_error("--wavelength: found {}, expected a wavelength in nm above 0",
                   options.wavelength_nm);
    }
}

int run_like_the_paper(const PaperCommandOptions& options, const std::string& file,
                       const std::string& format, const CommonOptions& common) {
    if (file.empty()) return print_check(common);
    const Measurement measurement = parse_measurement_as(read_file(file), file, format);
    LikeThePaperOptions paper;
    paper.wavelength_nm = options.wavelength_nm;
    if (!options.literature.empty()) {
        paper.literature = find_constants(options.literature, "--paper-start");
    }
    const PaperFit fit = fit_like_the_paper(measurement, paper);
    print_warnings(fit.warnings);
    if (common.json) {
        ordered_json document = {{"model", "like-the-paper"}, {"measurement", file}};
        document.update(to_json(fit));
        print_json_document(document);
        return 0;
    }
    print_fit(fit, file);
    fmt::print("\n");
    print_ours(fit);
    fmt::print("\n");
    print_note(fit);
    return 0;
}

}  // namespace drude
