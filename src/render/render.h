// Rendering a scene to an image.
#pragma once

#include <optional>
#include <string>

#include "image/image.h"
#include "render/throughput.h"
#include "scene/scene.h"

namespace drude {

struct RenderOptions {
    std::optional<int> samples_per_pixel;  // otherwise the scene's
    std::optional<uint64_t> seed;          // otherwise the scene's
    std::optional<Transport> transport;    // otherwise the cheapest exact one
    bool stokes = false;                   // layers S0..S3; needs the stokes transport
    bool spectral = false;                 // 10 nm layers in the JCGT layout (Fichet et al. 2021)
    int wavelengths = 0;                   // a path: 8, 16 or 40; 0: 8, or 40 with `spectral`
    int threads = 0;
    bool quiet = false;
    std::string isa;  // Embree's instruction set; empty: the best
};

struct RenderResult {
    Image image;
    int samples_per_pixel = 0;  // rendered; fewer than asked where interrupted
    int batches = 0, batch_size = 0;
    Transport transport = Transport::scalar;
    std::string transport_reason;
    int wavelengths = 0;
    uint64_t rays = 0;
    uint64_t projections = 0, not_finite = 0;  // see PathStatistics; both should be 0
    double render_seconds = 0;
    bool interrupted = false;
    std::vector<std::string> warnings;
};

// Channels: R, G, B; variance.R, .G, .B of these means, estimated between batches (only with two
// or more); S0.R ... S3.B and their variances with `stokes`; "S0.384,500000nm" ... with `spectral`
// (S1..S3 too with `stokes`). Samples are rounded up to whole batches. Same scene, options and
// seed give the same bits whatever the number of threads.
// Throws Error (user) for options that contradict each other, Error (outside) from Embree.
RenderResult render(const Scene& scene, const RenderOptions& options);

}  // namespace drude
