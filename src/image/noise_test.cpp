#include "image/noise_test.h"

#include <algorithm>
#include <cmath>

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
    // Sums of squared variances over their degrees of freedom (Satterthwaite).
    double spread = 0.0;
    double pixels = 0.0;
    bool finite = true;

    void add(const Sums& other) {
        a += other.a;
        b += other.b;
        variance_a += other.variance_a;
        variance_b += other.variance_b;
        spread += other.spread;
        pixels += other.pixels;
        finite = finite && other.finite;
    }
};

// Pixels are stored as float32: a difference within the rounding of their means is none.
double rounding(const Sums& sums) {
    constexpr double relative = 2.4e-7;
    return relative * std::max(std::abs(sums.a), std::abs(sums.b));
}

double standard_error(const Sums& sums) {
    return std::sqrt(sums.variance_a + sums.variance_b + rounding(sums) * rounding(sums));
}

double degrees_of_freedom(const Sums& sums) {
    const double variance = sums.variance_a + sums.variance_b;
    // A variance of zero leaves the rounding floor alone, which is not estimated from batches.
    return sums.spread > 0.0 ? variance * variance / sums.spread : 1e9;
}

double p_value(const Sums& sums) {
    if (!sums.finite) return 0.0;
    const double error = standard_error(sums);
    if (error == 0.0) return sums.a == sums.b ? 1.0 : 0.0;
    return student_two_sided((sums.a - sums.b) / error, degrees_of_freedom(sums));
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
    double smallest = 1.0;
    size_t outliers = 0;
};

struct ChannelPair {
    const float *a, *b, *variance_a, *variance_b;
    double degrees_a, degrees_b;

    Sums pixel(size_t i) const {
        Sums sums;
        sums.a = static_cast<double>(a[i]);
        sums.b = static_cast<double>(b[i]);
        sums.finite = std::isfinite(a[i]) && std::isfinite(b[i]);
        sums.variance_a = static_cast<double>(variance_a[i]);
        sums.variance_b = static_cast<double>(variance_b[i]);
        sums.spread = sums.variance_a * sums.variance_a / degrees_a +
                      sums.variance_b * sums.variance_b / degrees_b;
        sums.pixels = 1.0;
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

NoiseTest noise_test(const Image& a, const Image& b, const std::vector<std::string>& channels,
                     const std::string& name_a, const std::string& name_b, double alpha,
                     int threads) {
    constexpr double families = 3.0, power = 0.95;
    const double degrees_a = batches_of(a, name_a) - 1.0;
    const double degrees_b = batches_of(b, name_b) - 1.0;
    const size_t width = static_cast<size_t>(a.width), height = static_cast<size_t>(a.height);
    const size_t blocks_x = (width + block_side - 1) / block_side;
    const size_t blocks_y = (height + block_side - 1) / block_side;
    const double channel_count = static_cast<double>(channels.size());
    const double global_alpha = sidak_each(sidak_each(alpha, families), channel_count);

    NoiseTest result;
    double smallest_pixel = 1.0, smallest_block = 1.0, smallest_global = 1.0;
    size_t outliers = 0;
    for (const std::string& name : channels) {
        const Channel& variance_a = a.at(variance_name(name), name_a);
        const Channel& variance_b = b.at(variance_name(name), name_b);
        check_variance(variance_a, a.width, name_a);
        check_variance(variance_b, b.width, name_b);
        const ChannelPair pair = {a.at(name, name_a).data.data(),
                                  b.at(name, name_b).data.data(),
                                  variance_a.data.data(),
                                  variance_b.data.data(),
                                  degrees_a,
                                  degrees_b};
        // A row of blocks is one piece of work; results are put together in a fixed order.
        std::vector<RowResult> pixel_rows(blocks_y);
        std::vector<Sums> blocks(blocks_x * blocks_y);
        parallel_for(blocks_y, threads, [&](size_t block_row) {
            const size_t end = std::min(height, (block_row + 1) * block_side);
            for (size_t y = block_row * block_side; y < end; ++y) {
                for (size_t x = 0; x < width; ++x) {
                    const Sums sums = pair.pixel(y * width + x);
                    const double p = p_value(sums);
                    pixel_rows[block_row].smallest = std::min(pixel_rows[block_row].smallest, p);
                    pixel_rows[block_row].outliers += p < alpha ? 1 : 0;
                    blocks[block_row * blocks_x + x / block_side].add(sums);
                }
            }
        });
        Sums whole;
        for (const RowResult& row : pixel_rows) {
            smallest_pixel = std::min(smallest_pixel, row.smallest);
            outliers += row.outliers;
        }
        for (const Sums& block : blocks) {
            smallest_block = std::min(smallest_block, p_value(block));
            whole.add(block);
        }
        smallest_global = std::min(smallest_global, p_value(whole));
        const double degrees = degrees_of_freedom(whole);
        const double reach = student_quantile(global_alpha, degrees) +
                             student_quantile(2.0 * (1.0 - power), degrees);
        result.smallest_detectable_bias =
            std::max(result.smallest_detectable_bias, reach * standard_error(whole) / whole.pixels);
    }
    const double pixel_tests = static_cast<double>(width * height) * channel_count;
    const double block_tests = static_cast<double>(blocks_x * blocks_y) * channel_count;
    result.p_pixels = sidak_family(smallest_pixel, pixel_tests);
    result.p_blocks = sidak_family(smallest_block, block_tests);
    result.p_global = sidak_family(smallest_global, channel_count);
    result.p_min =
        sidak_family(std::min({result.p_pixels, result.p_blocks, result.p_global}), families);
    result.outlier_fraction = static_cast<double>(outliers) / pixel_tests;
    result.tests = (width * height + blocks_x * blocks_y + 1) * channels.size();
    return result;
}

}  // namespace drude
