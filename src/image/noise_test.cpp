#include "image/noise_test.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/executor.h"
#include "image/student.h"

namespace drude {

namespace {

constexpr int block_side = 8;

// Means and variances of one or more pixels, summed.
struct Sums {
    double a = 0.0, b = 0.0;
    double variance_a = 0.0, variance_b = 0.0;
    // Sums of squared variances over their degrees of freedom (Satterthwaite), and the degrees of
    // one pixel.
    double spread_a = 0.0, spread_b = 0.0;
    double degrees_a = 0.0, degrees_b = 0.0;
    // Sum of the larger |mean| of each pixel: what is rounded, whatever cancels in a and b.
    double magnitude = 0.0;
    // Of the variances, what no sum of squares shows.
    double unseen_variance = 0.0;
    double pixels = 0.0;
    // Batches of a over those of b where both are of one size, otherwise 0.
    double batch_ratio = 0.0;
    bool finite = true;

    // Where batches are alike they have one variance, if the pictures do not differ, and the larger
    // of the two estimates is taken for both. A skewed pixel whose few batches all missed what is
    // bright and rare has too low a mean and too small a variance at once: by itself it would be an
    // alarm far more often than Student's distribution says.
    double total_variance() const {
        if (!(batch_ratio > 0.0)) return variance_a + variance_b;
        return std::max(variance_a, variance_b / batch_ratio) +
               std::max(variance_b, variance_a * batch_ratio);
    }

    void add(const Sums& other) {
        a += other.a;
        b += other.b;
        variance_a += other.variance_a;
        variance_b += other.variance_b;
        spread_a += other.spread_a;
        spread_b += other.spread_b;
        degrees_a = other.degrees_a;
        degrees_b = other.degrees_b;
        magnitude += other.magnitude;
        unseen_variance += other.unseen_variance;
        pixels += other.pixels;
        batch_ratio = other.batch_ratio;
        finite = finite && other.finite;
    }
};

// Pixels are stored as float32: a difference within the rounding of their means is none.
double rounding(const Sums& sums) {
    constexpr double relative = 2.4e-7;
    return relative * sums.magnitude;
}

double standard_error(const Sums& sums) {
    return std::sqrt(sums.total_variance() + sums.unseen_variance +
                     rounding(sums) * rounding(sums));
}

double degrees_of_freedom(const Sums& sums) {
    const double spread = sums.spread_a + sums.spread_b;
    // A variance of zero leaves the rounding floor alone, which is not estimated from batches.
    if (!(spread > 0.0)) return 1e9;
    if (!(sums.batch_ratio > 0.0)) {
        // Few batches find a variance near zero now and then. Satterthwaite's weights then follow
        // the other side, whose many degrees say nothing of the side that is not known: the fewer
        // degrees of the two hold whatever the true variances are.
        const auto own = [](double variance, double spread_of_one, double degrees) {
            return spread_of_one > 0.0 ? variance * variance / spread_of_one : degrees;
        };
        return std::min(own(sums.variance_a, sums.spread_a, sums.degrees_a),
                        own(sums.variance_b, sums.spread_b, sums.degrees_b));
    }
    const double variance = sums.variance_a + sums.variance_b;
    return variance * variance / spread;
}

// The difference in standard errors; infinite where either is not finite, or where nothing is
// random and the values differ.
double standardised(const Sums& sums) {
    const double infinite = std::numeric_limits<double>::infinity();
    if (!sums.finite) return infinite;
    const double difference = sums.a - sums.b, error = standard_error(sums);
    if (error == 0.0) return difference == 0.0 ? 0.0 : std::copysign(infinite, difference);
    return difference / error;
}

double p_value(const Sums& sums) {
    const double z = standardised(sums);
    return std::isfinite(z) ? student_two_sided(z, degrees_of_freedom(sums)) : 0.0;
}

// The smallest p-value so far, and where it is; where several are zero, the largest deviation.
struct Smallest {
    double p = 1.0, z = 0.0;
    size_t channel = 0, at = 0;

