// drude regress: has any picture changed?
#include "regress/regress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>

#include "base/files.h"
#include "base/interrupt.h"
#include "cli/command_list.h"
#include "cli/json_output.h"
#include "regress/junit.h"
#include "report/regress_page.h"

namespace drude {

namespace {

struct Options {
    std::string folder = "tests/references", html, junit, why;
    std::vector<std::string> only;
    uint64_t seed = 0;
    bool update = false, all = false;
};

using Json = nlohmann::ordered_json;

Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json();
}

const char* word(TestFamily family) {
    switch (family) {
        case TestFamily::pixel:
            return "pixel";
        case TestFamily::block:
            return "block";
        case TestFamily::mean:
            break;
    }
    return "mean";
}

Json noise_json(const CaseResult& result) {
    const NoiseTest& noise = *result.comparison->noise;
    Json json = {{"p_min", noise.p_min},
                 {"p_pixels", noise.p_pixels},
                 {"p_blocks", noise.p_blocks},
                 {"p_global", noise.p_global},
                 {"detectable_bias", number(result.detectable_bias)},
                 {"smallest_detectable_bias", number(noise.smallest_detectable_bias)},
                 {"outlier_fraction", noise.outlier_fraction},
                 {"mean_error", number(result.comparison->all.mean_error)},
                 {"rmse", number(result.comparison->all.rmse)},
                 {"relmse", number(result.comparison->all.relmse)}};
    json["worst"] = {{"test", word(noise.worst.family)},
                     {"channel", noise.worst.channel},
                     {"x", noise.worst.x},
                     {"y", noise.worst.y},
                     {"z", number(noise.worst.z)}};
    for (const MeanTest& mean : noise.means) {
        json["means"].push_back({{"channel", mean.channel},
                                 {"bias", number(mean.bias)},
                                 {"standard_error", number(mean.standard_error)},
                                 {"reference", number(mean.reference)}});
    }
    return json;
}

Json to_json(const ReferenceManifest& manifest, const RegressResult& run,
             const std::vector<std::string>& updated) {
    Json json = {{"folder", manifest.folder}, {"passed", run.count(CaseStatus::passed)},
                 {"failed", run.failed()},    {"skipped", run.count(CaseStatus::skipped)},
                 {"alpha", run.alpha},        {"alpha_each", run.alpha_each},
                 {"seconds", run.seconds},    {"updated", updated},
                 {"cases", Json::array()}};
    for (const CaseResult& result : run.cases) {
        const ReferenceCase& one = result.declared;
        Json object = {{"name", one.name},
                       {"status", status_word(result.status)},
                       {"message", result.message},
                       {"purpose", one.purpose},
                       {"scene", manifest.scene_path(one)},
                       {"reference", manifest.reference_path(one)},
                       {"scene_changed", result.scene_changed},
                       {"samples", one.samples},
                       {"seed", result.seed},
                       {"seconds", result.seconds}};
        if (result.comparison && result.comparison->noise) object.update(noise_json(result));
        object["commands"] = {{"render", result.render_command},
                              {"compare", result.compare_command},
                              {"update", result.update_command}};
        json["cases"].push_back(std::move(object));
    }
    return json;
}

void print(const ReferenceManifest& manifest, const RegressResult& run) {
    for (const CaseResult& result : run.cases) {
        if (result.good() && result.scene_changed) {
            fmt::print("{}: passed, but the scene or a file it names is not the reference's\n",
                       result.declared.name);
        }
        if (result.good() || result.status == CaseStatus::skipped) continue;
        fmt::print("{}: {}\n  {}\n", result.declared.name, status_word(result.status),
                   result.message);
        fmt::print("  look:   {}\n          {}\n  accept: {}\n", result.render_command,
                   result.compare_command, result.update_command);
    }
    double largest = 0, smallest = 1;
    for (const CaseResult& result : run.cases) {
        if (!result.good()) continue;
        largest = std::max(largest, result.detectable_bias);
        smallest = std::min(smallest, result.comparison->noise->p_min);
    }
    fmt::print("{} of {} cases of {} passed in {:.1f} s", run.count(CaseStatus::passed),
               run.cases.size(), manifest.folder, run.seconds);
    if (run.count(CaseStatus::skipped) > 0) {
        fmt::print(", interrupted before {}", run.count(CaseStatus::skipped));
    }
    if (run.count(CaseStatus::passed) > 0) {
        fmt::print("; smallest p of these {:.3g} against {:.3g}, largest invisible bias {:.2g}",
                   smallest, run.alpha_each, largest);
    }
    fmt::print("\n");
}

// The reason of an update: the option, or what a person answers.
std::string reason(const Options& options) {
    std::string why = options.why;
    if (why.empty() && isatty(STDIN_FILENO) != 0) {
        fmt::print(stderr, "Why do the references change? ");
        std::fflush(stderr);
        std::getline(std::cin, why);
    }
    if (why.find_first_not_of(" \t\r\n") == std::string::npos) {
        user_error(
            "--update: no reason given; say in the manifest why the pictures changed: "
            "--why 'TEXT'");
    }
    return why;
}

struct Updates {
    std::vector<std::string> names;
    int status = 0;  // the worst cause of a case that could not be updated
};

// Renders the references of the cases that are not as they should be (or of all that were chosen)
// and names them. A case that cannot be rendered is told, and does not keep the others.
Updates update(const ReferenceManifest& manifest, const RegressResult& run, const std::string& why,
               const Options& options, const CommonOptions& common) {
    Updates updates;
    for (const CaseResult& result : run.cases) {
        const bool stale =
            result.status == CaseStatus::failed || result.status == CaseStatus::weak ||
            result.status == CaseStatus::missing ||
            // The scene is well, the reference is not.
            (result.status == CaseStatus::error && result.rendered.width > 0) || options.all;
        if (!stale || interrupted()) continue;
        const std::string& name = result.declared.name;
        try {
            ReferenceCase one = result.declared;
            update_reference(manifest, &one, why, common.threads, common.quiet);
            // At once, so that an interrupt later does not part the picture from its history; and
            // into the manifest as it is now, which someone may have edited in the meantime.
            ReferenceManifest current = read_manifest(manifest.folder);
            const auto entry = std::find_if(current.cases.begin(), current.cases.end(),
                                            [&](const ReferenceCase& c) { return c.name == name; });
            if (entry == current.cases.end()) {
                user_error("{}: the case is no longer there; its reference was rendered",
                           current.path());
            }
            entry->history.push_back(one.history.back());
            write_manifest(current);
            updates.names.push_back(name);
            if (!common.quiet) fmt::print(stderr, "drude: {} updated\n", name);
        } catch (const Error& error) {
            fmt::print(stderr, "drude: {}: not updated: {}\n", name, error.message());
            updates.status = std::max(updates.status, static_cast<int>(error.cause()));
        }
    }
    return updates;
}

int exit_status(const RegressResult& run) {
    if (interrupted()) return 128 + interrupted();
    int status = run.failed() > 0 ? static_cast<int>(Cause::answer_is_no) : 0;
    for (const CaseResult& result : run.cases) {
        if (result.status == CaseStatus::error) {
            status = std::max(status, static_cast<int>(result.cause));
        }
    }
    return status;
}

int run(const Options& options, const OptionSet& given, const CommonOptions& common) {
    if (!options.update && (!options.why.empty() || options.all)) {
        user_error("{}: goes with --update only", options.all ? "--all" : "--why");
    }
    if (options.update && given.given("--seed")) {
        user_error("--seed: is of the new pictures; references have the manifest's own");
    }
    if (!std::filesystem::exists(options.folder + "/manifest.json")) {
        user_error(
            "{}: found no manifest.json there, expected the folder of the references; run it in "
            "the checkout, or name the folder",
            options.folder);
    }
    ReferenceManifest manifest = read_manifest(options.folder);
    // What would fail at the end fails now.
    for (const std::string& output : {options.html, options.junit}) {
        if (!output.empty()) AtomicFile{output};
    }
    const std::string why = options.update ? reason(options) : "";
    RegressOptions regress;
    regress.only = options.only;
    if (given.given("--seed")) regress.seed = options.seed;
    regress.threads = common.threads;
    regress.quiet = common.quiet;
    RegressResult result = run_regress(manifest, regress);
    Updates updates;
    if (options.update) {
        updates = update(manifest, result, why, options, common);
        // What counts is how the new references fare.
        if (!updates.names.empty() && !interrupted()) {
            manifest = read_manifest(options.folder);
            result = run_regress(manifest, regress);
        }
    }
    if (!options.html.empty()) write_file(options.html, regress_page(manifest, result));
    if (!options.junit.empty()) write_file(options.junit, junit_xml(result));
    if (common.json) {
        print_json_document(to_json(manifest, result, updates.names));
    } else {
        print(manifest, result);
    }
    return std::max(exit_status(result), updates.status);
}

}  // namespace

