// The film's sums: the same in any order and grouping, and those of the terms.
#include "render/film_sums.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "render/batch_tracer.h"

namespace drude {
namespace {

FilmLayout layout_of(int pixels, int rows, bool spectral) {
    FilmLayout layout;
    layout.width = pixels;
    layout.height = 1;
    layout.rows = rows;
    layout.spectral = spectral;
    return layout;
}

// Values of magnitudes between 2^-span and 2^span, some zero, both signs.
std::vector<BatchResult> random_batches(int count, int span, uint32_t seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> mantissa(-1, 1);
    std::uniform_int_distribution<int> exponent(-span, span);
    const auto value = [&] {
        return exponent(generator) % 11 == 0 ? 0.0
                                             : std::ldexp(mantissa(generator), exponent(generator));
    };
    std::vector<BatchResult> batches(static_cast<size_t>(count));
    for (BatchResult& batch : batches) {
        for (auto& row : batch.rgb) {
            for (double& v : row) v = value();
        }
        for (auto& row : batch.spectral) {
            for (float& v : row) v = static_cast<float>(value());
        }
    }
    return batches;
}

std::vector<uint32_t> words_of(const FilmSums& sums, size_t pixel) {
    std::vector<uint32_t> words(sums.layout().words());
    sums.to_words(pixel, words.data());
    return words;
}

TEST(FilmSums, AreTheSameInAnyOrderAndGrouping) {
    std::mt19937 generator(5);
    for (const int span : {0, 3, 20, 100}) {
        for (const bool spectral : {false, true}) {
            std::vector<BatchResult> batches =
                random_batches(40, span, static_cast<uint32_t>(span));
            FilmSums straight(layout_of(1, 4, spectral));
            for (const BatchResult& batch : batches) ASSERT_TRUE(straight.add(0, batch));
            const std::vector<uint32_t> expected = words_of(straight, 0);
            for (int turn = 0; turn < 30; ++turn) {
                std::shuffle(batches.begin(), batches.end(), generator);
                FilmSums parts(layout_of(4, 4, spectral));
                for (const BatchResult& batch : batches) {
                    ASSERT_TRUE(parts.add(generator() % 4, batch));
                }
                FilmSums whole(layout_of(1, 4, spectral));
                for (const size_t part : {2, 0, 3, 1}) ASSERT_TRUE(whole.add(0, parts, part));
                ASSERT_EQ(words_of(whole, 0), expected) << span << " " << spectral;
            }
        }
    }
}

TEST(FilmSums, AreThoseOfTheirTerms) {
    for (const int span : {0, 1, 12, 60}) {
        const std::vector<BatchResult> batches = random_batches(100, span, 9);
        FilmSums sums(layout_of(1, 4, true));
        for (const BatchResult& batch : batches) sums.add(0, batch);
        for (int row = 0; row < 4; ++row) {
            double largest = 0;  // of the row: its components share a window
            for (const BatchResult& batch : batches) {
                for (const double v : batch.rgb[row]) largest = std::max(largest, std::abs(v));
            }
            for (int c = 0; c < 3; ++c) {
                long double sum = 0, squares = 0;
                for (const BatchResult& batch : batches) {
                    sum += batch.rgb[row][c];
                    squares += batch.rgb[row][c] * batch.rgb[row][c];
                }
                EXPECT_NEAR(sums.sum(0, row, c), static_cast<double>(sum), 100 * largest * 0x1p-32);
                EXPECT_NEAR(sums.sum_of_squares(0, row, c), static_cast<double>(squares),
                            100 * largest * largest * 0x1p-31);
            }
            for (int bin = 0; bin < spectral_bins; ++bin) {
                long double sum = 0;
                double greatest = 0;
                for (const BatchResult& batch : batches) {
                    const double v = static_cast<double>(batch.spectral[row][bin]);
                    sum += v;
                    greatest = std::max(greatest, std::abs(v));
                }
                EXPECT_NEAR(sums.spectral_sum(0, row, bin), static_cast<double>(sum),
                            100 * greatest * 0x1p-32);
            }
        }
    }
}

// float32 in every batch, and its mean comes back with the same bits.
TEST(FilmSums, KeepAFloatExactlyWhateverItsMagnitude) {
    for (const float value : {1.0F, 0.1F, -3.3e-30F, 1.7e37F, 1e-38F, 65504.0F, -0.7F}) {
        BatchResult batch{};
        batch.rgb[0][0] = static_cast<double>(value);
        batch.spectral[0][3] = value;
        FilmSums sums(layout_of(1, 1, true));
        for (int i = 0; i < 7; ++i) sums.add(0, batch);
        // 24 bits fit three digits of 16 bits wherever they begin.
        EXPECT_EQ(static_cast<float>(sums.mean(0, 0, 0)), value);
        EXPECT_EQ(static_cast<float>(sums.spectral_mean(0, 0, 3)), value);
    }
}

TEST(FilmSums, HoldAsManyOfTheLargestDigitsAsTheyPromise) {
    // The largest digit, 2^15 of the leading one's weight, both signs.
    for (const double sign : {1.0, -1.0}) {
        BatchResult batch{};
        const double value = sign * std::nextafter(0x1p15, 0);
        for (double& v : batch.rgb[0]) v = value;
        FilmSums sums(layout_of(2, 1, false));
        for (uint32_t i = 0; i < most_terms; ++i) sums.add(0, batch);
        EXPECT_NEAR(sums.mean(0, 0, 1) / value, 1, 1e-9);
        EXPECT_NEAR(sums.sum_of_squares(0, 0, 1) / (value * value * most_terms), 1, 1e-9);
        sums.add(1, batch);
        EXPECT_FALSE(sums.add(1, sums, 0)) << "one more than they hold";
        EXPECT_EQ(sums.batches(1), 1U);
    }
}

TEST(FilmSums, ValuesOutOfRangeAreReportedAndCountAsBlack) {
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {infinity, -infinity, std::nan(""), 1.8e38, -1e300}) {
        FilmSums sums(layout_of(1, 4, false));
        BatchResult batch{};
        batch.rgb[0][1] = 2;
        EXPECT_TRUE(sums.add(0, batch));
        batch.rgb[3][2] = bad;
        EXPECT_FALSE(sums.add(0, batch)) << bad;
        EXPECT_EQ(sums.batches(0), 2U);
        EXPECT_EQ(sums.mean(0, 0, 1), 1);
    }
    FilmSums spectral(layout_of(1, 1, true));
    BatchResult batch{};
    batch.spectral[0][39] = std::numeric_limits<float>::infinity();
    EXPECT_FALSE(spectral.add(0, batch));
    EXPECT_EQ(spectral.spectral_mean(0, 0, 39), 0);
}

TEST(FilmSums, VariancesAreThoseBetweenTheBatches) {
    for (const double spread : {1.0, 1e-2, 1e-3}) {
        std::mt19937 generator(11);
        std::normal_distribution<double> normal(1, spread);
        FilmSums sums(layout_of(1, 1, false));
        std::vector<double> values;
        for (int i = 0; i < 50; ++i) {
            BatchResult batch{};
            values.push_back(batch.rgb[0][2] = 1e-6 * normal(generator));
            sums.add(0, batch);
        }
        double mean = 0, variance = 0;
        for (const double v : values) mean += v / 50;
        for (const double v : values) variance += (v - mean) * (v - mean) / 49 / 50;
        EXPECT_NEAR(sums.mean(0, 0, 2) / mean, 1, 1e-9);
        EXPECT_NEAR(sums.variance(0, 0, 2) / variance, 1, 1e-3) << spread;
    }
}

TEST(FilmSums, WordsComeBackAndImpossibleOnesAreRefused) {
    for (const int rows : {1, 4}) {
        FilmSums sums(layout_of(2, rows, true));
        for (const BatchResult& batch : random_batches(9, 30, 4)) sums.add(1, batch);
        const std::vector<uint32_t> words = words_of(sums, 1);
        FilmSums back(layout_of(2, rows, true));
        ASSERT_TRUE(back.from_words(0, words.data()));
        EXPECT_EQ(words_of(back, 0), words);
        std::vector<uint32_t> bad = words;
        bad[0] = most_terms + 1;
        EXPECT_FALSE(back.from_words(0, bad.data())) << "batches";
        bad = words;
        bad[1] |= 0xff;
        EXPECT_FALSE(back.from_words(0, bad.data())) << "level";
        bad = words;
        bad[2] = 0x7fffffff;
        EXPECT_FALSE(back.from_words(0, bad.data())) << "digit";
        bad = words;
        bad.back() = 0x80000000;
        EXPECT_FALSE(back.from_words(0, bad.data())) << "digit of a bin";
    }
}

}  // namespace
}  // namespace drude
