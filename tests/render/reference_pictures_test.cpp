// The reference pictures of tests/references show what the reference integrator finds: `drude
// regress` compares the renderer with itself, and this with something slow and obviously right.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "image/image.h"
#include "image/noise_test.h"
#include "render/reference.h"

namespace drude {
namespace {

constexpr int band_width_nm = 5;

// Linear R, G or B of a spectrum given as the means over bands of five wavelengths.
std::vector<double> colour_weights(size_t colour) {
    std::vector<double> weights(spectrum_integral_size / band_width_nm, 0.0);
    const auto& to_rgb = rgb_from_xyz();
    for (size_t nm = 0; nm < static_cast<size_t>(spectrum_integral_size); ++nm) {
        const double xyz[3] = {cie1931().x[nm], cie1931().y[nm], cie1931().z[nm]};
        for (size_t k = 0; k < 3; ++k) weights[nm / band_width_nm] += to_rgb[colour][k] * xyz[k];
    }
    return weights;
}

ReferenceResult integrate(const Scene& scene, int samples) {
    ReferenceOptions options;
    options.samples_per_pixel = samples;
    options.seed = 5;
    for (int first = 0; first < spectrum_integral_size; first += band_width_nm) {
        std::vector<double> band;
        for (int i = 0; i < band_width_nm; ++i) band.push_back(spectrum_first_nm + first + i);
        options.bands_nm.push_back(band);
    }
    return render_reference(scene, options);
}

// The largest deviation of a block's mean in standard errors, beyond what the step from bands to
// colours may make: 5e-4 of S0, since a colour is a weighted mean within each band and the
// integrator's is not.
double largest_deviation(const std::string& name, const std::string& scene_path, int samples,
                         std::string* where) {
    const std::string folder = DRUDE_SOURCE_DIR "/tests/references/";
    const Scene scene = read_scene(folder + scene_path);
    const Image picture = read_exr(folder + name + ".exr");
    const ReferenceResult slow = integrate(scene, samples);
    EXPECT_EQ(slow.width, picture.width);
    EXPECT_EQ(slow.height, picture.height);
    constexpr int side = 8;
    double largest = 0;
    for (size_t component = 0; component < 4; ++component) {
        for (size_t colour = 0; colour < 3; ++colour) {
            const std::string channel = fmt::format("S{}.{}", component, "RGB"[colour]);
            const std::vector<double> weights = colour_weights(colour);
            const auto& mean = picture.at(channel, name).data;
            const auto& variance = picture.at(variance_name(channel), name).data;
            for (int by = 0; by < picture.height; by += side) {
                for (int bx = 0; bx < picture.width; bx += side) {
                    double difference = 0, squares = 0, s0 = 0;
                    for (int y = by; y < std::min(picture.height, by + side); ++y) {
                        for (int x = bx; x < std::min(picture.width, bx + side); ++x) {
                            const size_t p = static_cast<size_t>(y) * picture.width + x;
                            double value = 0, error = 0;
                            for (size_t b = 0; b < weights.size(); ++b) {
                                const auto& band = slow.at(x, y, static_cast<int>(b));
                                value += weights[b] * band.mean[component];
                                // Bands share their paths: errors add, at worst, and not squares.
                                error += std::abs(weights[b]) * band.standard_error[component];
                                s0 += std::abs(weights[b]) * band.mean[0];
                            }
                            difference += static_cast<double>(mean[p]) - value;
                            squares += static_cast<double>(variance[p]) + error * error;
                        }
                    }
                    const double z = (std::abs(difference) - 5e-4 * s0) / std::sqrt(squares);
                    if (z > largest) {
                        largest = z;
                        *where = fmt::format("{} at ({}, {}): {}", channel, bx, by, difference);
                    }
                }
            }
        }
    }
    return largest;
}

// 108 block means a picture: 4.5 standard errors are a probability of 1e-3 for each picture, less
// for errors that were taken at their worst.
void expect_agreement_of(const std::string& name, const std::string& scene, int samples) {
    std::string where;
    const double z = largest_deviation(name, scene, samples, &where);
    EXPECT_LT(z, 4.5) << name << ": " << where;
    testing::Test::RecordProperty("largest_z", fmt::format("{:.2f}", z));
}

TEST(ReferencePictures, MirrorsAreTheIntegrators) {
    expect_agreement_of("Cu-McPeak", "metals/Cu-McPeak.pbrt", 64);
}

TEST(ReferencePictures, RoughMetalIsTheIntegrators) {
    expect_agreement_of("beckmann-smith-0.15", "lobes/beckmann-smith-0.15.pbrt", 96);
}

TEST(ReferencePictures, FilmsAreTheIntegrators) {
    expect_agreement_of("two-layers", "films/two-layers.pbrt", 32);
}

TEST(ReferencePictures, FittedSamplesAreTheIntegrators) {
    expect_agreement_of("Al-oxide-fitted", "fitted/Al-oxide-fitted.pbrt", 64);
}

// Another publication's copper, and another width of the lobe.
TEST(ReferencePictures, OtherMaterialsAreNot) {
    std::string where;
    EXPECT_GT(largest_deviation("Cu-McPeak", "metals/Cu-Johnson.pbrt", 16, &where), 20);
    EXPECT_GT(largest_deviation("beckmann-smith-0.15", "lobes/beckmann-smith-0.4.pbrt", 64, &where),
              6);
}

}  // namespace
}  // namespace drude
