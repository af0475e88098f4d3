#include "bench/charts/traced_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/executor.h"
#include "bench/charts/experiment.h"
#include "render/bounce_choice.h"
#include "render/light_choice.h"
#include "render/surface_model.h"

namespace drude {

namespace {

// Batches [first, first + batches) of one pixel, added to the picture.
void add_batches(const BatchTracer& tracer, uint32_t first, int batches, int batch_size,
                 size_t pixel, TracedPicture* picture, PathStatistics* statistics) {
    const auto rows = static_cast<size_t>(picture->rows);
    BatchRequest request;
    request.x = static_cast<int>(pixel % static_cast<size_t>(picture->width));
    request.y = static_cast<int>(pixel / static_cast<size_t>(picture->width));
    request.batch_size = batch_size;
    BatchResult result;
    double* values = &picture->values[pixel * rows * 3];
    for (int b = 0; b < batches; ++b) {
        request.batch = first + static_cast<uint32_t>(b);
        tracer.trace(request, &result, statistics);
        for (size_t i = 0; i < rows * 3; ++i) values[i] += result.rgb[i / 3][i % 3] / batches;
    }
}

TracedPicture black_picture(const Film& film, int rows) {
    TracedPicture picture;
    picture.width = film.width;
    picture.height = film.height;
    picture.rows = rows;
    picture.values.assign(picture.pixels() * static_cast<size_t>(rows) * 3, 0.0);
    return picture;
}

}  // namespace

TracedScene::TracedScene(Scene scene, const SamplingStrategy& strategy)
    : scene_(std::move(scene)),
      strategy_(strategy),
      geometry_(scene_),
      elements_(scene_, ""),
      numbers_(scene_),
      // The usual strategy is the renderer's, with what it decides of this scene.
      lights_(scene_, geometry_, strategy,
              !(strategy == SamplingStrategy()) || light_choice(scene_, {}).constant_skies),
      camera_(scene_.camera, scene_.film.width, scene_.film.height),
      filter_(scene_.filter) {}

TracerSetup TracedScene::setup(uint64_t seed, const ColourMatching& observer) const {
    TracerSetup setup{scene_,  geometry_, lights_,          elements_, numbers_, camera_,
                      filter_, seed,      scene_.max_depth, 0,         strategy_};
    setup.observer = &observer;
    setup.surfaces = surface_model(scene_, {});
    if (strategy_ == SamplingStrategy()) setup.clear_after = bounce_choice(scene_).clear_after;
    return setup;
}

TracedPicture trace_picture(const BatchTracer& tracer, const Film& film, int rows, int samples,
                            int batch_size) {
    TracedPicture picture = black_picture(film, rows);
    const int batches = (samples - 1) / batch_size + 1;
    PathStatistics statistics;
    const double begun = thread_seconds();
    for (size_t pixel = 0; pixel < picture.pixels(); ++pixel) {
        add_batches(tracer, 0, batches, batch_size, pixel, &picture, &statistics);
    }
    picture.seconds = thread_seconds() - begun;
    picture.rays = static_cast<double>(statistics.rays);
    return picture;
}

ReferencePicture trace_reference(const BatchTracer& tracer, const Film& film, int rows,
                                 int samples) {
    constexpr int batch_size = 16;
    ReferencePicture reference{black_picture(film, rows), black_picture(film, rows), 0};
    const int batches = std::max(1, samples / (2 * batch_size));
    reference.samples = 2 * batches * batch_size;
    parallel_for(reference.first.pixels(), 0, [&](size_t pixel) {
        PathStatistics statistics;
        add_batches(tracer, 0, batches, batch_size, pixel, &reference.first, &statistics);
        add_batches(tracer, static_cast<uint32_t>(batches), batches, batch_size, pixel,
                    &reference.second, &statistics);
    });
    return reference;
}

double relative_product(const TracedPicture& a, const TracedPicture& b,
                        const ReferencePicture& reference, int row) {
    const TracedPicture& r = reference.first;
    if (a.pixels() != r.pixels() || b.pixels() != r.pixels() || row >= r.rows || row >= a.rows ||
        row >= b.rows) {
        throw std::logic_error("relative_product: pictures of different shapes");
    }
    const auto rows = static_cast<size_t>(r.rows);
    std::vector<double> squares(r.pixels(), 0);
    double length = 0;
    for (size_t p = 0; p < r.pixels(); ++p) {
        for (size_t c = 0; c < 3; ++c) {
            const double mean = reference.mean(p * rows * 3 + c);
            squares[p] += mean * mean;
        }
        length += std::sqrt(squares[p]) / static_cast<double>(r.pixels());
    }
    const double floor = 0.01 * length * length;
    if (!(floor > 0)) return 0;
    double total = 0;
    for (size_t p = 0; p < r.pixels(); ++p) {
        double product = 0;
        for (int c = 0; c < 3; ++c) {
            product += (a.at(p, row)[c] - reference.first.at(p, row)[c]) *
                       (b.at(p, row)[c] - reference.second.at(p, row)[c]);
        }
        total += product / (squares[p] + floor);
    }
    return total / static_cast<double>(r.pixels());
}

double relative_rmse(const TracedPicture& picture, const ReferencePicture& reference, int row) {
    const double square = relative_product(picture, picture, reference, row);
    return square >= 0 ? std::sqrt(square) : std::numeric_limits<double>::quiet_NaN();
}

TransportChoice automatic_transport(const Scene& scene) {
    return transport_choice(scene, RenderOptions());
}

double mean_value(const TracedPicture& picture) {
    double total = 0;
    for (size_t p = 0; p < picture.pixels(); ++p) {
        for (int c = 0; c < 3; ++c) total += picture.at(p)[c];
    }
    return total / (3 * static_cast<double>(picture.pixels()));
}

}  // namespace drude
