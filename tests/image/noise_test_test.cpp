#include "image/noise_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "compare_cases.h"

namespace drude {
namespace {

// Means of `batches` normal batches and the variance between them over `batches`, as the renderer
// stores them; the truth varies over the picture.
Image noisy(unsigned seed, int width, int height, int batches, double bias) {
    std::mt19937 generator(seed);
    std::normal_distribution<double> normal;
    Image image =
        picture(width, height, {"R", "G", "B", "variance.R", "variance.G", "variance.B"}, 0.0F);
    image.attributes["batches"] = batches;
    for (const char* name : {"R", "G", "B"}) {
        Channel& mean = *image.find(name);
        Channel& variance = *image.find(variance_name(name));
        for (size_t i = 0; i < image.pixels(); ++i) {
            const double truth = 0.5 + 0.4 * std::sin(0.1 * static_cast<double>(i));
            const double sigma = 0.2 * truth;
            double sum = 0.0, square = 0.0;
            for (int k = 0; k < batches; ++k) {
                const double value = truth + bias + sigma * normal(generator);
                sum += value;
                square += value * value;
            }
            const double m = sum / batches;
            mean.data[i] = static_cast<float>(m);
            variance.data[i] = static_cast<float>((square / batches - m * m) / (batches - 1.0));
        }
    }
    return image;
}

TEST(NoiseTest, OnePixelIsATTestByHand) {
    Image a = picture(1, 1, {"Y", "variance.Y"}, 0.0F), b = a;
    a.attributes["batches"] = 16;
    b.attributes["batches"] = 8;
    a.channels[0].data = {1.0F};
    b.channels[0].data = {0.25F};
    a.channels[1].data = {0.04F};
    b.channels[1].data = {0.05F};
    const Comparison result = compare(a, b);
    ASSERT_EQ(result.decision, Decision::noise);
    // t = 0.75/0.3 = 2.5 with the fewer degrees of the two, 7. In closed form, theta =
    // atan(t/sqrt(7)): p = 1 - 2/pi (theta + sin theta (cos + 2/3 cos^3 + 8/15 cos^5)). The one
    // pixel, its block and the whole are the same test, so the correction is for three.
    const auto family = [](double p) { return 1 - std::pow(1 - p, 3); };
    const double theta = std::atan(2.5 / std::sqrt(7.0)), c = std::cos(theta);
    const double p =
        1 - 2 / std::acos(-1.0) *
                (theta + std::sin(theta) * (c + 2 * std::pow(c, 3) / 3 + 8 * std::pow(c, 5) / 15));
    EXPECT_NEAR(p, 0.041, 0.0005);
    EXPECT_NEAR(result.noise->p_min, family(p), 1e-6);
    EXPECT_NEAR(result.noise->p_pixels, result.noise->p_global, 1e-12);
    EXPECT_EQ(result.noise->tests, 3U);
}

TEST(NoiseTest, FalseAlarmsAreAsRareAsAlphaSays) {
    // 400 pairs of equal truth at alpha 0.05: the test's families overlap, so somewhat fewer than
    // 20 alarms are to be expected, and more than 38 have a probability below 1e-4.
    int alarms = 0;
    double outliers = 0.0;
    CompareOptions options;
    options.alpha = 0.05;
    options.threads = 1;
    constexpr int pairs = 400;
    for (unsigned k = 0; k < pairs; ++k) {
        const Comparison result =
            compare(noisy(2 * k + 1, 20, 12, 16, 0), noisy(2 * k + 2, 20, 12, 16, 0), options);
        alarms += result.same ? 0 : 1;
        outliers += result.noise->outlier_fraction / pairs;
    }
    EXPECT_LE(alarms, 38);
    EXPECT_GE(alarms, 5);
    // Of equal variances the statistic has Student's distribution of 30 degrees, and is held
    // against that of 15, for the test does not know: P(|t_30| > 2.1314) = 0.0414.
    EXPECT_NEAR(outliers, 0.0414, 0.003);
}

TEST(NoiseTest, FewBatchesAgainstManyRaiseNoFalseAlarms) {
    // Two batches find a variance a million times too small in one pixel of a thousand; the many
    // degrees of the other picture must not stand for it.
    const Image reference = noisy(999, 40, 30, 256, 0);
    int alarms = 0;
    CompareOptions options;
    options.alpha = 0.01;
    options.threads = 1;
    constexpr int pairs = 60;
    for (unsigned k = 0; k < pairs; ++k) {
        alarms += compare(noisy(k + 1, 40, 30, 2, 0), reference, options).same ? 0 : 1;
        alarms += compare(reference, noisy(k + 1, 40, 30, 2, 0), options).same ? 0 : 1;
    }
    // 1.2 alarms of 120 at most in the mean; more than 6 have a probability below 1e-3, also where
    // each alarm counts twice.
    EXPECT_LE(alarms, 6);
    // A difference of five standard deviations of one pixel is still seen, by the mean.
    EXPECT_FALSE(compare(noisy(1, 40, 30, 2, 0.1), reference, options).same);
}

TEST(NoiseTest, SmallestDetectableBiasIsDetectedAndATenthOfItIsNot) {
    const Image reference = noisy(1, 64, 64, 16, 0);
    const double bias = compare(noisy(2, 64, 64, 16, 0), reference).noise->smallest_detectable_bias;
    EXPECT_GT(bias, 1e-4);
    EXPECT_LT(bias, 1e-2);
    int found = 0, false_alarms = 0;
    constexpr int tries = 40;
    for (unsigned k = 0; k < tries; ++k) {
        found += compare(noisy(100 + k, 64, 64, 16, bias), reference).same ? 0 : 1;
        false_alarms += compare(noisy(200 + k, 64, 64, 16, 0.1 * bias), reference).same ? 0 : 1;
    }
    // 95 % for one channel; here all three are biased.
    EXPECT_GE(found, tries - 3);
    EXPECT_LE(false_alarms, 2);
}

TEST(NoiseTest, OneWrongPixelAndOneWrongBlockAreFound) {
    const Image reference = noisy(1, 64, 64, 16, 0);
    Image pixel = noisy(2, 64, 64, 16, 0);
    ASSERT_TRUE(compare(pixel, reference).same);
    pixel.find("G")->data[1000] += 3.0F;
    const Comparison one = compare(pixel, reference);
    EXPECT_FALSE(one.same);
    EXPECT_LT(one.noise->p_pixels, 1e-6);
    EXPECT_GT(one.noise->p_global, 0.01);

    // A fifth of a standard deviation of a pair's pixel, everywhere within one block.
    Image block = noisy(3, 64, 64, 16, 0);
    for (size_t y = 16; y < 24; ++y) {
        for (size_t x = 24; x < 32; ++x) block.find("R")->data[y * 64 + x] += 0.12F;
    }
    const Comparison several = compare(block, reference);
    EXPECT_FALSE(several.same);
    EXPECT_LT(several.noise->p_blocks, 1e-6);
    EXPECT_LT(several.noise->p_blocks, several.noise->p_pixels);
}

TEST(NoiseTest, TheFindingNamesWhatIsOff) {
    Image reference = noisy(1, 40, 24, 16, 0);
    Image pixel = noisy(2, 40, 24, 16, 0);
    reference.attributes["batchSize"] = pixel.attributes["batchSize"] = 16;
    pixel.find("G")->data[9 * 40 + 33] += 3.0F;
    const Finding one = compare(pixel, reference).noise->worst;
    EXPECT_EQ(one.family, TestFamily::pixel);
    EXPECT_EQ(one.channel, "G");
    EXPECT_EQ(one.x, 33);
    EXPECT_EQ(one.y, 9);
    EXPECT_GT(one.z, 8.0);
    Image block = noisy(3, 40, 24, 16, 0);
    for (size_t y = 16; y < 24; ++y) {
        for (size_t x = 8; x < 16; ++x) block.find("B")->data[y * 40 + x] -= 0.12F;
    }
    const Finding several = compare(block, reference).noise->worst;
    EXPECT_EQ(several.family, TestFamily::block);
    EXPECT_EQ(several.channel, "B");
    EXPECT_EQ(several.x, 8);
    EXPECT_EQ(several.y, 16);
    EXPECT_LT(several.z, -6.0);
    const Comparison biased = compare(noisy(4, 40, 24, 16, 0.02), reference);
    EXPECT_EQ(biased.noise->worst.family, TestFamily::mean);
    ASSERT_EQ(biased.noise->means.size(), 3U);
    for (const MeanTest& mean : biased.noise->means) {
        EXPECT_NEAR(mean.bias, 0.02, 5 * mean.standard_error);
        EXPECT_LT(mean.detectable_bias, 0.02);
        EXPECT_NEAR(mean.reference, 0.5, 0.05);
    }
}

// Batches that are nearly always dark and seldom bright, as where a small lamp is found by chance:
// the variance of few batches is too small just where their mean is too low.
Image sparse(unsigned seed, int batches) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform;
    Image image = picture(32, 32, {"Y", "variance.Y"}, 0.0F);
    image.attributes["batches"] = batches;
    image.attributes["batchSize"] = 16;
    for (size_t i = 0; i < image.pixels(); ++i) {
        double sum = 0.0, square = 0.0;
        for (int k = 0; k < batches; ++k) {
            const double value =
                1.0 + 0.01 * uniform(generator) + (uniform(generator) < 0.05 ? 1.0 : 0.0);
            sum += value;
            square += value * value;
        }
        const double mean = sum / batches;
        image.channels[0].data[i] = static_cast<float>(mean);
        image.channels[1].data[i] =
            static_cast<float>((square / batches - mean * mean) / (batches - 1.0));
    }
    return image;
}

TEST(NoiseTest, SkewedNoiseIsNoDifferenceWhereBatchesAreAlike) {
    const Image reference = sparse(1, 4096);
    CompareOptions options;
    options.alpha = 1e-6;
    for (unsigned seed = 2; seed < 6; ++seed) {
        Image few = sparse(seed, 32);
        EXPECT_TRUE(compare(few, reference, options).same) << seed;
        // Where nothing says that batches are alike, a variance that is not zero but far too small
        // is believed: what is bright and rare was missed, and no number of degrees tells.
        few.attributes.erase("batchSize");
        EXPECT_FALSE(compare(few, reference, options).same) << seed;
    }
    Image brighter = sparse(7, 32);
    for (float& value : brighter.channels[0].data) value += 0.01F;
    EXPECT_FALSE(compare(brighter, reference, options).same);
}

TEST(NoiseTest, TheMapOfStandardErrors) {
    Image a = picture(2, 1, {"Y", "variance.Y"}, 0.0F), b = a;
    a.channels[0].data = {1.0F, 2.0F};
    b.channels[0].data = {0.25F, 2.0F};
    a.channels[1].data = {0.04F, 0.0F};
    b.channels[1].data = {0.05F, 0.0F};
    const std::vector<double> z = standardised_difference(a, b, "Y", "a", "b");
    EXPECT_NEAR(z[0], 0.75 / 0.3, 1e-6);
    EXPECT_EQ(z[1], 0.0);
    a.channels[0].data[1] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(std::isnan(standardised_difference(a, b, "Y", "a", "b")[1]));
}

TEST(NoiseTest, RoundingOfNoiseFreePixelsIsNoDifference) {
    Image a = picture(4, 4, {"Y", "variance.Y"}, 0.0F);
    a.attributes["batches"] = 16;
    a.channels[0].data.assign(16, 0.7F);
    Image b = a;
    for (float& value : b.channels[0].data) value = std::nextafter(value, 1.0F);
    EXPECT_TRUE(compare(a, b).same);
    for (float& value : b.channels[0].data) value *= 1.0F + 1e-5F;
    EXPECT_FALSE(compare(a, b).same);
}

TEST(NoiseTest, RoundingOfPixelsThatCancelIsNoDifference) {
    // S1 of a symmetric picture: half the pixels are what the others are with the other sign, so
    // that blocks and the mean are all but zero, and their rounding is that of the pixels.
    Image a = picture(16, 16, {"Y", "variance.Y"}, 0.0F);
    a.attributes["batches"] = 16;
    for (size_t i = 0; i < a.pixels(); ++i) a.channels[0].data[i] = i % 2 == 0 ? 0.7F : -0.7F;
    Image b = a;
    for (float& value : b.channels[0].data) value = std::nextafter(value, 1.0F);
    EXPECT_TRUE(compare(a, b).same);
    for (float& value : b.channels[0].data) value += 1e-5F;
    EXPECT_FALSE(compare(a, b).same);
}

TEST(NoiseTest, ResultDoesNotDependOnThreads) {
    const Image a = noisy(1, 37, 29, 16, 0), b = noisy(2, 37, 29, 16, 0.001);
    CompareOptions one, three;
    one.threads = 1;
    three.threads = 3;
    EXPECT_EQ(compare(a, b, one).noise->p_min, compare(a, b, three).noise->p_min);
    EXPECT_EQ(compare(a, b, one).noise->smallest_detectable_bias,
              compare(a, b, three).noise->smallest_detectable_bias);
}

// Batches that scatter by less than 2^-15.5 of their value, or by less than any float32 variance
// tells, have the variance 0: that says nothing of differences as small.
TEST(NoiseTest, GrantsTheScatterThatNoSumOfSquaresShows) {
    const auto flat = [](float value) {
        Image image = picture(16, 16, {"Y", "variance.Y"}, 0.0F);
        image.attributes["batches"] = 4;
        for (float& y : image.channels[0].data) y = value;
        return image;
    };
    Image a = flat(1.0F), b = flat(1.0F);
    b.channels[0].data[37] = 1.00002F;
    EXPECT_TRUE(compare(a, b).same) << compare(a, b).noise->p_min;
    b.channels[0].data[37] = 1.001F;
    EXPECT_FALSE(compare(a, b).same);
    a = flat(1e-25F);
    b = flat(1e-25F);
    b.channels[0].data[37] = 3e-25F;
    EXPECT_TRUE(compare(a, b).same) << compare(a, b).noise->p_min;
    EXPECT_FALSE(compare(flat(1e-15F), flat(3e-15F)).same);
}

TEST(NoiseTest, BadVariancesAreUserErrors) {
    const Image good = noisy(1, 8, 8, 16, 0);
    Image negative = good, no_batches = good;
    negative.find("variance.G")->data[9] = -1.0F;
    no_batches.attributes.clear();
    const std::string message = message_of([&] { compare(good, negative); });
    EXPECT_NE(message.find("b.exr: channel 'variance.G' at pixel (1, 1)"), std::string::npos)
        << message;
    EXPECT_NE(message_of([&] { compare(no_batches, good); }).find("'batches'"), std::string::npos);
}

TEST(NoiseTest, WithoutVariancesInBothOnlyEqualValuesAreTheSame) {
    Image a = noisy(1, 8, 8, 16, 0), b = noisy(2, 8, 8, 16, 0);
    b.channels.resize(3);
    const Comparison result = compare(a, b);
    EXPECT_EQ(result.decision, Decision::identical);
    EXPECT_FALSE(result.same);
}

TEST(NoiseTest, NotANumberIsADifference) {
    const Image a = noisy(1, 8, 8, 16, 0);
    Image b = a;
    b.find("R")->data[3] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(compare(a, a).same);
    EXPECT_FALSE(compare(a, b).same);
}

}  // namespace
}  // namespace drude
