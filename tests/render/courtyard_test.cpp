#include "render/courtyard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "base/error.h"

namespace drude {
namespace {

struct Texel {
    double r, g, b;
    double luminance() const { return 0.2126 * r + 0.7152 * g + 0.0722 * b; }
};

Texel at(const Image& image, int x, int y) {
    const size_t i = static_cast<size_t>(y) * static_cast<size_t>(image.width) + x;
    return {image.channels[0].data[i], image.channels[1].data[i], image.channels[2].data[i]};
}

// The texel that a unit direction falls in, by the convention of the header.
Texel towards(const Image& image, double x, double y, double z) {
    const double theta = std::acos(z / std::sqrt(x * x + y * y + z * z));
    double phi = std::atan2(y, x);
    if (phi < 0) phi += 2 * std::numbers::pi;
    const int column = static_cast<int>(phi / (2 * std::numbers::pi) * image.width);
    const int row = static_cast<int>(theta / std::numbers::pi * image.height);
    return at(image, std::min(column, image.width - 1), std::min(row, image.height - 1));
}

struct Statistics {
    double mean = 0, max = 0, mean_r = 0, mean_b = 0;
};

Statistics statistics(const Image& image) {
    Statistics s;
    double weights = 0;
    for (int y = 0; y < image.height; ++y) {
        // The exact solid angle of a row, up to a factor.
        const double step = std::numbers::pi / image.height;
        const double weight = std::cos(step * y) - std::cos(step * (y + 1));
        for (int x = 0; x < image.width; ++x) {
            const Texel t = at(image, x, y);
            s.mean += weight * t.luminance();
            s.mean_r += weight * t.r;
            s.mean_b += weight * t.b;
            s.max = std::max(s.max, t.luminance());
            weights += weight;
        }
    }
    s.mean /= weights;
    s.mean_r /= weights;
    s.mean_b /= weights;
    return s;
}

const Image& courtyard_96() {
    static const Image image = make_courtyard(96);
    return image;
}

TEST(Courtyard, IsALatLongPictureOfPositiveRadiance) {
    const Image& image = courtyard_96();
    EXPECT_EQ(image.width, 192);
    EXPECT_EQ(image.height, 96);
    ASSERT_EQ(image.channels.size(), 3u);
    EXPECT_EQ(image.channels[0].name, "R");
    EXPECT_EQ(image.channels[1].name, "G");
    EXPECT_EQ(image.channels[2].name, "B");
    for (const Channel& channel : image.channels) {
        ASSERT_EQ(channel.data.size(), image.pixels());
        for (const float value : channel.data) {
            ASSERT_TRUE(std::isfinite(value));
            ASSERT_GT(value, 0.0f);
        }
    }
}

TEST(Courtyard, HasTheStatisticsOfTheUffiziProbeAtEveryHeight) {
    for (const int height : {16, 33, 96}) {
        const Image image = make_courtyard(height);
        const Statistics s = statistics(image);
        EXPECT_NEAR(s.mean, 0.9, 0.009) << height;
        EXPECT_NEAR(s.max / s.mean, 16.0, 0.16) << height;
        // The probe's solid-angle means are (0.89, 0.86, 0.98).
        EXPECT_NEAR(s.mean_r, 0.888, 0.0888) << height;
        EXPECT_NEAR(s.mean_b, 0.979, 0.0979) << height;
    }
}

TEST(Courtyard, StandsAsTheHeaderSays) {
    const Image& image = courtyard_96();
    const double sky = towards(image, 0.3, 0.0, 1.0).luminance();
    // Bright along the long axis overhead, façades where the short axis is.
    EXPECT_GT(sky, 2.0);
    EXPECT_GT(towards(image, -1.0, 0.0, 0.9).luminance(), 2.0);
    EXPECT_LT(towards(image, 0.0, 1.0, 0.9).luminance(), 1.2);
    EXPECT_LT(towards(image, 0.0, -1.0, 0.9).luminance(), 1.2);
    // The sun stands behind the clouds towards -x.
    EXPECT_GT(towards(image, -0.36, 0.06, 1.0).luminance(), 1.5 * sky);
    // The arch is open towards -x, the gate closed towards +x.
    EXPECT_GT(towards(image, -1.0, 0.0, 0.12).luminance(),
              4 * towards(image, 1.0, 0.0, 0.02).luminance());
    // Bluish sky, warm stone.
    const Texel zenith = towards(image, 0.5, 0.0, 1.0);
    EXPECT_GT(zenith.b, 1.1 * zenith.r);
    const Texel stone = towards(image, 0.28, 1.0, 0.62);
    EXPECT_GT(stone.r, 1.1 * stone.b);
    // The galleries lie in shade.
    EXPECT_LT(towards(image, 0.05, 1.0, 0.1).luminance(),
              0.5 * towards(image, 0.28, 1.0, 0.62).luminance());
}

TEST(Courtyard, PavingHasJoints) {
    const Image image = make_courtyard(256);
    // Straight along a ring below the horizon there must be both joints and slabs.
    double darkest = 1e9, brightest = 0;
    for (int x = 0; x < image.width; ++x) {
        const double luminance = at(image, x, 190).luminance();
        darkest = std::min(darkest, luminance);
        brightest = std::max(brightest, luminance);
    }
    EXPECT_LT(darkest, 0.75 * brightest);
}

TEST(Courtyard, DoesNotDependOnTheNumberOfThreads) {
    const Image one = make_courtyard(40, 1), many = make_courtyard(40, 7);
    for (size_t c = 0; c < 3; ++c) {
        ASSERT_EQ(one.channels[c].data.size(), many.channels[c].data.size());
        EXPECT_EQ(std::memcmp(one.channels[c].data.data(), many.channels[c].data.data(),
                              one.channels[c].data.size() * sizeof(float)),
                  0);
    }
}

TEST(Courtyard, RefusesImpossibleHeights) {
    for (const int height : {-1, 0, 15, 8193}) {
        try {
            make_courtyard(height);
            FAIL() << height;
        } catch (const Error& error) {
            EXPECT_EQ(error.cause(), Cause::user);
            EXPECT_NE(error.message().find(std::to_string(height)), std::string::npos);
        }
    }
}

}  // namespace
}  // namespace drude