    void offer(const Smallest& other) {
        if (other.p < p || (other.p == p && std::abs(other.z) > std::abs(z))) *this = other;
    }
    void offer(const Sums& sums, size_t in_channel, size_t index) {
        offer({p_value(sums), standardised(sums), in_channel, index});
    }
};

double batch_ratio_of(const Image& a, const Image& b) {
    const double size = a.number("batchSize", 0.0);
    const double batches_a = a.number("batches", 0.0), batches_b = b.number("batches", 0.0);
    return size > 0.0 && size == b.number("batchSize", 0.0) && batches_b > 0.0
               ? batches_a / batches_b
               : 0.0;
}

double batches_of(const Image& image, const std::string& where) {
    const double batches = image.number("batches", 0.0);
    if (!(batches >= 2.0)) {
        user_error(
            "{}: has variances but no attribute 'batches' of at least 2, which says how well they "
            "are known; render it again or compare with --tolerance",
            where);
    }
    return batches;
}

void check_variance(const Channel& channel, int width, const std::string& where) {
    for (size_t i = 0; i < channel.data.size(); ++i) {
        const float value = channel.data[i];
        if (std::isfinite(value) && value >= 0.0F) continue;
        user_error("{}: channel '{}' at pixel ({}, {}) is {}; expected a variance, 0 or above",
                   where, channel.name, i % static_cast<size_t>(width),
                   i / static_cast<size_t>(width), value);
    }
}

struct RowResult {
    Smallest smallest;
    size_t outliers = 0;
};

// A sum of the squares of n batches is known to 2^-31 of the largest (render/exact_sum.h), and a
// variance below the smallest normal float32 is stored as 0: batches that scatter by less than that
// look alike. Squared, and of the mean of the batches.
double unseen_variance(double mean, double degrees) {
    return 0x1p-31 * mean * mean / degrees + static_cast<double>(std::numeric_limits<float>::min());
}

struct ChannelPair {
    const float *a, *b, *variance_a, *variance_b;
    double degrees_a, degrees_b, batch_ratio;

