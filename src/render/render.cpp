#include "render/render.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/executor.h"
#include "base/interrupt.h"
#include "base/progress.h"
#include "render/batch_tracer.h"
#include "render/transport_choice.h"

namespace drude {

namespace {

constexpr int tile_size = 16;

// Per-pixel sums over batches, in batch order; and of squares, for the variance between batches.
struct FilmSums {
    int rows;
    std::vector<int> batches;          // [pixel]; an interrupt leaves some pixels with more
    std::vector<double> sum, squares;  // [pixel][row][c]
    std::vector<float> spectral;       // [row][bin][pixel]

    FilmSums(size_t pixels, int rows_, bool with_spectral)
        : rows(rows_),
          batches(pixels, 0),
          sum(pixels * rows_ * 3),
          squares(pixels * rows_ * 3),
          spectral(with_spectral ? pixels * rows_ * spectral_bins : 0) {}

    void add(size_t pixel, size_t pixels, const BatchResult& batch) {
        ++batches[pixel];
        for (int i = 0; i < rows; ++i) {
            for (int c = 0; c < 3; ++c) {
                const size_t at = (pixel * rows + i) * 3 + c;
                sum[at] += batch.rgb[i][c];
                squares[at] += batch.rgb[i][c] * batch.rgb[i][c];
            }
            if (spectral.empty()) continue;
            for (int b = 0; b < spectral_bins; ++b) {
                spectral[(static_cast<size_t>(i) * spectral_bins + b) * pixels + pixel] +=
                    batch.spectral[i][b];
            }
        }
    }
};

// The size of a batch: 16, or less for very few samples, so that there are two to compare.
int batch_size_for(int samples) {
    int size = 16;
    while (size > 1 && size * 2 > samples) size /= 2;
    return size;
}

std::string spectral_channel(int row, int bin) {
    // A bin of ten 1 nm samples, each standing for half a nanometre on either side.
    const double centre = spectrum_first_nm + 10 * bin + 4.5;
    std::string name = fmt::format("S{}.{:.6f}nm", row, centre);
    std::replace(name.begin() + 3, name.end() - 2, '.', ',');
    return name;
}

// `fewest` batches of any pixel.
void fill_image(const FilmSums& sums, int fewest, bool stokes, Image* image) {
    const size_t pixels = image->pixels();
    const auto add_colour = [&](const std::string& prefix, int row) {
        for (int c = 0; c < 3; ++c) {
            Channel& channel = image->add(prefix + "RGB"[c]);
            for (size_t p = 0; p < pixels; ++p) {
                channel.data[p] =
                    static_cast<float>(sums.sum[(p * sums.rows + row) * 3 + c] / sums.batches[p]);
            }
        }
        if (fewest < 2) return;
        for (int c = 0; c < 3; ++c) {
            Channel& channel = image->add("variance." + prefix + "RGB"[c]);
            for (size_t p = 0; p < pixels; ++p) {
                const size_t at = (p * sums.rows + row) * 3 + c;
                const int batches = sums.batches[p];
                const double mean = sums.sum[at] / batches;
                const double spread = sums.squares[at] / batches - mean * mean;
                channel.data[p] = static_cast<float>(std::max(0.0, spread) / (batches - 1));
            }
        }
    };
    add_colour("", 0);
    if (stokes) {
        for (int row = 0; row < 4; ++row) add_colour(fmt::format("S{}.", row), row);
    }
    if (sums.spectral.empty()) return;
    for (int row = 0; row < sums.rows; ++row) {
        for (int b = 0; b < spectral_bins; ++b) {
            Channel& channel = image->add(spectral_channel(row, b));
            const float* bin =
                &sums.spectral[(static_cast<size_t>(row) * spectral_bins + b) * pixels];
            for (size_t p = 0; p < pixels; ++p) {
                channel.data[p] = bin[p] / static_cast<float>(sums.batches[p]);
            }
        }
    }
    image->attributes["spectralLayoutVersion"] = std::string("1.0");
    image->attributes["emissiveUnits"] = std::string("W.m^-2.sr^-1");
    if (sums.rows == 4) image->attributes["polarisationHandedness"] = std::string("right");
}

void check_options(const RenderOptions& options) {
    if (options.stokes && options.transport && *options.transport != Transport::stokes) {
        user_error("S0..S3 are asked for, but the transport '{}' does not carry them; use 'stokes'",
                   transport_name(*options.transport));
    }
    if (options.samples_per_pixel && *options.samples_per_pixel < 1) {
        user_error("{} samples per pixel; expected at least 1", *options.samples_per_pixel);
    }
    const int n = options.wavelengths;
    if (n != 0 && n != 4 && n != 8 && n != 16 && n != spectral_bins) {
        user_error("{} wavelengths a path; expected 4, 8, 16 or {}", n, spectral_bins);
    }
    if (options.spectral && n != 0 && n != spectral_bins) {
        user_error("spectral layers need all {} wavelengths a path, not {}", spectral_bins, n);
    }
}

}  // namespace

RenderResult render(const Scene& scene, const RenderOptions& options) {
    check_options(options);
    RenderResult result;
    result.warnings = scene.warnings;

    const bool wants_stokes =
        options.stokes || (options.transport && *options.transport == Transport::stokes);
    if (wants_stokes) {
        result.transport = Transport::stokes;
        result.transport_reason = "S0..S3 are wanted";
    } else if (options.transport) {
        result.transport = *options.transport;
        result.transport_reason = "asked for";
    } else {
        const TransportChoice choice = cheapest_exact_transport(scene, scene.max_depth);
        result.transport = choice.transport;
        result.transport_reason = choice.reason;
    }
    result.wavelengths =
        options.wavelengths ? options.wavelengths : (options.spectral ? spectral_bins : 8);

    const int wanted = options.samples_per_pixel.value_or(scene.samples_per_pixel);
    result.batch_size = batch_size_for(wanted);
    const int batches = (wanted + result.batch_size - 1) / result.batch_size;

    const Geometry geometry(scene, options.isa);
    const OpticalElements elements(scene, options.isa);
    const Lights lights(scene, geometry);
    result.warnings.insert(result.warnings.end(), lights.warnings().begin(),
                           lights.warnings().end());
    if (lights.empty()) result.warnings.push_back("the scene has no light; the picture is black");
    const CameraRays camera(scene.camera, scene.film.width, scene.film.height);
    const PixelFilter filter(scene.filter);
    const auto tracer = make_batch_tracer(result.transport, result.wavelengths,
                                          {scene, geometry, lights, elements, camera, filter,
                                           options.seed.value_or(scene.seed), scene.max_depth});

    const int width = scene.film.width, height = scene.film.height;
    const size_t pixels = static_cast<size_t>(width) * static_cast<size_t>(height);
    const bool stokes = result.transport == Transport::stokes;
    FilmSums sums(pixels, stokes ? 4 : 1, options.spectral);
    const int tiles_x = (width + tile_size - 1) / tile_size;
    const int tiles_y = (height + tile_size - 1) / tile_size;
    const size_t tiles = static_cast<size_t>(tiles_x) * tiles_y;
    std::vector<PathStatistics> statistics(tiles);

    // A few passes over the whole picture, each of whole batches: an interrupt then leaves a
    // complete picture of fewer samples, a few tiles of which may hold more.
    const int passes = std::min(batches, 4);
    Progress progress("render", tiles * passes, options.quiet);
    const auto start = std::chrono::steady_clock::now();
    for (int pass = 0; pass < passes; ++pass) {
        const int first = batches * pass / passes, last = batches * (pass + 1) / passes;
        const bool may_stop = pass > 0;
        parallel_for(tiles, options.threads, [&](size_t tile) {
            if (may_stop && interrupted()) return;
            const int x0 = static_cast<int>(tile % tiles_x) * tile_size;
            const int y0 = static_cast<int>(tile / tiles_x) * tile_size;
            BatchResult batch;
            for (int y = y0; y < std::min(height, y0 + tile_size); ++y) {
                for (int x = x0; x < std::min(width, x0 + tile_size); ++x) {
                    const size_t pixel = static_cast<size_t>(y) * width + x;
                    for (int b = first; b < last; ++b) {
                        tracer->trace({x, y, static_cast<uint32_t>(b), result.batch_size}, &batch,
                                      &statistics[tile]);
                        sums.add(pixel, pixels, batch);
                    }
                }
            }
            progress.step();
        });
        if (interrupted()) {
            result.interrupted = true;
            break;
        }
    }
    result.render_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (const PathStatistics& s : statistics) {
        result.rays += s.rays;
        result.projections += s.projections;
        result.not_finite += s.not_finite;
    }
    result.batches = *std::min_element(sums.batches.begin(), sums.batches.end());
    result.samples_per_pixel = result.batches * result.batch_size;
    if (result.projections > 0) {
        result.warnings.push_back(fmt::format(
            "{} contributions were outside the cone of physical light by more than rounding; "
            "please report this as a bug",
            result.projections));
    }
    if (result.not_finite > 0) {
        result.warnings.push_back(
            fmt::format("{} contributions were not numbers and were dropped; please report this "
                        "as a bug",
                        result.not_finite));
    }

    Image& image = result.image;
    image.width = width;
    image.height = height;
    fill_image(sums, result.batches, stokes, &image);
    image.attributes["seed"] = fmt::format("{}", options.seed.value_or(scene.seed));
    image.attributes["samples"] = result.samples_per_pixel;
    image.attributes["sampleRange"] = fmt::format("0:{}", result.samples_per_pixel);
    image.attributes["batches"] = result.batches;
    image.attributes["batchSize"] = result.batch_size;
    image.attributes["sceneHash"] = scene.sha256;
    image.attributes["transport"] = std::string(transport_name(result.transport));
    image.attributes["wavelengths"] = result.wavelengths;
    image.attributes["instructionSet"] = fmt::format("{}/{}", DRUDE_ISA, geometry.isa());
    image.attributes["drudeVersion"] = std::string(DRUDE_VERSION);
    return result;
}

}  // namespace drude
