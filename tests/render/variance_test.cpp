// The variances that pictures carry are those that renders with other seeds have.
#include <gtest/gtest.h>

#include <filesystem>

#include "render/render.h"
#include "scene/resolution.h"

namespace drude {
namespace {

constexpr int seeds = 24;

// Means over pixels and seeds of the stored variance, and of the variance over the seeds.
struct Variances {
    double stored = 0, seen = 0;
};

Variances variances_of(const Scene& scene, int samples, const char* channel) {
    Variances result;
    std::vector<double> sum, squares;
    for (int seed = 0; seed < seeds; ++seed) {
        RenderOptions options;
        options.samples_per_pixel = samples;
        options.seed = 7000 + static_cast<uint64_t>(seed);
        options.quiet = true;
        const Image image = render(scene, options).image;
        const Channel& mean = image.at(channel, "render");
        const Channel& variance = image.at(std::string("variance.") + channel, "render");
        sum.resize(image.pixels());
        squares.resize(image.pixels());
        for (size_t p = 0; p < image.pixels(); ++p) {
            const double value = static_cast<double>(mean.data[p]);
            sum[p] += value;
            squares[p] += value * value;
            result.stored += static_cast<double>(variance.data[p]) / seeds;
        }
    }
    for (size_t p = 0; p < sum.size(); ++p) {
        result.seen += (squares[p] - sum[p] * sum[p] / seeds) / (seeds - 1);
    }
    const double pixels = static_cast<double>(sum.size());
    return {result.stored / pixels, result.seen / pixels};
}

// Within 10 % in the mean over the pixels, on every scene of the repository. The ratio's own
// standard deviation is sqrt(2/(23 * 1024)), 1 %, where the noise is normal.
TEST(StoredVariance, IsThatBetweenSeedsOnEveryScene) {
    int scenes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(DRUDE_SOURCE_DIR "/scenes")) {
        if (entry.path().extension() != ".pbrt") continue;
        ++scenes;
        Scene scene = read_scene(entry.path().string());
        set_resolution("32x32", "size", &scene);
        for (const char* channel : {"R", "G", "B"}) {
            const Variances v = variances_of(scene, 64, channel);
            EXPECT_GT(v.seen, 0);
            EXPECT_NEAR(v.stored / v.seen, 1, 0.1) << entry.path().filename() << " " << channel;
            RecordProperty(entry.path().stem().string() + "." + channel,
                           fmt::format("{:.4f}", v.stored / v.seen));
        }
    }
    EXPECT_GE(scenes, 4);
}

}  // namespace
}  // namespace drude