    Sums pixel(size_t i) const {
        Sums sums;
        sums.a = static_cast<double>(a[i]);
        sums.b = static_cast<double>(b[i]);
        sums.finite = std::isfinite(a[i]) && std::isfinite(b[i]);
        sums.variance_a = static_cast<double>(variance_a[i]);
        sums.variance_b = static_cast<double>(variance_b[i]);
        sums.spread_a = sums.variance_a * sums.variance_a / degrees_a;
        sums.spread_b = sums.variance_b * sums.variance_b / degrees_b;
        sums.degrees_a = degrees_a;
        sums.degrees_b = degrees_b;
        if (sums.finite) {
            sums.magnitude = std::max(std::abs(sums.a), std::abs(sums.b));
            sums.unseen_variance =
                unseen_variance(sums.a, degrees_a) + unseen_variance(sums.b, degrees_b);
        }
        sums.pixels = 1.0;
        sums.batch_ratio = batch_ratio;
        return sums;
    }
};

}  // namespace

std::string variance_name(const std::string& name) {
    return "variance." + name;
}

std::vector<std::string> without_variance(const Image& image,
                                          const std::vector<std::string>& names) {
    std::vector<std::string> missing;
    for (const std::string& name : names) {
        if (!image.find(variance_name(name))) missing.push_back(name);
    }
    return missing;
}

namespace {

struct Side {
    const Image& image;
    const std::string& name;
    double degrees;  // of freedom of a pixel's variance
};

// Throws Error (user) for a channel that is missing and for what is no variance.
ChannelPair channel_pair(const Side& a, const Side& b, const std::string& channel) {
    const auto variance_of = [&](const Side& side) {
        const Channel& variance = side.image.at(variance_name(channel), side.name);
        check_variance(variance, side.image.width, side.name);
        return variance.data.data();
    };
    const float* const variance_a = variance_of(a);
    const float* const variance_b = variance_of(b);
    return {a.image.at(channel, a.name).data.data(),
            b.image.at(channel, b.name).data.data(),
            variance_a,
            variance_b,
            a.degrees,
            b.degrees,
            batch_ratio_of(a.image, b.image)};
}

}  // namespace

std::vector<double> standardised_difference(const Image& a, const Image& b,
                                            const std::string& channel, const std::string& name_a,
                                            const std::string& name_b) {
    // Degrees of freedom enter a difference in standard errors through what batches do not show.
    const auto degrees = [](const Image& image) {
        return std::max(1.0, image.number("batches", 2.0) - 1.0);
    };
    const ChannelPair pair =
        channel_pair({a, name_a, degrees(a)}, {b, name_b, degrees(b)}, channel);
    std::vector<double> z(a.pixels());
    for (size_t i = 0; i < z.size(); ++i) {
        const Sums sums = pair.pixel(i);
        z[i] = sums.finite ? standardised(sums) : std::numeric_limits<double>::quiet_NaN();
    }
    return z;
}

NoiseTest noise_test(const Image& a, const Image& b, const std::vector<std::string>& channels,
                     const std::string& name_a, const std::string& name_b, double alpha,
                     int threads) {
    constexpr double families = 3.0, power = 0.95;
    const double degrees_a = batches_of(a, name_a) - 1.0;
    const double degrees_b = batches_of(b, name_b) - 1.0;
    const auto width = static_cast<size_t>(a.width), height = static_cast<size_t>(a.height);
    const size_t blocks_x = (width + block_side - 1) / block_side;
    const size_t blocks_y = (height + block_side - 1) / block_side;
    const auto channel_count = static_cast<double>(channels.size());
    const double global_alpha = sidak_each(sidak_each(alpha, families), channel_count);

    NoiseTest result;
    Smallest pixel, block, global;
    size_t outliers = 0;
    for (size_t c = 0; c < channels.size(); ++c) {
        const std::string& name = channels[c];
        const ChannelPair pair = channel_pair({a, name_a, degrees_a}, {b, name_b, degrees_b}, name);
        // A row of blocks is one piece of work; results are put together in a fixed order.
        std::vector<RowResult> pixel_rows(blocks_y);
        std::vector<Sums> blocks(blocks_x * blocks_y);
        parallel_for(blocks_y, threads, [&](size_t block_row) {
            const size_t end = std::min(height, (block_row + 1) * block_side);
            for (size_t y = block_row * block_side; y < end; ++y) {
                for (size_t x = 0; x < width; ++x) {
                    const Sums sums = pair.pixel(y * width + x);
                    Smallest one;
                    one.offer(sums, c, y * width + x);
                    pixel_rows[block_row].smallest.offer(one);
                    pixel_rows[block_row].outliers += one.p < alpha ? 1 : 0;
                    blocks[block_row * blocks_x + x / block_side].add(sums);
                }
            }
        });
        Sums whole;
        for (const RowResult& row : pixel_rows) {
            pixel.offer(row.smallest);
            outliers += row.outliers;
        }
        for (size_t i = 0; i < blocks.size(); ++i) {
            block.offer(blocks[i], c, i);
            whole.add(blocks[i]);
        }
        global.offer(whole, c, 0);
        const double degrees = degrees_of_freedom(whole);
        const double reach = student_quantile(global_alpha, degrees) +
                             student_quantile(2.0 * (1.0 - power), degrees);
        MeanTest mean;
        mean.channel = name;
        mean.bias = (whole.a - whole.b) / whole.pixels;
        mean.standard_error = standard_error(whole) / whole.pixels;
        mean.reference = whole.b / whole.pixels;
        mean.detectable_bias = reach * mean.standard_error;
        result.smallest_detectable_bias =
            std::max(result.smallest_detectable_bias, mean.detectable_bias);
        result.means.push_back(mean);
    }
    const double pixel_tests = static_cast<double>(width * height) * channel_count;
    const double block_tests = static_cast<double>(blocks_x * blocks_y) * channel_count;
    result.p_pixels = sidak_family(pixel.p, pixel_tests);
    result.p_blocks = sidak_family(block.p, block_tests);
    result.p_global = sidak_family(global.p, channel_count);
    result.p_min =
        sidak_family(std::min({result.p_pixels, result.p_blocks, result.p_global}), families);
    const auto finding = [&](TestFamily family, const Smallest& found, size_t columns, int side) {
        return Finding{family, channels[found.channel], static_cast<int>(found.at % columns) * side,
                       static_cast<int>(found.at / columns) * side, found.z};
    };
    // The mean before blocks before pixels: of equal evidence the plainest.
    result.worst = finding(TestFamily::mean, global, 1, 0);
    double p = result.p_global;
    if (result.p_blocks < p) {
        p = result.p_blocks;
        result.worst = finding(TestFamily::block, block, blocks_x, block_side);
    }
    if (result.p_pixels < p) result.worst = finding(TestFamily::pixel, pixel, width, 1);
    result.outlier_fraction = static_cast<double>(outliers) / pixel_tests;
    result.tests = (width * height + blocks_x * blocks_y + 1) * channels.size();
    return result;
}

}  // namespace drude
