#include "render/render.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "base/numbers.h"
#include "base/sha256.h"
#include "image/analyser.h"
#include "render/batch_tracer.h"
#include "render/bounce_choice.h"
#include "render/film_checkpoint.h"
#include "render/film_layers.h"
#include "render/film_loop.h"
#include "render/film_ranks.h"
#include "render/geometry_layers.h"
#include "render/light_choice.h"
#include "render/sampler_choice.h"
#include "render/surface_model.h"
#include "render/transport_choice.h"
#include "render/wavelength_choice.h"

namespace drude {

namespace {

constexpr uint64_t most_samples = uint64_t{most_terms} * largest_batch;

void check_options(const RenderOptions& options) {
    if (options.stokes && options.transport && *options.transport != Transport::stokes) {
        user_error("S0..S3 are asked for, but the transport '{}' does not carry them; use 'stokes'",
                   transport_name(*options.transport));
    }
    if (options.samples_per_pixel && *options.samples_per_pixel < 1) {
        user_error("{} samples per pixel; expected at least 1", *options.samples_per_pixel);
    }
    if (options.samples_per_pixel &&
        static_cast<uint64_t>(*options.samples_per_pixel) > most_samples) {
        user_error("{} samples per pixel; expected at most {}", *options.samples_per_pixel,
                   most_samples);
    }
    const int n = options.wavelengths;
    if (n != 0 && n != 4 && n != 8 && n != 16 && n != spectral_bins) {
        user_error("{} wavelengths a path; expected 4, 8, 16 or {}", n, spectral_bins);
    }
    if (options.spectral && n != 0 && n != spectral_bins) {
        user_error("spectral layers need all {} wavelengths a path, not {}", spectral_bins, n);
    }
    if (options.mirror_below && !(*options.mirror_below >= 0 && *options.mirror_below <= 4)) {
        user_error("mirrors below a roughness of {}; expected a number from 0 (lobes stay) to 4",
                   *options.mirror_below);
    }
    if (options.seconds && !(*options.seconds > 0 && std::isfinite(*options.seconds))) {
        user_error("a time of {} s; expected more than 0", *options.seconds);
    }
    if (options.error && !(*options.error > 0 && *options.error < 1)) {
        user_error("a relative error of {}; expected more than 0 and below 1, e.g. 0.02",
                   *options.error);
    }
    if (options.checkpoint_seconds &&
        !(*options.checkpoint_seconds >= 0 && std::isfinite(*options.checkpoint_seconds))) {
        user_error("{} s between checkpoints; expected 0 (none but at an interrupt) or more",
                   *options.checkpoint_seconds);
    }
    if (options.shards < 1 || options.shard < 0 || options.shard >= options.shards) {
        user_error("shard {}/{}: expected i/n with i from 0 to n - 1", options.shard,
                   options.shards);
    }
    const bool cut = options.shards > 1 || (options.ranks && options.ranks->size() > 1);
    if (cut && (options.seconds || options.error)) {
        user_error(
            "a time or an error ends a whole picture, not {}: how many samples the others take is "
            "not known there; give a number of samples",
            options.shards > 1 ? "a shard" : "the share of one of several processes");
    }
}

// Which part of a larger picture is rendered; empty for the whole.
std::string crop_text(const Film& film) {
    if (!film.crop) return "";
    return fmt::format("from {},{} of {}x{}", film.crop->x0, film.crop->y0, film.crop->whole_width,
                       film.crop->whole_height);
}

// Part i of n of the part's batches, as even as whole batches allow.
void cut(int i, int n, FilmPart* part) {
    const uint64_t first = part->first, count = part->last - part->first;
    part->first = static_cast<uint32_t>(first + count * static_cast<uint64_t>(i) / n);
    part->last = static_cast<uint32_t>(first + count * (static_cast<uint64_t>(i) + 1) / n);
}

// Surfaces modelled otherwise make another picture, whose samples must not be mixed with these.
std::string picture_hash(const Scene& scene, const RenderOptions& options) {
    if (options.films == FilmUse::automatic && !options.mirror_below) return scene.sha256;
    return sha256(
        fmt::format("{} films {} mirrors {}", scene.sha256, static_cast<int>(options.films),
                    options.mirror_below ? format_double(*options.mirror_below) : "auto"));
}

// Which batches of which picture these options ask for.
FilmPart part_for(const Scene& scene, const RenderOptions& options, const RenderSummary& summary,
                  const std::string& isa) {
    FilmPart part;
    FilmJob& job = part.job;
    const bool open = options.seconds || options.error;
    uint32_t batches = most_terms;
    const SamplerChoice sampler = sampler_choice(scene, options);
    job.batch_size = sampler.batch_size;
    if (sampler.samples) {
        batches = static_cast<uint32_t>((*sampler.samples - 1) / job.batch_size + 1);
    }
    job.scene_hash = picture_hash(scene, options);
    job.width = scene.film.width;
    job.height = scene.film.height;
    job.seed = options.seed.value_or(scene.seed);
    job.max_depth = scene.max_depth;
    job.transport = summary.transport;
    job.wavelengths = summary.wavelengths;
    job.spectral = options.spectral;
    if (scene.camera.analyser) job.analyser = format_analyser(*scene.camera.analyser);
    job.crop = crop_text(scene.film);
    job.instruction_set = fmt::format("{}/{}", DRUDE_ISA, isa);
    job.version = DRUDE_VERSION;
    part.batches = open ? 0 : batches;
    part.last = batches;
    cut(options.shard, options.shards, &part);
    if (options.ranks) cut(options.ranks->rank(), options.ranks->size(), &part);
    return part;
}

std::vector<std::string> plugins_of(const Scene& scene) {
    std::set<std::string> names;
    for (const SurfaceMaterial& material : scene.materials) {
        const auto* plugin = std::get_if<PluginMaterial>(&material);
        if (plugin != nullptr) names.insert(plugin->name);
    }
    return {names.begin(), names.end()};
}

// A checkpoint that is there: gone on from, or said that it is not.
void take_up(const RenderOptions& options, RenderedFilm* film) {
    RenderSummary& summary = film->summary;
    std::error_code error;
    if (options.resume) {
        if (resume_from(options.checkpoint, options.allow_mixed, &film->part, &film->sums)) {
            summary.resumed_samples =
                static_cast<int>(film->part.fewest) * film->part.job.batch_size;
        }
    } else if (std::filesystem::exists(options.checkpoint, error)) {
        summary.warnings.push_back(
            fmt::format("{} is not gone on from: the picture is begun anew (--resume goes on)",
                        options.checkpoint));
    }
}

}  // namespace

RenderedFilm render_film(const Scene& scene, const RenderOptions& options) {
    check_options(options);
    RenderSummary summary;
    summary.warnings = scene.warnings;
    summary.plugins = plugins_of(scene);
    const TransportChoice transport = transport_choice(scene, options);
    summary.transport = transport.transport;
    summary.transport_reason = transport.reason;
    summary.wavelengths = options.wavelengths
                              ? options.wavelengths
                              : cheapest_exact_wavelengths(scene, options).wavelengths;

    const Geometry geometry(scene, options.isa);
    const OpticalElements elements(scene, options.isa);
    const NumberTextures numbers(scene);
    const Lights lights(scene, geometry, {}, light_choice(scene, options).constant_skies);
    if (options.lights_are_built) options.lights_are_built();
    summary.warnings.insert(summary.warnings.end(), lights.warnings().begin(),
                            lights.warnings().end());
    if (scene.max_depth > most_certain_bounces) {
        summary.warnings.push_back(fmt::format(
            "maxdepth is {}: paths of more than {} bounces end at random, so that light "
            "which comes over more mirrors is noise",
            scene.max_depth, most_certain_bounces));
    }
    if (lights.empty())
        summary.warnings.emplace_back("the scene has no light; the picture is black");
    const CameraRays camera(scene.camera, scene.film.width, scene.film.height);
    const PixelFilter filter(scene.filter);
    const BounceChoice bounces = bounce_choice(scene);
    TracerSetup setup{scene,
                      geometry,
                      lights,
                      elements,
                      numbers,
                      camera,
                      filter,
                      options.seed.value_or(scene.seed),
                      bounces.reflections,
                      options.threads,
                      {}};
    setup.surfaces = surface_model(scene, options);
    if (!options.trace_every_ray) setup.clear_after = bounces.clear_after;
    const auto tracer = make_batch_tracer(summary.transport, summary.wavelengths, setup);

    const std::vector<std::string> coarse = tracer->warnings();
    summary.warnings.insert(summary.warnings.end(), coarse.begin(), coarse.end());

    const FilmPart part = part_for(scene, options, summary, geometry.isa());
    RenderedFilm film{std::move(summary), part, FilmSums(part.job.layout()), {}};
    if (!options.checkpoint.empty()) take_up(options, &film);
    if (scene.film.gbuffer) {
        film.geometry.width = scene.film.width;
        film.geometry.height = scene.film.height;
        add_geometry_layers(scene, geometry, camera, options.threads, &film.geometry);
    }

    FilmLoopOptions loop;
    loop.stop = {film.part.last - film.part.first, options.seconds, options.error};
    loop.threads = options.threads;
    loop.quiet = options.quiet;
    loop.checkpoint = options.checkpoint;
    loop.checkpoint_seconds = options.checkpoint_seconds;
    loop.command_line = options.command_line;
    const FilmLoopResult result = run_film_loop(*tracer, loop, &film.part, &film.sums);
    film.summary.interrupted = result.interrupted;
    film.summary.checkpoints = result.checkpoints;
    film.summary.checkpoint_seconds = result.checkpoint_seconds;
    if (!result.checkpoint_error.empty()) {
        film.summary.warnings.push_back(
            fmt::format("a checkpoint could not be written: {}", result.checkpoint_error));
    }
    summarise(&film);
    return film;
}

void summarise(RenderedFilm* film) {
    RenderSummary& summary = film->summary;
    const FilmPart& part = film->part;
    summary.batch_size = part.job.batch_size;
    summary.batches = static_cast<int>(part.fewest);
    summary.samples_per_pixel = summary.batches * summary.batch_size;
    summary.rays = part.counts.rays;
    summary.projections = part.counts.projections;
    summary.not_finite = part.counts.not_finite;
    summary.render_seconds = part.counts.seconds;
    if (part.fewest >= 2) summary.error = relative_error(film->sums);
}

RenderResult render(const Scene& scene, const RenderOptions& options) {
    const RenderedFilm film = render_film(scene, options);
    RenderResult result;
    static_cast<RenderSummary&>(result) = film.summary;
    const std::vector<std::string> more = count_warnings(film.part.counts, film.summary.plugins);
    result.warnings.insert(result.warnings.end(), more.begin(), more.end());
    Image& image = result.image;
    image.width = film.part.job.width;
    image.height = film.part.job.height;
    image.attributes = picture_attributes(film.part.job, film.part.first, film.part.fewest);
    const FilmLayers layers(film.sums.layout(), film.part.fewest >= 2);
    for (const ExrChannel& channel : layers.channels()) image.add(channel.name);
    const auto width = static_cast<size_t>(image.width);
    std::vector<uint32_t> words(width * layers.channels().size());
    const size_t own = image.channels.size();
    for (const Channel& channel : film.geometry.channels) image.channels.push_back(channel);
    for (size_t first = 0; first < image.pixels(); first += width) {
        layers.row(film.sums, first, words.data());
        for (size_t c = 0; c < own; ++c) {
            std::transform(&words[c * width], &words[c * width] + width,
                           &image.channels[c].data[first],
                           [](uint32_t word) { return std::bit_cast<float>(word); });
        }
    }
    return result;
}

void write_film(const std::string& path, const RenderedFilm& film,
                const std::string& command_line) {
    if (film.part.fewest < 1) throw std::logic_error("write_film: a pixel without samples");
    const FilmLayers layers(film.sums.layout(), film.part.fewest >= 2);
    ExrPicture picture;
    picture.width = film.part.job.width;
    picture.height = film.part.job.height;
    picture.channels = layers.channels();
    const size_t own = picture.channels.size();
    for (const Channel& channel : film.geometry.channels)
        picture.channels.push_back({channel.name});
    picture.attributes = picture_attributes(film.part.job, film.part.first, film.part.fewest);
    for (const auto& [name, value] : film.geometry.attributes) picture.attributes[name] = value;
    picture.attributes["commandLine"] = command_line;
    const auto width = static_cast<size_t>(picture.width);
    write_exr_rows(path, picture, Compression::piz, [&](int y, uint32_t* words) {
        const size_t first = static_cast<size_t>(y) * width;
        layers.row(film.sums, first, words);
        for (size_t c = 0; c < film.geometry.channels.size(); ++c) {
            std::memcpy(words + (own + c) * width, &film.geometry.channels[c].data[first],
                        width * sizeof(float));
        }
    });
}

}  // namespace drude
