#include "image/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace drude {
namespace {

// As in tests/oracles/flip.py: waves, an edge and a point; the second shifted, tinted and dimmed.
// An HDR picture spans a range of `gain`.
struct Pair {
    Picture first, second;
};
Pair pictures(int width, int height, double gain) {
    Pair pair = {Picture(width, height, {}), Picture(width, height, {})};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const double scale = std::pow(gain, x / (width - 1.0));
            Colour a{}, b{};
            for (int c = 0; c < 3; ++c) {
                const double wave = std::cos(0.23 * y - 0.4 * c);
                double first = 0.5 + 0.4 * std::sin(0.31 * x + 0.1 * c) * wave;
                double second = 0.48 + 0.4 * std::sin(0.31 * x + 0.1 * c + 0.15) * wave;
                if (c == 2) second *= 0.9;
                if (x >= width / 2) second *= 0.85;
                if (x == width / 3 && y == height / 3) second = 1.0;
                const size_t channel = static_cast<size_t>(c);
                a[channel] = static_cast<float>(first * scale);
                b[channel] = static_cast<float>(second * scale);
            }
            pair.first.set(x, y, a);
            pair.second.set(x, y, b);
        }
    }
    return pair;
}

double at(const FlipResult& result, int width, int x, int y) {
    return result
        .error[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
}

// Numbers of the authors' own program (flip-evaluator 1.7, NVIDIA; in float), which
// tests/oracles/flip.py prints: the mean, and the error at three pixels.
void expect_oracle(const FlipResult& result, double mean, double third, double corner,
                   double middle) {
    EXPECT_NEAR(result.mean, mean, 2e-5);
    EXPECT_NEAR(at(result, 48, 16, 10), third, 2e-4);
    EXPECT_NEAR(at(result, 48, 0, 0), corner, 2e-4);
    EXPECT_NEAR(at(result, 48, 24, 16), middle, 2e-4);
}

TEST(Flip, LdrIsTheAuthorsProgram) {
    const Pair pair = pictures(48, 32, 1.0);
    expect_oracle(flip_ldr(pair.second, pair.first), 0.3022790, 0.1885908, 0.2733399, 0.3146567);
    FlipOptions coarse;
    coarse.pixels_per_degree = 20.0;
    expect_oracle(flip_ldr(pair.second, pair.first, coarse), 0.2773586, 0.6621128, 0.2438163,
                  0.3189867);
}

TEST(Flip, HdrIsTheAuthorsProgram) {
    Pair pair = pictures(48, 32, 1000.0);
    const FlipResult result = flip_hdr(pair.second, pair.first);
    EXPECT_NEAR(result.start_exposure, -8.629611015319824, 1e-5);
    EXPECT_NEAR(result.stop_exposure, -2.6835498809814453, 1e-4);
    EXPECT_EQ(result.exposures, 6);
    expect_oracle(result, 0.2438181, 0.1444243, 0.1337856, 0.4013186);
    // A reference whose median is black.
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 30; ++x) {
            pair.first.set(x, y, {});
            pair.second.set(x, y, {});
        }
    }
    const FlipResult dark = flip_hdr(pair.second, pair.first);
    EXPECT_NEAR(dark.stop_exposure, 24.083297729492188, 1e-4);
    EXPECT_EQ(dark.exposures, 33);
    expect_oracle(dark, 0.1236598, 0.0, 0.0, 0.0050962);
}

TEST(Flip, EqualPicturesDoNotFlicker) {
    const Pair pair = pictures(20, 13, 100.0);
    EXPECT_EQ(flip_ldr(pair.first, pair.first).mean, 0.0);
    EXPECT_EQ(flip_hdr(pair.first, pair.first).mean, 0.0);
}

// Green against blue is the largest distance of colours there is, and plain areas have no features.
TEST(Flip, GreenAgainstBlueIsOne) {
    const Picture green(40, 40, {0.0F, 1.0F, 0.0F}), blue(40, 40, {0.0F, 0.0F, 1.0F});
    const FlipResult result = flip_ldr(green, blue);
    for (const double error : result.error) EXPECT_NEAR(error, 1.0, 1e-9);
}

TEST(Flip, DoesNotDependOnThreadsNorOnWhatIsNoNumber) {
    Pair pair = pictures(31, 17, 10.0);
    pair.second.rgb[40] = std::nanf("");
    FlipOptions one, three;
    one.threads = 1;
    three.threads = 3;
    const FlipResult a = flip_hdr(pair.second, pair.first, one);
    EXPECT_EQ(a.error, flip_hdr(pair.second, pair.first, three).error);
    EXPECT_TRUE(
        std::all_of(a.error.begin(), a.error.end(), [](double e) { return e >= 0.0 && e <= 1.0; }));
}

TEST(Flip, ABlackReferenceHasOneExposure) {
    const Picture black(8, 8, {}), grey(8, 8, {0.5F, 0.5F, 0.5F});
    const FlipResult result = flip_hdr(grey, black);
    EXPECT_EQ(result.exposures, 1);
    EXPECT_GT(result.mean, 0.1);
    EXPECT_THROW(flip_ldr(grey, Picture(8, 9, {})), std::logic_error);
}

}  // namespace
}  // namespace drude
