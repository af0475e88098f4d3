// One batch of samples of one pixel: what the driver asks of a transport and a packet width.
#pragma once

#include <limits>
#include <memory>

#include "render/geometry.h"
#include "render/lights.h"
#include "render/path.h"
#include "render/pixel_filter.h"
#include "render/surface_model.h"

namespace drude {

inline constexpr int spectral_bins = 40;  // of 10 nm

// Means over the batch.
struct BatchResult {
    double rgb[4][3];                  // linear sRGB of S0..S3 (S0 alone unless `stokes`)
    float spectral[4][spectral_bins];  // radiance of S0..S3 in W m^-2 sr^-1 nm^-1
};

struct BatchRequest {
    int x = 0, y = 0;
    uint32_t batch = 0;
    int batch_size = 16;
};

class BatchTracer {
  public:
    virtual ~BatchTracer() = default;
    // Fills rgb (and spectral, where the tracer carries all bins); adds to `statistics`.
    virtual void trace(const BatchRequest& request, BatchResult* result,
                       PathStatistics* statistics) const = 0;
    // What its tables cannot hold as exactly as they should; for people.
    virtual std::vector<std::string> warnings() const = 0;
};

struct TracerSetup {
    const Scene& scene;
    const Geometry& geometry;
    const Lights& lights;
    const OpticalElements& elements;
    const NumberTextures& numbers;
    const CameraRays& camera;
    const PixelFilter& filter;
    uint64_t seed;
    int max_depth;
    int threads = 0;                 // for tables that take a while
    SamplingStrategy strategy = {};  // of `lights` too
    SurfaceModel surfaces = {};
    // See BounceChoice::clear_after.
    int clear_after = std::numeric_limits<int>::max();
    // What the film sees with; it counts as CIE XYZ.
    const ColourMatching* observer = &cie1931();
};

// `wavelengths` is 4, 8, 16 or spectral_bins. Error (user) for a scene that the strategy cannot
// draw.
std::unique_ptr<BatchTracer> make_batch_tracer(Transport transport, int wavelengths,
                                               const TracerSetup& setup);

}  // namespace drude
