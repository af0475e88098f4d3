// Rendering a scene to an image.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "image/image.h"
#include "render/film_job.h"
#include "render/film_sums.h"
#include "render/throughput.h"
#include "scene/scene.h"

namespace drude {

class Ranks;

// Films on metals: where leaving them out would show, always, or never.
enum class FilmUse { automatic, keep, leave_out };

struct RenderOptions {
    // The first of these that is reached ends a picture; without any the scene's samples do.
    std::optional<int> samples_per_pixel;
    std::optional<double> seconds;       // of rendering
    std::optional<double> error;         // as relative_error() of film_schedule.h
    std::optional<uint64_t> seed;        // otherwise the scene's
    std::optional<Transport> transport;  // otherwise the cheapest exact one
    bool stokes = false;                 // layers S0..S3; needs the stokes transport
    bool spectral = false;               // 10 nm layers in the JCGT layout (Fichet et al. 2021)
    int wavelengths = 0;                 // a path: 4, 8, 16 or 40; 0: wavelength_choice.h
    // Richer or poorer models than the cheapest that the scene needs (decisions.h):
    FilmUse films = FilmUse::automatic;
    std::optional<double>
        mirror_below;                 // lobes of a smaller beta (or alpha) are mirrors; in [0, 4]
    bool sample_every_light = false;  // constant skies too
    bool trace_every_ray = false;     // also those that are known to meet nothing
    int threads = 0;
    bool quiet = false;
    std::string isa;  // Embree's instruction set; empty: the best

    // The batches [batches i/n, batches (i+1)/n) alone; a count of samples must end the picture.
    int shard = 0, shards = 1;
    // The same once more over the processes that render together; none where null.
    const Ranks* ranks = nullptr;

    std::string checkpoint;  // file to save sums in when interrupted and now and then; empty: none
    std::optional<double> checkpoint_seconds;  // see CheckpointClock
    bool resume = false;                       // go on from `checkpoint`, where it is there
    bool allow_mixed = false;                  // also one of another instruction set
    std::string command_line;                  // for the checkpoint

    // Called once the lights hold what they need of the scene, before the film takes its memory:
    // pictures that the scene carries (InfiniteLight::picture) may be let go.
    std::function<void()> lights_are_built;
};

struct RenderSummary {
    int samples_per_pixel = 0;  // rendered; fewer than asked where interrupted
    int batches = 0, batch_size = 0;
    Transport transport = Transport::scalar;
    std::string transport_reason;
    int wavelengths = 0;
    uint64_t rays = 0;
    uint64_t projections = 0, not_finite = 0;  // see PathStatistics; both should be 0
    double render_seconds = 0;                 // of all runs, where resumed
    bool interrupted = false;
    int resumed_samples = 0;  // a pixel at least, from the checkpoint
    int checkpoints = 0;
    double checkpoint_seconds = 0;
    std::optional<double> error;  // relative_error(); of two batches or more
    std::vector<std::string> warnings;
    std::vector<std::string> plugins;  // the scene's, by name, each once
};

struct RenderResult : RenderSummary {
    Image image;
};

// A picture as exact sums, to be written row by row, merged or resumed.
struct RenderedFilm {
    RenderSummary summary;
    FilmPart part;
    FilmSums sums;
    Image geometry;  // layers of Film "gbuffer" (geometry_layers.h); none where it is another
};

// Renders the batches that the options name. Same scene, options and seed give the same sums
// whatever the number of threads, and whether the run was resumed. An interrupt is obeyed at once
// where there is a checkpoint to save, otherwise once every pixel holds a batch.
// Throws Error (user) for options that contradict each other and for a checkpoint that does not
// fit, Error (outside) from Embree and the disk.
RenderedFilm render_film(const Scene& scene, const RenderOptions& options);

// Brings the counts of the summary up to the film's part and sums.
void summarise(RenderedFilm* film);

// Channels: R, G, B; variance.R, .G, .B of these means, estimated between batches (only with two
// or more); S0.R ... S3.B and their variances with `stokes`; "S0.384,500000nm" ... with `spectral`
// (S1..S3 too with `stokes`); the layers of Film "gbuffer". Samples are rounded up to whole
// batches. Errors as render_film.
RenderResult render(const Scene& scene, const RenderOptions& options);

// The picture of a film, written row by row: no second film of floats in memory.
// std::logic_error where a pixel has no batch.
void write_film(const std::string& path, const RenderedFilm& film, const std::string& command_line);

}  // namespace drude
