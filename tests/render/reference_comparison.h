// Comparing the renderer's spectral layers with the reference integrator, block by block of pixels,
// within what the noise of both allows.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "image/student.h"
#include "render/reference.h"
#include "render/render.h"

namespace drude {

// S0..S3 of a few spectral bins, averaged over square blocks of pixels, with standard errors; the
// last block is the whole picture.
struct BlockMeans {
    std::vector<std::array<double, 4>> mean, variance;  // [block][bin]; variance of the mean
    double degrees = 0;                                 // of freedom behind each variance
};

inline constexpr int compared_bins[] = {2, 17, 30};  // 400-409 nm, 550-559 nm, 680-689 nm
inline constexpr size_t compared_bin_count = 3;

// The blocks that pixel (x, y) belongs to: its own and the whole picture.
inline std::array<size_t, 2> blocks_of(int x, int y, int width, int height, int size) {
    const int across = (width + size - 1) / size, down = (height + size - 1) / size;
    return {static_cast<size_t>(y / size * across + x / size), static_cast<size_t>(across * down)};
}

inline BlockMeans reference_blocks(const Scene& scene, int samples, int size,
                                   ReferenceOptions::Directions directions, uint64_t seed) {
    ReferenceOptions options;
    options.samples_per_pixel = samples;
    options.directions = directions;
    options.seed = seed;
    for (const int bin : compared_bins) {
        std::vector<double> band;
        for (int i = 0; i < 10; ++i) band.push_back(spectrum_first_nm + 10 * bin + i);
        options.bands_nm.push_back(band);
    }
    const ReferenceResult result = render_reference(scene, options);
    BlockMeans means;
    const size_t blocks = blocks_of(0, 0, result.width, result.height, size)[1] + 1;
    means.mean.resize(blocks * compared_bin_count);
    means.variance.resize(blocks * compared_bin_count);
    means.degrees = 1e4;
    std::vector<double> pixels(blocks, 0);
    for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
            for (const size_t block : blocks_of(x, y, result.width, result.height, size)) {
                ++pixels[block];
                for (size_t b = 0; b < compared_bin_count; ++b) {
                    const auto& value = result.at(x, y, static_cast<int>(b));
                    for (size_t i = 0; i < 4; ++i) {
                        means.mean[block * compared_bin_count + b][i] += value.mean[i];
                        means.variance[block * compared_bin_count + b][i] +=
                            value.standard_error[i] * value.standard_error[i];
                    }
                }
            }
        }
    }
    for (size_t k = 0; k < means.mean.size(); ++k) {
        const double n = pixels[k / compared_bin_count];
        for (size_t i = 0; i < 4; ++i) {
            means.mean[k][i] /= n;
            means.variance[k][i] /= n * n;
        }
    }
    return means;
}

// From `runs` renders that differ in their seeds alone.
inline BlockMeans rendered_blocks(const Scene& scene, Transport transport, int samples, int size,
                                  int runs) {
    BlockMeans means;
    const int width = scene.film.width, height = scene.film.height;
    const size_t blocks = blocks_of(0, 0, width, height, size)[1] + 1;
    std::vector<double> pixels(blocks, 0);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (const size_t block : blocks_of(x, y, width, height, size)) ++pixels[block];
        }
    }
    means.mean.resize(blocks * compared_bin_count);
    means.variance.resize(blocks * compared_bin_count);
    means.degrees = runs - 1;
    for (int run = 0; run < runs; ++run) {
        RenderOptions options;
        options.samples_per_pixel = samples;
        options.seed = 1000 + run;
        options.transport = transport;
        options.spectral = true;
        options.quiet = true;
        const RenderResult result = render(scene, options);
        EXPECT_EQ(result.projections, 0u);
        EXPECT_EQ(result.not_finite, 0u);
        std::vector<std::array<double, 4>> once(means.mean.size());
        for (size_t i = 0; i < (transport == Transport::stokes ? 4 : 1); ++i) {
            for (size_t b = 0; b < compared_bin_count; ++b) {
                const std::string name = fmt::format("S{}.{},500000nm", i,
                                                     spectrum_first_nm + 10 * compared_bins[b] + 4);
                const Channel& channel = result.image.at(name, "render");
                for (int y = 0; y < height; ++y) {
                    for (int x = 0; x < width; ++x) {
                        for (const size_t block : blocks_of(x, y, width, height, size)) {
                            once[block * compared_bin_count + b][i] +=
                                static_cast<double>(
                                    channel.data[static_cast<size_t>(y) * width + x]) /
                                pixels[block];
                        }
                    }
                }
            }
        }
        for (size_t k = 0; k < once.size(); ++k) {
            for (size_t i = 0; i < 4; ++i) {
                means.mean[k][i] += once[k][i] / runs;
                means.variance[k][i] += once[k][i] * once[k][i];
            }
        }
    }
    for (size_t k = 0; k < means.mean.size(); ++k) {
        for (size_t i = 0; i < 4; ++i) {
            const double spread = means.variance[k][i] - runs * means.mean[k][i] * means.mean[k][i];
            means.variance[k][i] = std::max(0.0, spread) / (runs * (runs - 1.0));
        }
    }
    return means;
}

struct Agreement {
    double p = 1;              // of the largest deviation, corrected for the number of comparisons
    double mean_square_z = 0;  // 1 where the two differ by noise alone
    int tests = 0;
    std::string worst;
};

// Two-sided Welch tests on the first `rows` Stokes components, corrected after Sidak. Differences
// below `rounding` of S0, which noise can fall short of where nothing is random, count as none.
inline Agreement agreement(const BlockMeans& a, const BlockMeans& b, size_t rows,
                           double rounding = 1e-5) {
    Agreement result;
    double smallest = 1;
    for (size_t k = 0; k < a.mean.size(); ++k) {
        for (size_t i = 0; i < rows; ++i) {
            const double gap = std::abs(a.mean[k][i] - b.mean[k][i]) - rounding * a.mean[k][0];
            ++result.tests;
            if (!(gap > 0)) continue;
            const double va = a.variance[k][i], vb = b.variance[k][i];
            const double degrees =
                va + vb > 0 ? (va + vb) * (va + vb) / (va * va / a.degrees + vb * vb / b.degrees)
                            : 1;
            const double z = va + vb > 0 ? gap / std::sqrt(va + vb) : 1e9;
            result.mean_square_z += z * z;
            const double p = student_two_sided(z, degrees);
            if (p < smallest) {
                smallest = p;
                result.worst = fmt::format("block {} bin {} S{}: {} against {}, z = {}",
                                           k / compared_bin_count, k % compared_bin_count, i,
                                           a.mean[k][i], b.mean[k][i], z);
            }
        }
    }
    result.p = sidak_family(smallest, result.tests);
    result.mean_square_z /= result.tests;
    return result;
}

inline void expect_agreement(const BlockMeans& rendered, const BlockMeans& reference, size_t rows) {
    const Agreement result = agreement(rendered, reference, rows);
    EXPECT_GT(result.p, 1e-3) << result.tests << " tests; " << result.worst;
    EXPECT_LT(result.mean_square_z, 1.5) << result.tests << " tests; " << result.worst;
    testing::Test::RecordProperty("family_p", fmt::format("{:.3g}", result.p));
    testing::Test::RecordProperty("mean_square_z", fmt::format("{:.3f}", result.mean_square_z));
}

}  // namespace drude
