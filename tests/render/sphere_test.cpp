// A metal sphere under a constant unpolarised sky: every pixel has a closed form, since each ray is
// reflected once and the sky is the same everywhere:
//   S0 = A L, S1 and S2 = B L in the tangential direction, S3 = 0.
#include <gtest/gtest.h>

#include <cmath>

#include "materials/fresnel.h"
#include "materials/optical_constants.h"
#include "test_scenes.h"

namespace drude {
namespace {

constexpr int size = 48;
const char* copper_mirror =
    "Material \"conductor\" \"string material\" \"Cu-McPeak\" \"float beta\" 0";

// S0..S3 in a spectral bin at the centre of a pixel, from the geometry of the picture alone.
bool closed_form(double px, double py, int bin, double radiance[10], double out[4]) {
    const double t = std::tan(16 * pi / 180);
    const double x = (2 * px / size - 1) * t, y = (1 - 2 * py / size) * t;
    const double length = std::sqrt(x * x + y * y + 1);
    const double d[3] = {x / length, y / length, 1 / length};
    // Nearest hit of the ray from (0, 0, -4) with the unit sphere.
    const double b = 4 * d[2], gap = b * b - 15;
    if (gap < 0) return false;
    const double s = b - std::sqrt(gap);
    const double n[3] = {s * d[0], s * d[1], s * d[2] - 4};
    const double cosine = -(n[0] * d[0] + n[1] * d[1] + n[2] * d[2]);
    double A = 0, B = 0;
    for (int i = 0; i < 10; ++i) {
        const Index index = published_set("Cu-McPeak").at(380 + 10 * bin + i);
        const auto r = reflect(ComplexIndex<double>{index.n, index.k}, cosine);
        A += r.A() * radiance[i] / 10;
        B += r.B() * radiance[i] / 10;
    }
    // The s axis is tangential: perpendicular to the direction (x, y) from the picture's centre, as
    // seen across the ray: components along horizontal = normalize(cross(d, up)) and the picture's
    // up across the ray.
    const double h[3] = {d[2], 0, -d[0]};  // cross(up, d) for up = y: horizontal, to the right
    const double hl = std::sqrt(h[0] * h[0] + h[2] * h[2]);
    const double right[3] = {h[0] / hl, 0, h[2] / hl};
    // up = d x right turned so that its y is positive.
    const double up[3] = {d[1] * right[2] - 0, d[2] * right[0] - d[0] * right[2],
                          0 - d[1] * right[0]};
    const double sx = d[1] * n[2] - d[2] * n[1], sy = d[2] * n[0] - d[0] * n[2],
                 sz = d[0] * n[1] - d[1] * n[0];
    const double along = sx * right[0] + sy * right[1] + sz * right[2];
    const double across = sx * up[0] + sy * up[1] + sz * up[2];
    const double sum = along * along + across * across;
    out[0] = A;
    out[1] = sum > 0 ? B * (along * along - across * across) / sum : 0;
    out[2] = sum > 0 ? B * 2 * along * across / sum : 0;
    out[3] = 0;
    return true;
}

void expect_closed_form(const std::string& before, const std::string& camera_flip_note) {
    SCOPED_TRACE(camera_flip_note);
    const Scene scene = sphere_under_sky(copper_mirror, size, before);
    const RenderResult result = render_quietly(scene, 64, true, true);
    const DenseSpectrum sky = rgb_illuminant({1, 1, 1});
    int compared = 0;
    for (const int bin : {0, 13, 30, 39}) {
        double radiance[10];
        for (int i = 0; i < 10; ++i) radiance[i] = sky[10 * bin + i];
        std::string names[4];
        for (int row = 0; row < 4; ++row) {
            for (const Channel& c : result.image.channels) {
                if (c.name.rfind(fmt::format("S{}.{}", row, 384 + 10 * bin), 0) == 0) {
                    names[row] = c.name;
                }
            }
            ASSERT_FALSE(names[row].empty());
        }
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                // The pixel's mean from a fine grid; pixels on the silhouette are left out.
                double mean[4] = {};
                bool inside = true;
                constexpr int grid = 12;
                for (int j = 0; j < grid * grid && inside; ++j) {
                    double value[4];
                    inside = closed_form(x + (j % grid + 0.5) / grid, y + (j / grid + 0.5) / grid,
                                         bin, radiance, value);
                    for (int i = 0; i < 4; ++i) mean[i] += value[i] / (grid * grid);
                }
                if (!inside) continue;
                const size_t pixel = static_cast<size_t>(y) * size + x;
                ++compared;
                for (int row = 0; row < 4; ++row) {
                    // Sampling noise of smooth integrands under 64 nets' points.
                    EXPECT_NEAR(result.image.find(names[row])->data[pixel] / sky[10 * bin + 5],
                                mean[row] / sky[10 * bin + 5], row == 3 ? 1e-6 : 4e-3)
                        << "pixel " << x << ", " << y << " bin " << bin << " S" << row;
                }
            }
        }
    }
    EXPECT_GT(compared, 1000);
    EXPECT_EQ(result.projections, 0u);
    EXPECT_EQ(result.not_finite, 0u);
}