Command regress_command() {
    Command command;
    command.name = "regress";
    command.summary = "Render every reference scene anew and tell whether a picture changed";
    command.description =
        "Renders each case of DIR/manifest.json with few samples and another seed and holds it "
        "against its reference DIR/NAME.exr, which was rendered with many. Welch's test on every "
        "pixel, on 8x8 blocks and on the means of S0 to S3, from the variances between batches "
        "that both pictures hold; an unchanged program fails a whole run with a probability of at "
        "most the manifest's alpha (1e-5). A case whose noise would hide a bias of its "
        "largest_bias, a fraction of S0, does not pass either.\n\n"
        "--update renders the references of the cases that do not pass (--all: of every case "
        "chosen) and asks why; the answer is kept in the manifest. A scene or a material file that "
        "differs from the reference's is told, but what decides is the picture.\n\n"
        "A new case is an entry of the manifest: name (its reference is NAME.exr), scene (relative "
        "to DIR), purpose, samples and seed of every run, reference_samples and reference_seed "
        "(more "
        "and another), largest_bias; and where wanted wavelengths (8, 16, 40), transport (stokes, "
        "or "
        "auto for R, G, B alone) and resolution (WxH). --update renders its reference.\n\n"
        "Exit 0: all passed. 1: a picture changed, is too noisy to tell, or has no reference. "
        "2: a scene, reference or the manifest cannot be read.";
    command.example =
        "drude regress\n"
        "drude regress tests/references --html out/regress.html --junit out/regress.xml\n"
        "drude regress --only 'Ag-*' --seed 7\n"
        "drude regress --only Cu-fitted --update --why 'measured again after cleaning'";
    command.declare = [](OptionSet& set, const CommonOptions& common) {
        const auto options = std::make_shared<Options>();
        set.positional("DIR", options->folder, "the folder of the references", false);
        set.option("--only", options->only, "cases by name; 'Ag-*' for all that begin so; repeats");
        set.option("--seed", options->seed, "of the new pictures (default: the manifest's)");
        set.flag("--update", options->update, "render the references that do not pass");
        set.flag("--all", options->all, "with --update: also those that pass");
        set.option("--why", options->why, "with --update: the reason, kept in the manifest");
        set.option("--html", options->html, "write a self-contained page of the pictures");
        set.option("--junit", options->junit, "write JUnit XML");
        OptionSet* given = &set;
        return [options, given, &common] { return run(*options, *given, common); };
    };
    return command;
}

}  // namespace drude
