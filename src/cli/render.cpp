// drude render: a scene to an EXR.
#include "render/render.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/executor.h"
#include "base/interrupt.h"
#include "cli/command_list.h"
#include "cli/json_output.h"
#include "render/environment_choice.h"
#include "render/transport_choice.h"
#include "scene/resolution.h"

namespace drude {

namespace {

struct Options {
    std::string scene, output, transport = "auto", environment, resolution, isa;
    int samples = 0, wavelengths = 0, max_depth = -1;
    uint64_t seed = 0;
    bool spectral = false, stokes = false, dry_run = false;
};

void describe(const Scene& scene) {
    size_t triangles = 0, round = 0;
    for (const Shape& shape : scene.shapes) {
        if (const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry)) {
            triangles += mesh->triangles.size();
        } else {
            ++round;
        }
    }
    fmt::print("{}: {} x {} pixels, {} samples, at most {} reflections a path\n", scene.file,
               scene.film.width, scene.film.height, scene.samples_per_pixel, scene.max_depth);
    fmt::print("  {} spheres, disks and cylinders, {} triangles, {} materials, {} textures\n",
               round, triangles, scene.materials.size(),
               scene.number_textures.size() + scene.spectrum_textures.size());
    fmt::print("  {} infinite, {} distant, {} area lights\n", scene.infinite_lights.size(),
               scene.distant_lights.size(), scene.area_lights.size());
    fmt::print("  hash {}\n", scene.sha256);
}

int run(const Options& options, const OptionSet& given, const CommonOptions& common) {
    if (options.output.empty() && !options.dry_run) {
        user_error("render: no output; name the picture with -o OUT.exr");
    }
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
    if (options.dry_run) {
        for (const std::string& warning : scene.warnings) {
            fmt::print(stderr, "drude: warning: {}\n", warning);
        }
        describe(scene);
        return 0;
    }

    RenderOptions render_options;
    if (given.given("--spp")) render_options.samples_per_pixel = options.samples;
    if (given.given("--seed")) render_options.seed = options.seed;
    if (options.transport == "scalar") render_options.transport = Transport::scalar;
    if (options.transport == "intensity") render_options.transport = Transport::intensity;
    if (options.transport == "stokes") render_options.transport = Transport::stokes;
    render_options.stokes = options.stokes;
    render_options.spectral = options.spectral;
    render_options.wavelengths = options.wavelengths;
    render_options.threads = common.threads;
    render_options.quiet = common.quiet;
    render_options.isa = options.isa;
    RenderResult result = render(scene, render_options);
    for (const std::string& warning : result.warnings) {
        fmt::print(stderr, "drude: warning: {}\n", warning);
    }
    result.image.attributes["commandLine"] = fmt::format("{}", fmt::join(common.command_line, " "));
    write_exr(options.output, result.image, Compression::piz);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

    const int threads = common.threads > 0 ? common.threads : available_threads();
    if (common.json) {
        const nlohmann::json json = {{"output", options.output},
                                     {"seconds", seconds},
                                     {"render_seconds", result.render_seconds},
                                     {"spp", result.samples_per_pixel},
                                     {"rays", result.rays},
                                     {"transport", transport_name(result.transport)},
                                     {"transport_reason", result.transport_reason},
                                     {"wavelengths", result.wavelengths},
                                     {"threads", threads},
                                     {"interrupted", result.interrupted},
                                     {"warnings", result.warnings}};
        print_json_document(json);
    } else {
        fmt::print("{}: {} samples a pixel, {:.3g} million rays in {:.2f} s on {} threads\n",
                   options.output, result.samples_per_pixel, static_cast<double>(result.rays) / 1e6,
                   result.render_seconds, threads);
        fmt::print("transport {}: {}\n", transport_name(result.transport), result.transport_reason);
    }
    if (result.interrupted) {
        fmt::print(stderr, "drude: interrupted; {} holds the {} samples a pixel that were done\n",
                   options.output, result.samples_per_pixel);
        return 128 + interrupted();
    }
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
        "--environment FILE puts another picture around the scene (lat-long or equal-area; "
        "'courtyard' is made by the program). An interrupt saves the samples that are complete.";
    command.example =
        "drude render scenes/half-sphere.pbrt --environment courtyard --spp 64 -o copper.exr\n"
        "drude render scenes/cornell-metals.pbrt --stokes --spectral -o box.exr\n"
        "drude render scene.pbrt --dry-run";
    command.declare = [](OptionSet& set, const CommonOptions& common) {
        const auto options = std::make_shared<Options>();
        set.positional("SCENE", options->scene, "a pbrt-v4 scene file", true);
        set.option("-o,--output", options->output, "the EXR to write");
        set.option("--spp", options->samples, "samples a pixel (default: the scene's)");
        set.option("--seed", options->seed, "of the samples (default: the scene's)");
        set.choice("--transport", options->transport, {"auto", "scalar", "intensity", "stokes"},
                   "what a path carries (default auto)");
        set.flag("--stokes", options->stokes, "write S0 to S3");
        set.flag("--spectral", options->spectral, "write radiance in 10 nm layers");
        set.option("--wavelengths", options->wavelengths, "wavelengths a path: 8, 16 or 40");
        set.option("--environment", options->environment,
                   "a picture in place of the scene's infinite lights, or 'courtyard'");
        set.option("--resolution", options->resolution, "WIDTHxHEIGHT in place of the scene's");
        set.option("--max-depth", options->max_depth, "reflections of a path at most");
        set.choice("--isa", options->isa, {"sse2", "sse4.2", "avx", "avx2", "avx512"},
                   "Embree's instruction set (default: the best here)");
        set.flag("--dry-run", options->dry_run, "read, check and describe the scene only");
        OptionSet* given = &set;
        return [options, given, &common] { return run(*options, *given, common); };
    };
    return command;
}

}  // namespace drude
