// drude render: a scene to an EXR.
#include "render/render.h"
#include "cli/warnings.h"
#include "image/image.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/executor.h"
#include "base/files.h"
#include "base/interrupt.h"
#include "base/numbers.h"
#include "base/sha256.h"
#include "cli/command_list.h"
#include "cli/decision_output.h"
#include "cli/json_output.h"
#include "cli/scene_description.h"
#include "render/decisions.h"
#include "render/environment_choice.h"
#include "render/film_checkpoint.h"
#include "render/film_partial.h"
#include "render/film_ranks.h"
#include "render/textures.h"
#include "render/transport_choice.h"
#include "scene/resolution.h"

namespace drude {

namespace {

struct Options {
    std::string scene, output, transport = "auto", environment, resolution, isa, shard, analyser;
    std::string films = "auto";
    int samples = 0, wavelengths = 0, max_depth = 0;
    double time = 0, error = 0, checkpoint = 0, mirror_below = 0;
    uint64_t seed = 0;
    bool spectral = false, stokes = false, dry_run = false, resume = false, allow_mixed = false;
    bool strict = false, explain = false, every_light = false, every_ray = false;
};

// "i/n", counted from 0.
void read_shard(const std::string& text, RenderOptions* options) {
    const size_t slash = std::min(text.find('/'), text.size());
    const auto i = parse_integer(text.substr(0, slash));
    const auto n = parse_integer(text.substr(std::min(slash + 1, text.size())));
    if (!i || !n || *n < 1 || *n > 65535 || *i < 0 || *i >= *n) {
        user_error("--shard '{}': expected i/n with i from 0 to n - 1, e.g. 0/4", text);
    }
    options->shard = static_cast<int>(*i);
    options->shards = static_cast<int>(*n);
}

// Where sums are saved; nowhere where the picture goes to a device or a pipe.
std::string checkpoint_for(const std::string& output, const Ranks* ranks) {
    std::error_code error;
    const auto status = std::filesystem::status(output, error);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) return "";
    if (!ranks) return checkpoint_path(output);
    const std::filesystem::path path(output);
    return checkpoint_path(
        (path.parent_path() /
         fmt::format("{}.rank-{}-of-{}.exr", path.stem().string(), ranks->rank(), ranks->size()))
            .string());
}

RenderOptions options_for(const Options& options, const Film& film, const OptionSet& given,
                          const CommonOptions& common, const Ranks* ranks) {
    RenderOptions result;
    if (given.given("--spp")) result.samples_per_pixel = options.samples;
    if (given.given("--time")) result.seconds = options.time;
    if (given.given("--error")) result.error = options.error;
    if (given.given("--seed")) result.seed = options.seed;
    if (options.transport == "scalar") result.transport = Transport::scalar;
    if (options.transport == "intensity") result.transport = Transport::intensity;
    if (options.transport == "stokes") result.transport = Transport::stokes;
    result.stokes = options.stokes;
    result.spectral = options.spectral || film.spectral;
    result.wavelengths = options.wavelengths;
    if (options.films == "keep") result.films = FilmUse::keep;
    if (options.films == "leave-out") result.films = FilmUse::leave_out;
    if (given.given("--mirror-below")) result.mirror_below = options.mirror_below;
    result.sample_every_light = options.every_light;
    result.trace_every_ray = options.every_ray;
    result.threads = common.threads;
    result.quiet = common.quiet || (ranks && ranks->rank() != 0);
    result.isa = options.isa;
    if (given.given("--shard")) read_shard(options.shard, &result);
    result.ranks = ranks;
    result.checkpoint = checkpoint_for(options.output, ranks);
    if (given.given("--checkpoint")) result.checkpoint_seconds = options.checkpoint;
    if (result.checkpoint.empty() && options.resume) {
        user_error("--resume: {} is no ordinary file, so that no checkpoint lies beside it",
                   options.output);
    }
    result.resume = options.resume;
    result.allow_mixed = options.allow_mixed;
    result.command_line = fmt::format("{}", fmt::join(common.command_line, " "));
    return result;
}

// The picture, or the shard's sums, and what stdout says of it. An interrupted shard has its
// checkpoint alone, an interrupted picture its file too where every pixel holds samples.
void write_and_report(const Options& options, const RenderOptions& render_options,
                      const CommonOptions& common, std::chrono::steady_clock::time_point start,
                      const std::vector<ModelDecision>& explained, RenderedFilm* film) {
    RenderSummary& summary = film->summary;
    const std::vector<std::string> more = count_warnings(film->part.counts, summary.plugins);
    summary.warnings.insert(summary.warnings.end(), more.begin(), more.end());
    print_warnings(summary.warnings);
    const bool is_shard = render_options.shards > 1;
    const bool writes = is_shard ? !summary.interrupted : summary.batches > 0;
    // Of a run that was killed while it wrote this very picture.
    if (writes) remove_abandoned_files(options.output);
    if (writes && is_shard) {
        write_partial(options.output, film->part, film->sums, render_options.command_line);
    } else if (writes) {
        write_film(options.output, *film, render_options.command_line);
    }
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const int threads = common.threads > 0 ? common.threads : available_threads();
    if (common.json) {
        nlohmann::json json = {
            {"output", writes ? options.output : ""},
            {"seconds", seconds},
            {"render_seconds", summary.render_seconds},
            {"spp", summary.samples_per_pixel},
            {"resumed_spp", summary.resumed_samples},
            {"rays", summary.rays},
            {"transport", transport_name(summary.transport)},
            {"transport_reason", summary.transport_reason},
            {"wavelengths", summary.wavelengths},
            {"threads", threads},
            {"processes", render_options.ranks ? render_options.ranks->size() : 1},
            {"checkpoints", summary.checkpoints},
            {"checkpoint_seconds", summary.checkpoint_seconds},
            {"interrupted", summary.interrupted},
            {"warnings", summary.warnings}};
        json["error"] = summary.error ? nlohmann::json(*summary.error) : nlohmann::json();
        if (options.explain) json["decisions"] = decisions_json(explained);
        print_json_document(json);
        return;
    }
    if (!writes) return;
    fmt::print(
        "{}: {} samples a pixel, {:.3g} million rays in {:.2f} s on {} thread{}{}\n",
        options.output, summary.samples_per_pixel, static_cast<double>(summary.rays) / 1e6,
        summary.render_seconds, threads, threads == 1 ? "" : "s",
        render_options.ranks ? fmt::format(" of {} processes", render_options.ranks->size()) : "");
    if (summary.error) fmt::print("estimated relative error {:.3g}\n", *summary.error);
    if (is_shard) fmt::print("shard {}; drude merge joins all of them\n", options.shard);
    if (options.explain) return print_decisions(explained);
    fmt::print("transport {}: {}\n", transport_name(summary.transport), summary.transport_reason);
}

// The exit status of an interrupted run, once it is said how to go on.
int say_interrupted(const Options& options, const RenderOptions& render_options,
                    const RenderedFilm& film, bool without_picture) {
    const bool has_picture =
        !without_picture && render_options.shards == 1 && film.summary.batches > 0;
    std::string text = "interrupted";
    if (has_picture) {
        text += fmt::format("; {} holds the {} samples a pixel that were done", options.output,
                            film.summary.samples_per_pixel);
    }
    if (!render_options.checkpoint.empty()) {
        text += fmt::format("; {} holds {} of it: the same command with --resume goes on",
                            render_options.checkpoint, has_picture ? "the sums" : "what was done");
    }
    fmt::print(stderr, "drude: {}\n", text);
    return 128 + (interrupted() ? interrupted() : SIGTERM);
}

// What --dry-run says in place of a picture.
int describe(const Scene& scene, const Options& options, const OptionSet& given,
             const CommonOptions& common) {
    std::vector<ModelDecision> explained;
    if (options.explain) {
        explained = decisions(scene, options_for(options, scene.film, given, common, nullptr));
    }
    if (common.json) {
        nlohmann::json json = {{"scene", scene.file},          {"width", scene.film.width},
                               {"height", scene.film.height},  {"spp", scene.samples_per_pixel},
                               {"max_depth", scene.max_depth}, {"scene_sha256", scene.sha256},
                               {"warnings", scene.warnings}};
        if (options.explain) json["decisions"] = decisions_json(explained);
        print_json_document(json);
        return 0;
    }
    fmt::print("{}", describe_scene(scene));
    if (options.explain) print_decisions(explained);
    return 0;
}

int run(const Options& options, const OptionSet& given, const CommonOptions& common) {
    if (options.output.empty() && !options.dry_run) {
        user_error("render: no output; name the picture with -o OUT.exr");
    }
    expect_exr_name("render", options.output);
    const auto start = std::chrono::steady_clock::now();
    Scene scene = read_scene(options.scene);
    if (!options.environment.empty()) {
        replace_environment(&scene, options.environment, common.threads);
    }
    if (!options.resolution.empty()) {
        set_resolution(options.resolution, "--resolution", &scene);
    }
    if (given.given("--max-depth")) {
        if (options.max_depth < 0)
            user_error("--max-depth {}: expected 0 or more", options.max_depth);
        scene.max_depth = options.max_depth;
    }
    if (given.given("--analyser")) {
        scene.camera.analyser = parse_analyser(options.analyser, "--analyser");
        // Sums with it and without are sums of different pictures.
        scene.sha256 = sha256(scene.sha256 + format_analyser(*scene.camera.analyser));
    }
    if (options.strict && !scene.stand_ins.empty()) {
        user_error("{}; expected nothing, with --strict, that something else stands in for{}",
                   scene.stand_ins[0],
                   scene.stand_ins.size() > 1
                       ? fmt::format(" (and {} more)", scene.stand_ins.size() - 1)
                       : "");
    }
    if (options.dry_run) {
        print_warnings(scene.warnings);
        // Pictures that cannot be read are found here, and not after an hour.
        const NumberTextures textures(scene);
        return describe(scene, options, given, common);
    }

    const std::unique_ptr<const Ranks> ranks = mpi_ranks();
    RenderOptions render_options = options_for(options, scene.film, given, common, ranks.get());
    const std::vector<ModelDecision> explained =
        options.explain ? decisions(scene, render_options) : std::vector<ModelDecision>{};
    render_options.lights_are_built = [&scene] {
        for (InfiniteLight& light : scene.infinite_lights) light.picture.reset();
    };
    RenderedFilm film = render_film(scene, render_options);
    // Where one process was interrupted no picture comes about: all save what they have.
    if (ranks && ranks->any(film.summary.interrupted)) {
        if (!film.summary.interrupted && !render_options.checkpoint.empty()) {
            write_partial(render_options.checkpoint, film.part, film.sums,
                          render_options.command_line);
        }
        ranks->finish();
        return say_interrupted(options, render_options, film, true);
    }
    if (ranks) gather_films(*ranks, options.allow_mixed, &film);
    if (!ranks || ranks->rank() == 0) {
        write_and_report(options, render_options, common, start, explained, &film);
    }
    // Only now: what is killed before finds its checkpoint again.
    if (ranks) ranks->finish();
    if (film.summary.interrupted) return say_interrupted(options, render_options, film, false);
    if (!render_options.checkpoint.empty()) remove_checkpoint(render_options.checkpoint);
    return 0;
}

}  // namespace

