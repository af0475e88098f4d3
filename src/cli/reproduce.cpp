// drude reproduce: the whole study, from simulated measurements to the report.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "cli/command_list.h"
#include "cli/json_output.h"
#include "cli/report_output.h"
#include "materials/lobe.h"
#include "report/study.h"

namespace drude {

namespace {

// The page says these in its own words.
std::vector<std::string> notes_of(const Study& study) {
    std::vector<std::string> notes = {
        "No hardware was measured: each sample is virtual, made of one published set of optical "
        "constants, and its measurement is simulated.",
        "Zn-Werner-DFT is a calculation (density functional theory), not a measurement."};
    notes.insert(notes.end(), study.info.notes.begin(), study.info.notes.end());
    return notes;
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
        const Log10Difference& d = pair.log10;
        json["materials"].push_back(
            {{"name", metal.name},
             {"sample_set", metal.sample_set},
             {"literature_set", metal.literature_set},
             {"chi2_reduced", metal.reduced_chi2},
             {"dof", metal.dof},
             {"rms_dn", metal.rms_dn},
             {"rms_dk", metal.rms_dk},
             {"mean_absolute_difference", pair.mean_absolute},
             {"mean_delta_e", pair.mean_delta_e},
             {"log10_difference",
              {{"mean", d.mean}, {"p50", d.p50}, {"p99", d.p99}, {"max", d.max}}}});
    }
    return json;
}

void print(const StudyOptions& options, const ReportResult& report) {
    fmt::print("{:<14}{:<16}{:<18}{:>10}{:>9}{:>9}{:>14}{:>8}\n", "metal", "virtual sample",
               "literature", "chi2/dof", "rms dn", "rms dk", "log10 |diff|", "dE");
    for (const StudyMetal& metal : report.study.metals) {
        fmt::print("{:<14}{:<16}{:<18}{:>10.3f}{:>9.4f}{:>9.4f}{:>14.3f}{:>8.2f}\n", metal.name,
                   metal.sample_set, metal.literature_set, metal.reduced_chi2, metal.rms_dn,
                   metal.rms_dk, metal.pair->log10.mean, metal.pair->mean_delta_e);
    }
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
    command.summary = "Run the whole study: five metals measured, fitted, rendered, compared";
    command.description =
        "Copper, silver, gold, aluminium and a zinc coating, each as a virtual sample made of one "
        "published set of optical constants: measured by a simulated ellipsometer, fitted, and "
        "rendered as a half-sphere twice, with the fitted constants and with another published "
        "set; and anodised aluminium, measured and fitted as a bare metal and with its film. "
        "Writes EXRs, PNGs, tables, figures 5 to 9 of the paper and one self-contained page "
        "(index.html) to the folder -o; `drude report DIR` makes the page again without "
        "rendering. Unless --spectral puts 10 nm layers of S0 to S3 into every picture, a quarter "
        "as large one beside it (*-spectral.exr) has them, for the page's spectra.\n\n"
        "The environment is a courtyard that the program makes itself; --environment FILE takes a "
        "lat-long picture instead, such as the Uffizi Gallery light probe (courtesy of Paul "
        "Debevec; bring your own copy), which makes the study that of Berger, Weidlich, Wilkie & "
        "Magnor 2012. --beta and --lobe change the roughness, which their renderer clamped to a "
        "Blinn-Phong half-height angle of 0.011774 rad.";
    command.example =
        "drude reproduce -o study\n"
        "drude reproduce -o uffizi --environment uffizi_latlong.exr --spp 256";
    command.declare = [](OptionSet& set, const CommonOptions& common) {
        const auto options = std::make_shared<StudyOptions>();
        set.option("-o,--output", options->folder, "the folder to write to");
        set.option("--environment", options->environment, "a picture's file (default: courtyard)");
        set.choice("--lobe", options->lobe, lobe_names(), "microfacet lobe (default blinn-phong)");
        set.choice("--masking", options->masking, masking_names(), "default v-groove");
        set.option("--beta", options->beta, "roughness in rad (default 0.011774; 0: a mirror)");
        set.option("--spp", options->samples_per_pixel, "samples a pixel (default 64)");
        set.option("--resolution", options->resolution, "pixels a side (default 512)");
        set.option("--seed", options->seed, "of noise and samples (default 1)");
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
