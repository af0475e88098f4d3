// Small pictures for charts: traced on the calling thread, whose processor time is what they cost,
// or as a reference on all threads.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/batch_tracer.h"
#include "render/transport_choice.h"

namespace drude {

// A scene with all that its tracers share.
class TracedScene {
  public:
    explicit TracedScene(Scene scene, const SamplingStrategy& strategy = {});
    TracedScene(const TracedScene&) = delete;
    TracedScene& operator=(const TracedScene&) = delete;

    const Scene& scene() const { return scene_; }
    // What a tracer is made of; the scene must outlive it.
    TracerSetup setup(uint64_t seed, const ColourMatching& observer = cie1931()) const;

  private:
    Scene scene_;
    SamplingStrategy strategy_;
    Geometry geometry_;
    OpticalElements elements_;
    NumberTextures numbers_;
    Lights lights_;
    CameraRays camera_;
    PixelFilter filter_;
};

// Means over the samples, linear sRGB: values[(pixel * rows + row) * 3 + c], pixels row by row from
// the top left, `rows` 1 (S0) or 4 (S0..S3).
struct TracedPicture {
    int width = 0, height = 0, rows = 1;
    std::vector<double> values;
    double seconds = 0;  // processor time of the calling thread
    double rays = 0;

    size_t pixels() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
    const double* at(size_t pixel, int row = 0) const {
        return &values[(pixel * static_cast<size_t>(rows) + static_cast<size_t>(row)) * 3];
    }
};

// `samples` a pixel in batches of `batch_size` (which is the number of points of a net: 1 makes
// every sample independent); a last batch that is not full counts as a full one.
TracedPicture trace_picture(const BatchTracer& tracer, const Film& film, int rows, int samples,
                            int batch_size = 16);

// Two independent halves of a reference, on all threads.
struct ReferencePicture {
    TracedPicture first, second;
    int samples = 0;  // a pixel in both together
    double mean(size_t i) const { return 0.5 * (first.values[i] + second.values[i]); }
};
ReferencePicture trace_reference(const BatchTracer& tracer, const Film& film, int rows,
                                 int samples);

// The mean over the pixels of
//     sum_c (a_c - r_c)(b_c - r'_c) / (sum_c R_c^2 + (m/10)^2),
// c over R, G, B of `row`, R the reference's S0, m the mean over the pixels of its length; r and r'
// its two halves. For a = b that is the mean squared relative error of a without the reference's
// own noise, which the halves do not share: with noise v of a half, (a - r)^2 would be too large by
// v. It may come out negative where the error is far below that noise.
double relative_product(const TracedPicture& a, const TracedPicture& b,
                        const ReferencePicture& reference, int row = 0);

// Its root: the relative error (of film_schedule.h's relative_error()) that the picture really has.
// NaN where the product is negative: the error is lost in the reference's noise.
double relative_rmse(const TracedPicture& picture, const ReferencePicture& reference, int row = 0);

// What `drude render` takes for a picture of S0, and why.
TransportChoice automatic_transport(const Scene& scene);

// The mean over pixels and R, G, B of S0.
double mean_value(const TracedPicture& picture);

}  // namespace drude
