// Is a difference between two noisy pictures more than their noise?
//
// B. L. Welch's test (Biometrika 34, 28, 1947) of equal means with unequal variances, once a pixel
// and channel, once a block of 8x8 pixels and channel (more power against faint, extended
// differences), once for the whole picture and channel. The three families share `alpha` by
// Sidak's rule, and so do the tests within each, so that the probability of any false alarm in
// the whole comparison is at most `alpha`. Pixels are taken as independent of each other: a
// renderer with a filter wider than a pixel needs another test. Where both pictures say that their
// batches are of one size (attribute `batchSize`), the larger of the two variances of a batch
// stands for both, which keeps skewed noise from being taken for a difference; elsewhere the
// degrees of freedom are those of the picture that has fewer (of a sum, Satterthwaite's of its own
// variances), which hold however far apart the variances are, at some loss of power. Scatter of
// batches below 2^-15.5 of a pixel is seen by no sum of squares, so that much is granted to every
// pixel.
#pragma once

#include <string>
#include <vector>

#include "image/image.h"

namespace drude {

// Name of the channel that holds the variance of the mean of channel `name`.
std::string variance_name(const std::string& name);

// Which of the `names` have no variance channel in `image`.
std::vector<std::string> without_variance(const Image& image,
                                          const std::vector<std::string>& names);

enum class TestFamily { pixel, block, mean };

// The test with the smallest p-value.
struct Finding {
    TestFamily family = TestFamily::mean;
    std::string channel;
    int x = 0, y = 0;  // the pixel, or the block's top left one
    double z = 0.0;    // a - b in standard errors; infinite where nothing is random
};

// The whole picture's mean of one channel, in the picture's unit.
struct MeanTest {
    std::string channel;
    double bias = 0.0;  // a - b
    double standard_error = 0.0;
    double reference = 0.0;  // mean of b
    // A bias of this size would have been revealed with 95 % probability.
    double detectable_bias = 0.0;
};

struct NoiseTest {
    // The smallest p-value of the comparison after both corrections, to be held against alpha.
    double p_min = 1.0;
    // The smallest of each family, corrected for the number of its own tests.
    double p_pixels = 1.0, p_blocks = 1.0, p_global = 1.0;
    // Share of pixels and channels whose own p-value is below alpha: about alpha for pictures that
    // differ by noise only.
    double outlier_fraction = 0.0;
    // A difference of the mean over the picture, in the picture's unit, that this pair would have
    // revealed with 95 % probability; the largest over the channels.
    double smallest_detectable_bias = 0.0;
    size_t tests = 0;
    Finding worst;
    std::vector<MeanTest> means;  // one a channel
};

// Both images must have the channels, their variances and the attribute `batches` (at least 2);
// sizes must agree. Throws Error (user), naming the files, where a variance is negative or not
// finite, or `batches` is missing. Pixels that are not finite in one of the images count as
// outliers with p = 0. Result does not depend on `threads`.
NoiseTest noise_test(const Image& a, const Image& b, const std::vector<std::string>& channels,
                     const std::string& name_a, const std::string& name_b, double alpha,
                     int threads);

// (a - b) over its standard error, pixel by pixel: the z-map of one channel. NaN where a pixel is
// not finite, infinite where nothing is random and the values differ. Sizes must agree; variances
// as for noise_test.
std::vector<double> standardised_difference(const Image& a, const Image& b,
                                            const std::string& channel, const std::string& name_a,
                                            const std::string& name_b);

}  // namespace drude
