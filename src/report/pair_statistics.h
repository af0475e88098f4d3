// How far the two renderings of one metal lie apart, in numbers that people can judge.
#pragma once

#include "image/image.h"

namespace drude {

// Of log10 of the mean |fitted - literature| over linear R, G, B, at the pixels of a pair that
// differ: the background, equal to the bit, has no logarithm.
struct Log10Difference {
    double mean = 0, p50 = 0, p99 = 0, max = 0;
};

struct PairStatistics {
    Log10Difference log10;
    size_t pixels = 0;         // that differ
    double mean_absolute = 0;  // of linear R, G, B over those pixels
    // Mean of |dY| over the mean of the literature's Y, Y = relative luminance (Rec.709).
    double relative_luminance = 0;
    // Mean CIELAB distance (CIE 15, Delta E*ab 1976) and the share of pixels beyond 2.3, a
    // just noticeable difference side by side (M. Mahy, L. Van Eycken & A. Oosterlinck, Color
    // Res. Appl. 19, 105, 1994). White is D65 with the 99 % percentile of the literature's Y over
    // those pixels: the exposure at which the picture is looked at.
    double mean_delta_e = 0, noticeable = 0;
    double white = 0;  // that Y
};

// Both pictures of one size with R, G, B (finite); zeros where no pixel differs.
// Throws std::logic_error for different sizes, Error (user) where a channel is missing.
PairStatistics pair_statistics(const Image& fitted, const Image& literature);

}  // namespace drude
