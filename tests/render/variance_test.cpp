// The variances that pictures carry are those that renders with other seeds have.
#include <gtest/gtest.h>

#include <array>
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

std::array<Variances, 3> variances_of(const Scene& scene, int samples) {
    std::array<Variances, 3> result;
    std::array<std::vector<double>, 3> sum, squares;
    for (int seed = 0; seed < seeds; ++seed) {
        RenderOptions options;
        options.samples_per_pixel = samples;
        options.seed = 7000 + static_cast<uint64_t>(seed);
        options.quiet = true;
        const Image image = render(scene, options).image;
        const double pixels = static_cast<double>(image.pixels());
        for (size_t c = 0; c < 3; ++c) {
            const std::string name(1, "RGB"[c]);
            const Channel& mean = image.at(name, "render");
            const Channel& variance = image.at("variance." + name, "render");
            sum[c].resize(image.pixels());
            squares[c].resize(image.pixels());
            for (size_t p = 0; p < image.pixels(); ++p) {
                const double value = static_cast<double>(mean.data[p]);
                sum[c][p] += value;
                squares[c][p] += value * value;
                result[c].stored += static_cast<double>(variance.data[p]) / seeds / pixels;
            }
        }
    }
    for (size_t c = 0; c < 3; ++c) {
        const double pixels = static_cast<double>(sum[c].size());
        for (size_t p = 0; p < sum[c].size(); ++p) {
            result[c].seen +=
                (squares[c][p] - sum[c][p] * sum[c][p] / seeds) / (seeds - 1) / pixels;
        }
    }
    return result;
}

// Pixels a side: few where a path is long, many where the noise has a long tail (a sun over narrow
// lobes). The ratio's own standard deviation is sqrt(2/(23 * pixels)) where the noise is normal, 1
// % for 32 x 32.
const char* size_for(const std::string& scene) {
    if (scene == "cornell-metals") return "12x12";
    return scene == "two-metals" ? "64x64" : "32x32";
}

// Within 10 % in the mean over the pixels, on every scene of the repository.
TEST(StoredVariance, IsThatBetweenSeedsOnEveryScene) {
    int scenes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(DRUDE_SOURCE_DIR "/scenes")) {
        if (entry.path().extension() != ".pbrt") continue;
        // Its geometry is not the project's: the reader brings it.
        if (entry.path().filename() == "killeroo-gold.pbrt") continue;
        ++scenes;
        Scene scene = read_scene(entry.path().string());
        set_resolution(size_for(entry.path().stem().string()), "size", &scene);
        const std::array<Variances, 3> variances = variances_of(scene, 64);
        for (size_t c = 0; c < 3; ++c) {
            const Variances& v = variances[c];
            EXPECT_GT(v.seen, 0);
            EXPECT_NEAR(v.stored / v.seen, 1, 0.1) << entry.path().filename() << " "
                                                   << "RGB"[c];
            RecordProperty(entry.path().stem().string() + "." + "RGB"[c],
                           fmt::format("{:.4f}", v.stored / v.seen));
        }
    }
    EXPECT_GE(scenes, 4);
}

}  // namespace
}  // namespace drude
