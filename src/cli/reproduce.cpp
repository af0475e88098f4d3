// drude reproduce: the whole study, from simulated measurements to the report.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "cli/command_list.h"
#include "materials/lobe.h"
#include "report/study.h"

namespace drude {

namespace {

nlohmann::json to_json(const StudyOptions& options, const StudyResult& result) {
    nlohmann::json json;
    json["folder"] = options.folder;
    json["environment"] = result.info.environment;
    if (!result.info.environment_credit.empty()) json["credit"] = result.info.environment_credit;
    json["lobe"] = options.lobe;
    json["masking"] = options.masking;
    json["beta"] = options.beta;
    json["seed"] = options.seed;
    json["seconds"] = result.info.seconds;
    json["render_seconds"] = result.render_seconds;
    json["files"] = result.files;
    json["notes"] = result.notes;
    json["materials"] = nlohmann::json::array();
    for (const StudyMetal& metal : result.metals) {
        const Log10Difference& d = metal.log10_difference;
        json["materials"].push_back(
            {{"name", metal.name},
             {"sample_set", metal.sample_set},
             {"literature_set", metal.literature_set},
             {"chi2_reduced", metal.reduced_chi2},
             {"dof", metal.dof},
             {"rms_dn", metal.rms_dn},
             {"rms_dk", metal.rms_dk},
             {"log10_difference",
              {{"mean", d.mean}, {"p50", d.p50}, {"p99", d.p99}, {"max", d.max}}}});
    }
    return json;
}

void print(const StudyOptions& options, const StudyResult& result) {
    fmt::print("{:<14}{:<16}{:<18}{:>10}{:>9}{:>9}{:>14}\n", "metal", "virtual sample",
               "literature", "chi2/dof", "rms dn", "rms dk", "log10 |diff|");
    for (const StudyMetal& metal : result.metals) {
        fmt::print("{:<14}{:<16}{:<18}{:>10.3f}{:>9.4f}{:>9.4f}{:>14.3f}\n", metal.name,
                   metal.sample_set, metal.literature_set, metal.reduced_chi2, metal.rms_dn,
                   metal.rms_dk, metal.log10_difference.mean);
    }
    for (const std::string& note : result.notes) fmt::print("note: {}\n", note);
    fmt::print("{}/index.html and {}/comparison.png in {:.1f} s\n", options.folder, options.folder,
               result.info.seconds);
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
        "set. Writes EXRs, PNGs, tables and one self-contained page (index.html) to the folder "
        "-o.\n\n"
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
            const StudyResult result = run_study(*options);
            if (common.json) {
                fmt::print("{}\n", to_json(*options, result).dump(2));
            } else {
                print(*options, result);
            }
            return 0;
        };
    };
    return command;
}

}  // namespace drude
