#include "image/tonemap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace drude {
namespace {

using Values = std::vector<float>;
constexpr int width = 60, height = 40;

// A dark and a bright half with a fine pattern of 10 % on both, of one hue.
Values two_halves(double dark, double bright) {
    Values rgb;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const double value = (x < width / 2 ? dark : bright) * ((x + y) % 2 ? 1.1 : 0.9);
            rgb.push_back(static_cast<float>(value * 2.0));
            rgb.push_back(static_cast<float>(value));
            rgb.push_back(static_cast<float>(value * 0.5));
        }
    }
    return rgb;
}

double intensity(const Values& rgb, int x, int y) {
    const size_t i = 3 * static_cast<size_t>(y * width + x);
    return (20.0 * static_cast<double>(rgb[i]) + 40.0 * static_cast<double>(rgb[i + 1]) +
            static_cast<double>(rgb[i + 2])) /
           61.0;
}

double log_mean(const Values& rgb, int x0, int x1) {
    double sum = 0.0;
    for (int y = 0; y < height; ++y) {
        for (int x = x0; x < x1; ++x) sum += std::log10(intensity(rgb, x, y));
    }
    return sum / (height * (x1 - x0));
}

TEST(Durand, BaseIsCompressedToTheContrastAskedFor) {
    const Values rgb = two_halves(0.01, 100.0);
    for (const double contrast : {5.0, 50.0}) {
        DurandOptions options;
        options.contrast = contrast;
        const DurandParameters parameters = durand_parameters(width, height, rgb, options);
        EXPECT_NEAR(parameters.compression, std::log10(contrast) / 4.0, 0.01);
        const Values out = tonemap_durand(width, height, rgb, parameters, options);
        EXPECT_NEAR(log_mean(out, 32, 60) - log_mean(out, 0, 28), std::log10(contrast), 0.03);
        // The brightest base is white.
        EXPECT_NEAR(log_mean(out, 32, 60), 0.0, 0.02);
    }
}

TEST(Durand, DetailAndColourStay) {
    const Values rgb = two_halves(0.01, 100.0);
    const DurandOptions options;
    const DurandParameters parameters = durand_parameters(width, height, rgb, options);
    ASSERT_LT(parameters.compression, 0.5);
    const Values out = tonemap_durand(width, height, rgb, parameters, options);
    for (const int x : {10, 50}) {
        // The pattern's contrast, 1.1 against 0.9, comes through; the whole would have become
        // (1.1/0.9)^compression.
        EXPECT_NEAR(intensity(out, x, 21) / intensity(out, x, 20), 1.1 / 0.9, 0.01);
        const size_t i = 3 * static_cast<size_t>(20 * width + x);
        EXPECT_NEAR(out[i] / out[i + 1], 2.0, 1e-5);
        EXPECT_NEAR(out[i + 2] / out[i + 1], 0.5, 1e-5);
    }
}

TEST(Durand, PictureThatFitsIsOnlyScaled) {
    const Values rgb = two_halves(1.0, 10.0);
    const DurandOptions options;
    const DurandParameters parameters = durand_parameters(width, height, rgb, options);
    EXPECT_EQ(parameters.compression, 1.0);
    const Values out = tonemap_durand(width, height, rgb, parameters, options);
    const float scale = out[0] / rgb[0];
    for (size_t i = 0; i < rgb.size(); ++i) ASSERT_NEAR(out[i] / rgb[i], scale, 1e-4F * scale);
}

TEST(Durand, ExactFilterGivesThePictureOfTheGrid) {
    const Values rgb = two_halves(0.01, 100.0);
    DurandOptions grid, exact;
    exact.exact = true;
    const DurandParameters from_grid = durand_parameters(width, height, rgb, grid);
    const DurandParameters from_exact = durand_parameters(width, height, rgb, exact);
    EXPECT_NEAR(from_grid.compression, from_exact.compression, 0.01);
    EXPECT_NEAR(from_grid.max_base, from_exact.max_base, 0.04 * 0.4);
    const Values a = tonemap_durand(width, height, rgb, from_exact, grid);
    const Values b = tonemap_durand(width, height, rgb, from_exact, exact);
    for (size_t i = 0; i < a.size(); ++i) {
        // The base's error of at most 0.04 x 0.4 enters times 1 - compression.
        ASSERT_NEAR(std::log10(a[i]), std::log10(b[i]), 0.04 * 0.4);
    }
}

