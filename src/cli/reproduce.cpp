// drude reproduce: the whole study, from captures on the virtual bench to the report.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "cli/command_list.h"
#include "cli/json_output.h"
#include "cli/report_output.h"
#include "fitter/common_error.h"
#include "materials/lobe.h"
#include "report/study.h"
#include "report/study_lobe.h"

namespace drude {

namespace {

// The page says these in its own words.
std::vector<std::string> notes_of(const Study& study) {
    std::vector<std::string> notes = {
        "No hardware was measured: each sample is virtual, made of one published set of optical "
        "constants and a roughness, and was captured on a simulated bench.",
        "Zn-Werner-DFT is a calculation (density functional theory), not a measurement."};
    notes.insert(notes.end(), study.info.notes.begin(), study.info.notes.end());
    return notes;
}

nlohmann::ordered_json difference_json(const Log10Difference& d) {
    return {{"mean", d.mean}, {"p50", d.p50}, {"p99", d.p99}, {"max", d.max}};
}

// What the lobe scan found beside what the sample was made with; null without a scan.
nlohmann::ordered_json lobe_json(const StudyMetal& metal) {
    if (!metal.lobe) return nullptr;
    const StudyLobe& lobe = *metal.lobe;
    const FittedLobe& best = lobe.fit.lobes.front();
    nlohmann::ordered_json tied = nlohmann::ordered_json::array();
    for (const FittedLobe& one : lobe.fit.lobes) {
        if (one.tied) tied.push_back(lobe_name(one.lobe));
    }
    nlohmann::ordered_json json = {{"lobe", lobe_name(best.lobe)},
                                   {"beta", best.beta},
                                   {"sigma_beta", lobe.sigma.front()},
                                   {"tied", tied},
                                   {"chi2_reduced", best.chi2 / std::max(1, lobe.fit.dof())},
                                   {"true_lobe", lobe_name(lobe.true_lobe)},
                                   {"true_beta", lobe.true_beta},
                                   {"beta_of_true_lobe", own_lobe(lobe).beta},
                                   {"sigma_of_true_lobe", own_sigma(lobe)},
                                   {"verdict", lobe_verdict_text(lobe_verdict(lobe))}};
    if (lobe.pair) {
        json["mean_absolute_difference"] = lobe.pair->mean_absolute;
        json["mean_delta_e"] = lobe.pair->mean_delta_e;
        json["log10_difference"] = difference_json(lobe.pair->log10);
    }
    return json;
}

nlohmann::ordered_json capture_json(const StudyMetal& metal) {
    const StudyCapture& capture = metal.capture;
    nlohmann::ordered_json common = nlohmann::ordered_json::array();
    for (const CommonError& error : capture.common) {
        common.push_back({{"angle_deg", error.angle_deg},
                          {"sigma_psi_deg", error.sigma_psi_deg},
                          {"sigma_delta_deg", error.sigma_delta_deg}});
    }
    return {{"rows", metal.measurement.rows.size()},
            {"integration_s", capture.integration_s},
            {"frames", capture.frames},
            {"bench_seconds", capture.bench_seconds},
            {"retries", capture.retries},
            {"common_errors", common}};
}

nlohmann::ordered_json to_json(const StudyOptions& options, const ReportResult& report) {
    const StudyInfo& info = report.study.info;
    nlohmann::ordered_json json = report_json(options.folder, report);
    json["environment"] = info.environment;
    if (!info.environment_credit.empty()) json["credit"] = info.environment_credit;
    json["lobe"] = options.lobe;
    json["masking"] = options.masking;
    json["beta"] = options.beta;
    json["seed"] = options.seed;
    json["seconds"] = info.seconds;
    json["render_seconds"] = info.render_seconds;
    json["notes"] = notes_of(report.study);
    json["materials"] = nlohmann::ordered_json::array();
    for (const StudyMetal& metal : report.study.metals) {
        const PairStatistics& pair = *metal.pair;
        json["materials"].push_back(
            {{"name", metal.name},
             {"sample_set", metal.sample_set},
             {"literature_set", metal.literature_set},
             {"capture", capture_json(metal)},
             {"chi2_reduced", metal.reduced_chi2},
             {"chi2_slack", chi2_slack(metal.measurement, metal.capture.common, metal.dof)},
             {"chi2_noise_alone", metal.noise_chi2},
             {"chi2_by_common_error",
              chi2_by_common_error(metal.measurement, metal.capture.common)},
             {"dof", metal.dof},
             {"rms_dn", metal.rms_dn},
             {"rms_dk", metal.rms_dk},
             {"mean_absolute_difference", pair.mean_absolute},
             {"mean_delta_e", pair.mean_delta_e},
             {"log10_difference", difference_json(pair.log10)},
             {"rough", lobe_json(metal)}});
    }
    return json;
}

// Why a chi-square with the noise alone would not be 1, with numbers.
void print_common_errors(const Study& study) {
    for (const StudyMetal& metal : study.metals) {
        double psi = 0, delta = 0;
        for (const CommonError& error : metal.capture.common) {
            psi = std::max(psi, error.sigma_psi_deg);
            delta = std::max(delta, error.sigma_delta_deg);
        }
        fmt::print(
            "{}: chi2/dof 1 +- {:.2f} expected, with the common error of mounts and calibration "
            "(up to {:.2g} degrees in Psi, {:.2g} in Delta); with the noise alone {:.3g}, {:.3g} "
            "expected\n",
            metal.name, chi2_slack(metal.measurement, metal.capture.common, metal.dof), psi, delta,
            metal.noise_chi2, chi2_by_common_error(metal.measurement, metal.capture.common));
    }
}

void print_lobes(const Study& study) {
    for (const StudyMetal& metal : study.metals) {
        if (!metal.lobe) continue;
        const StudyLobe& lobe = *metal.lobe;
        const FittedLobe& best = lobe.fit.lobes.front();
        const std::string ties = tied_with(lobe);
        fmt::print("{}: lobe scan {} beta {:.5f} +- {:.1g}{}; made with {} {:g}: {}\n", metal.name,
                   lobe_name(best.lobe), best.beta, lobe.sigma.front(),
                   ties.empty() ? "" : " (not told from " + ties + ")", lobe_name(lobe.true_lobe),
                   lobe.true_beta, lobe_verdict_text(lobe_verdict(lobe)));
    }
}

void print(const StudyOptions& options, const ReportResult& report) {
    fmt::print("{:<14}{:<16}{:<18}{:>10}{:>9}{:>9}{:>14}{:>8}\n", "metal", "virtual sample",
               "literature", "chi2/dof", "rms dn", "rms dk", "log10 |diff|", "dE");
    for (const StudyMetal& metal : report.study.metals) {
        fmt::print("{:<14}{:<16}{:<18}{:>10.3f}{:>9.4f}{:>9.4f}{:>14.3f}{:>8.2f}\n", metal.name,
                   metal.sample_set, metal.literature_set, metal.reduced_chi2, metal.rms_dn,
                   metal.rms_dk, metal.pair->log10.mean, metal.pair->mean_delta_e);
    }
    print_common_errors(report.study);
    print_lobes(report.study);
    if (const auto& film = report.study.film) {
        fmt::print("{}: chi2/dof {:.3f} with its film", film->name, film->film_chi2);
        for (const StudyParameter& p : film->parameters) {
            fmt::print(", {} {:.6g}{}{}", p.name, p.value, p.unit.empty() ? "" : " ", p.unit);
        }
        fmt::print("; {:.4g} as a bare metal\n", film->bare_chi2);
    }
    for (const std::string& note : notes_of(report.study)) fmt::print("note: {}\n", note);
    print_claims(report.claims);
    fmt::print("{}/index.html and {}/comparison.png in {:.1f} s\n", options.folder, options.folder,
               report.study.info.seconds);
}

}  // namespace

Command reproduce_command() {
    Command command;
    command.name = "reproduce";
    command.summary = "Run the whole study: five metals captured, fitted, rendered, compared";
    command.description =
        "Copper, silver, gold, aluminium and a zinc coating, each as a virtual sample made of one "
        "published set of optical constants with a lobe and a beta: Psi and Delta and a lobe scan "
        "are captured on the virtual bench, with its ordinary faults and its calibration, as "
        "`drude capture` would; n and k, lobe and beta are fitted; and a half-sphere is rendered "
        "with the fitted constants and with another published set, nearly polished as in the "
        "paper and with the fitted lobe. And anodised aluminium, captured and fitted as a bare "
        "metal and with its film. Bench files, recipes and journals of the raw frames stay in the "
        "folder. "
        "Writes EXRs, PNGs, tables, figures 5 to 9 of the paper and one self-contained page "
        "(index.html) to the folder -o; `drude report DIR` makes the page again without "
        "rendering. Unless --spectral puts 10 nm layers of S0 to S3 into every picture, a quarter "
        "as large one beside it (*-spectral.exr) has them, for the page's spectra.\n\n"
        "The environment is a courtyard that the program makes itself; --environment FILE takes a "
        "lat-long picture instead, such as the Uffizi Gallery light probe (courtesy of Paul "
        "Debevec; bring your own copy), which makes the study that of Berger, Weidlich, Wilkie & "
        "Magnor 2012. --beta and --lobe change the roughness of the polished pairs, which their "
        "renderer clamped to a "
        "Blinn-Phong half-height angle of 0.011774 rad.";
    command.example =
        "drude reproduce -o study\n"
        "drude reproduce -o uffizi --environment uffizi_latlong.exr --spp 256";
    command.declare = [](OptionSet& set, const CommonOptions& common) {
        const auto options = std::make_shared<StudyOptions>();
        set.option("-o,--output", options->folder, "the folder to write to");
        set.option("--environment", options->environment, "a picture's file");
        set.choice("--lobe", options->lobe, lobe_names(), "microfacet lobe of the polished pairs");
        set.choice("--masking", options->masking, masking_names(), "of the microfacets");
        set.option("--beta", options->beta, "roughness in rad; 0: a mirror");
        set.option("--spp", options->samples_per_pixel, "samples a pixel");
        set.option("--resolution", options->resolution, "pixels a side");
        set.option("--seed", options->seed, "of the benches and samples");
        set.flag("--spectral", options->spectral, "10 nm layers of S0 to S3 in every EXR");
        return [options, &common] {
            if (options->folder.empty()) {
                user_error("reproduce: no output; name a folder with -o DIR");
            }
            options->threads = common.threads;
            options->quiet = common.quiet;
            options->command_line = fmt::format("{}", fmt::join(common.command_line, " "));
            const StudyResult study = run_study(*options);
            ReportOptions report_options;
            report_options.folder = options->folder;
            report_options.threads = options->threads;
            ReportResult report = write_report(report_options);
            report.files.insert(report.files.begin(), study.files.begin(), study.files.end());
            if (common.json) {
                print_json_document(to_json(*options, report));
            } else {
                print(*options, report);
            }
            return 0;
        };
    };
    return command;
}

}  // namespace drude