TEST(Sphere, HasTheClosedFormOfAConstantSky) {
    expect_closed_form("", "ordinary left-handed world");
}

// The mirrored world shows the mirrored picture; the sphere is its own mirror image, so the same
// picture, with the same signs of polarisation, must come out.
TEST(Sphere, HasTheSameSignsInAMirroredWorld) {
    expect_closed_form("Scale -1 1 1", "right-handed world");
}

// Luminance of a Stokes layer: its R, G and B may be negative, outside Rec.709, whatever the sign
// of the spectrum.
float luminance(const Image& image, const std::string& layer, size_t pixel) {
    return 0.2126f * image.find(layer + ".R")->data[pixel] +
           0.7152f * image.find(layer + ".G")->data[pixel] +
           0.0722f * image.find(layer + ".B")->data[pixel];
}

TEST(Sphere, IsTangentiallyPolarisedUpRightOfItsCentre) {
    for (const char* before : {"", "Scale -1 1 1"}) {
        SCOPED_TRACE(before);
        const Scene scene = sphere_under_sky(copper_mirror, 16, before);
        const RenderResult result = render_quietly(scene, 16, true);
        EXPECT_LT(luminance(result.image, "S2", 4 * 16 + 11), -1e-3f);
        EXPECT_GT(luminance(result.image, "S2", 4 * 16 + 4), 1e-3f);
        // Right of the centre the tangential direction is vertical, above it horizontal.
        EXPECT_LT(luminance(result.image, "S1", 8 * 16 + 12), -1e-3f);
        EXPECT_GT(luminance(result.image, "S1", 3 * 16 + 8), 1e-3f);
    }
}

TEST(Render, GivesTheSameBitsOnAnyNumberOfThreads) {
    const Scene scene = sphere_under_sky(
        "Material \"conductor\" \"string material\" \"Au\" \"string lobe\" \"gaussian\" "
        "\"string masking\" \"v-groove\" \"float beta\" 0.2",
        40);
    const RenderResult one = render_quietly(scene, 32, true, false, 1);
    for (const int threads : {2, 3, 7}) {
        const RenderResult many = render_quietly(scene, 32, true, false, threads);
        ASSERT_EQ(one.image.channels.size(), many.image.channels.size());
        for (size_t c = 0; c < one.image.channels.size(); ++c) {
            EXPECT_EQ(one.image.channels[c].data, many.image.channels[c].data);
        }
    }
    RenderOptions other;
    other.samples_per_pixel = 32;
    other.stokes = true;
    other.seed = 99;
    other.quiet = true;
    EXPECT_NE(one.image.channels[0].data, render(scene, other).image.channels[0].data);
}

// The three transports agree where all are exact.
TEST(Render, TransportsAgreeOnAConvexMetal) {
    const Scene scene = sphere_under_sky(
        "Material \"conductor\" \"string material\" \"Al\" \"string lobe\" \"beckmann\" "
        "\"float beta\" 0.3",
        24);
    RenderOptions options;
    options.samples_per_pixel = 32;
    options.quiet = true;
    const RenderResult automatic = render(scene, options);
    EXPECT_EQ(automatic.transport, Transport::scalar);
    for (const Transport transport : {Transport::intensity, Transport::stokes}) {
        options.transport = transport;
        const RenderResult other = render(scene, options);
        for (const char* channel : {"R", "G", "B"}) {
            const auto& a = automatic.image.find(channel)->data;
            const auto& b = other.image.find(channel)->data;
            for (size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 2e-5f);
        }
    }
}

}  // namespace
}  // namespace drude
