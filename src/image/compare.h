// How far two pictures are apart, and whether they count as the same.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "image/image.h"
#include "image/noise_test.h"
#include "image/polarisation.h"

namespace drude {

// A pixel and channel passes where |a - b| <= max(absolute, relative * max(|a|, |b|)); the
// pictures are the same where at most `percent` % fail.
struct Tolerance {
    double absolute = 0.0, relative = 0.0, percent = 0.0;
};

// "abs,rel,percent", the later ones 0 where left out. Throws Error (user).
Tolerance parse_tolerance(const std::string& text);

struct CompareOptions {
    // Empty: R, G, B; where an image lacks them, Y; and S1.R to S3.B where both have them.
    std::vector<std::string> channels;
    bool exact = false;
    std::optional<Tolerance> tolerance;
    // Compare also where the files say that they are pictures of different scenes.
    bool any_scene = false;
    double alpha = 1e-3;  // probability of a false alarm of a whole comparison, in (0, 1)
    int threads = 0;
};

// What decided: `exact` and `tolerance` as asked for; otherwise `noise` where both images hold the
// variances of all channels compared, and `identical` (the values of those channels) where not.
enum class Decision { exact, tolerance, noise, identical };

// Differences a - b over pixels and channels, b being the reference; NaN where no value is finite
// in both pictures.
struct Figures {
    double mean_error = 0.0;  // bias
    double mae = 0.0;
    double rmse = 0.0;
    double relmse = 0.0;     // mean of (a - b)^2 / (b^2 + 0.01)
    double smape = 0.0;      // mean of 2|a - b| / (|a| + |b|), 0 where both are 0
    double psnr = 0.0;       // 20 log10(max|b| / rmse), infinite for equal pictures
    double max_error = 0.0;  // largest |a - b|
};

struct Comparison {
    bool same = false;
    Decision decision = Decision::identical;
    std::string reason;  // one line for people
    std::vector<std::string> channels;
    // Those that `all` is over: without S1.R to S3.B where these were not asked for, so that the
    // figures of a picture do not depend on whether its file holds its polarisation as well.
    std::vector<std::string> figure_channels;
    Figures all;
    std::vector<Figures> each;  // one a channel
    // Pixels and channels that are NaN or infinite in either image: left out of the figures, and
    // never the same (but for `exact`, where equal bits are equal).
    size_t not_finite = 0;
    size_t beyond_tolerance = 0;
    std::optional<NoiseTest> noise;
    // S0 to S3, each over its R, G and B (or over all spectral layers where there are any in both);
    // empty where one image has no such channels.
    std::vector<Figures> stokes;
    std::optional<PolarisationErrors> polarisation;
};

// Throws Error (user) for different sizes, for attributes `sceneHash` that differ (unless
// any_scene), for spectral layers of different wavelengths where such are compared, for a channel
// that is missing in one image, and with `exact` for different channel names; `name_a`, `name_b`
// name the files.
Comparison compare_images(const Image& a, const Image& b, const std::string& name_a,
                          const std::string& name_b, const CompareOptions& options);

// The channels that a list names: names separated by commas (a name may itself contain commas, as
// spectral ones do), a layer ("S1" for all S1.*), or "all" for all but variances.
// Throws Error (user) for a word that is neither in `image`.
std::vector<std::string> parse_channels(const std::string& list, const Image& image,
                                        const std::string& where);

}  // namespace drude