Command render_command() {
    Command command;
    command.name = "render";
    command.summary = "Render a pbrt-v4 scene to a spectral, polarised EXR";
    command.description =
        "Renders SCENE to an EXR of float32: R, G, B (linear sRGB), the variance of each between "
        "batches of samples, with --stokes the layers S0 to S3, with --spectral radiance in 10 nm "
        "layers from 380 to 780 nm (JCGT layout; all of S0 to S3 together with --stokes).\n\n"
        "--transport auto carries as little polarisation along a path as is provably exact for the "
        "scene and the layers asked for, and says which and why. The same seed gives the same bits "
        "on any number of threads.\n\n"
        "What is chosen by itself, from the transport to films too thin to be seen, is said by "
        "--explain, each with its reason, its cost and error, and the option that overrides it "
        "(docs/decisions.md).\n\n"
        "--environment FILE puts another picture around the scene (lat-long or equal-area; "
        "'courtyard' is made by the program).\n\n"
        "Material \"NAME\" of a scene may be a plugin: NAME.so in a folder of the environment "
        "variable "
        "DRUDE_PLUGIN_PATH (folders separated by colons).\n\n"
        "A picture ends at --spp samples a pixel, after --time seconds of rendering, or once its "
        "relative error is estimated to be at most --error, whichever of those given comes first; "
        "always with as many whole batches of samples (16 each) in every pixel. The error is the "
        "root of the mean over the pixels of (variance of R + of G + of B) / (R^2 + G^2 + B^2 + "
        "(m/10)^2), the variances those of the picture's own means between batches, m the mean of "
        "the root of R^2 + G^2 + B^2; it is looked at after 64, 80, 96, 112, 128 samples and then "
        "every eighth more, so that the same picture comes out every time. With --time the number "
        "of samples depends on the machine; at least one batch is rendered.\n\n"
        "--shard i/n (i from 0) renders a part of the samples as exact sums, which drude merge "
        "joins: the picture is that of one run, bit by bit. So is that of a run which was killed "
        "and goes on with --resume: exact sums are saved beside OUT.exr as OUT.checkpoint.exr now "
        "and then (--checkpoint) and at an interrupt, which also leaves the picture so far. The "
        "checkpoint goes when the picture is complete.\n\n"
        "Under mpirun (Open MPI) the processes share the samples, and the first writes the "
        "picture, "
        "bit by bit that of one process. On Ctrl-C mpirun gives them one second to save their "
        "checkpoints; --mca odls_base_sigkill_timeout 60 gives them more.";
    command.example =
        "drude render scenes/half-sphere.pbrt --environment courtyard --spp 64 -o copper.exr\n"
        "drude render scenes/cornell-metals.pbrt --stokes --spectral -o box.exr\n"
        "drude render scenes/half-sphere.pbrt --error 0.02 -o copper.exr\n"
        "drude render scene.pbrt --shard 0/2 -o part-0.exr\n"
        "drude render scene.pbrt --spp 4096 -o OUT.exr --resume\n"
        "mpirun -n 2 drude render scene.pbrt -o OUT.exr\n"
        "drude render scene.pbrt --dry-run --explain";
    command.declare = [](OptionSet& set, const CommonOptions& common) {
        const auto options = std::make_shared<Options>();
        set.positional("SCENE", options->scene, "a pbrt-v4 scene file", true);
        set.option("-o,--output", options->output, "the EXR to write");
        set.option("--spp", options->samples, "samples a pixel (default: the scene's)");
        set.option("--time", options->time, "seconds of rendering after which to stop");
        set.option("--error", options->error, "relative error of the picture at which to stop");
        set.option("--shard", options->shard, "i/n: part i of n of the samples, as exact sums");
        set.option("--checkpoint", options->checkpoint,
                   "seconds between checkpoints; 0: at an interrupt only (default: a minute or "
                   "more, so that they cost less than 1 %)");
        set.flag("--resume", options->resume, "go on from the checkpoint, where there is one");
        set.flag("--allow-mixed", options->allow_mixed,
                 "also from another instruction set, whose bits differ");
        set.option("--seed", options->seed, "of the samples (default: the scene's)");
        set.choice("--transport", options->transport, {"auto", "scalar", "intensity", "stokes"},
                   "what a path carries");
        set.flag("--stokes", options->stokes, "write S0 to S3");
        set.flag("--spectral", options->spectral, "write radiance in 10 nm layers");
        set.option("--wavelengths", options->wavelengths, "wavelengths a path: 4, 8, 16 or 40");
        set.option("--environment", options->environment,
                   "a picture in place of the scene's infinite lights, or 'courtyard'");
        set.option("--resolution", options->resolution, "WIDTHxHEIGHT in place of the scene's");
        set.option("--max-depth", options->max_depth,
                   "reflections of a path at most (default: the scene's)");
        set.choice("--isa", options->isa, {"sse2", "sse4.2", "avx", "avx2", "avx512"},
                   "Embree's instruction set (default: the best here)");
        set.option("--analyser", options->analyser,
                   "ANGLE[,retarder=FAST[:RETARDANCE]] in degrees: a filter before the camera");
        set.flag("--strict", options->strict,
                 "an error, not a warning, where pbrt-v4 would draw something else");
        set.option("--mirror-below", options->mirror_below,
                   "lobes of a smaller beta (or alpha) are mirrors; 0: never (default: 1e-5, 0 "
                   "under distant, point and spot lights)");
        set.choice("--films", options->films, {"auto", "keep", "leave-out"},
                   "films on metals; auto: where leaving them out would show");
        set.flag("--sample-every-light", options->every_light,
                 "look for constant skies too, which lobes find by themselves");
        set.flag("--every-ray", options->every_ray,
                 "trace also rays that are known to meet nothing");
        set.flag("--explain", options->explain,
                 "say what was chosen automatically, why, its cost and error, and what overrides "
                 "it; with --dry-run without rendering");
        set.flag("--dry-run", options->dry_run, "read, check and describe the scene only");
        OptionSet* given = &set;
        return [options, given, &common] { return run(*options, *given, common); };
    };
    return command;
}

}  // namespace drude