TEST(Durand, ParametersOfAnotherPictureKeepEqualPixelsEqual) {
    const DurandOptions options;
    const Values reference = two_halves(0.01, 100.0);
    Values other = reference;
    // The other picture has a much brighter region in a corner, far from the pixel that is looked
    // at.
    for (int y = 0; y < 6; ++y) {
        for (int x = 54; x < width; ++x) {
            for (int c = 0; c < 3; ++c) other[3 * static_cast<size_t>(y * width + x) + c] = 5e3F;
        }
    }
    const DurandParameters own = durand_parameters(width, height, reference, options);
    const DurandParameters others = durand_parameters(width, height, other, options);
    EXPECT_LT(others.compression, own.compression);
    const Values a = tonemap_durand(width, height, reference, own, options);
    const Values shared = tonemap_durand(width, height, other, own, options);
    const Values separate = tonemap_durand(width, height, other, others, options);
    EXPECT_NEAR(intensity(shared, 40, 30) / intensity(a, 40, 30), 1.0, 0.01);
    EXPECT_LT(intensity(separate, 40, 30) / intensity(a, 40, 30), 0.5);
}

TEST(Durand, BlackPixelsFirefliesAndNoNumbersDoNotSetTheCompression) {
    DurandOptions options;
    Values rgb = two_halves(0.1, 100.0);
    const double before = durand_parameters(width, height, rgb, options).compression;
    for (int y = 0; y < 20; ++y) {
        for (int c = 0; c < 3 * 20; ++c) rgb[static_cast<size_t>(3 * y * width + c)] = 0.0F;
    }
    rgb[3 * (30 * width + 50)] = std::numeric_limits<float>::quiet_NaN();
    rgb[3 * (31 * width + 50)] = std::numeric_limits<float>::infinity();
    rgb[3 * (32 * width + 50)] = -1e9F;
    EXPECT_NEAR(durand_parameters(width, height, rgb, options).compression, before, 0.03);
    Values firefly = two_halves(0.1, 100.0);
    for (int c = 0; c < 3; ++c) firefly[static_cast<size_t>(3 * (20 * width + 15) + c)] = 1e9F;
    EXPECT_NEAR(durand_parameters(width, height, firefly, options).compression, before, 0.03);
    const Values out =
        tonemap_durand(width, height, rgb, durand_parameters(width, height, rgb, options), options);
    EXPECT_TRUE(std::all_of(out.begin(), out.end(), [](float v) { return std::isfinite(v); }));
    EXPECT_EQ(out[0], 0.0F);
}

TEST(Durand, AllBlackStaysBlack) {
    const Values black(3 * width * height, 0.0F);
    const DurandOptions options;
    const DurandParameters parameters = durand_parameters(width, height, black, options);
    EXPECT_EQ(parameters.compression, 1.0);
    EXPECT_EQ(tonemap_durand(width, height, black, parameters, options), black);
}

TEST(Durand, SameBitsForAnyNumberOfThreads) {
    const Values rgb = two_halves(0.01, 100.0);
    DurandOptions one, three;
    one.threads = 1;
    three.threads = 3;
    const DurandParameters parameters = durand_parameters(width, height, rgb, one);
    EXPECT_EQ(tonemap_durand(width, height, rgb, parameters, one),
              tonemap_durand(width, height, rgb, parameters, three));
}

TEST(Linear, ExposureCountsStops) {
    EXPECT_EQ(expose({0.25F, 1.0F, -2.0F}, 2.0), (Values{1.0F, 4.0F, -8.0F}));
    EXPECT_EQ(expose({0.25F}, -1.0), Values{0.125F});
}

TEST(Durand, RefusesAWrongSize) {
    EXPECT_THROW(durand_parameters(2, 2, Values(11), {}), std::logic_error);
    EXPECT_THROW(tonemap_durand(0, 0, Values(), {}, {}), std::logic_error);
}

}  // namespace
}  // namespace drude
