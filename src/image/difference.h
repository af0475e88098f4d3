// Pictures of the difference between two pictures, always of linear data.
#pragma once

#include <string>
#include <vector>

#include "image/colour_map.h"
#include "image/image.h"
#include "image/picture.h"

namespace drude {

// log10 of the mean over the channels of |a - b|, a pixel; -infinity where they are equal, NaN
// where either is not finite. Shapes as in Image. Both images must have the channels and one size.
std::vector<double> log_difference(const Image& a, const Image& b,
                                   const std::vector<std::string>& channels);

// Mean over the channels of a - b, a pixel; NaN where either is not finite.
std::vector<double> signed_difference(const Image& a, const Image& b,
                                      const std::vector<std::string>& channels);

// The z-map: a - b in standard errors (noise_test.h), of the channel that is furthest off, a pixel;
// NaN where either is not finite. Both images must have the channels' variances; the names are
// those of the files, for errors.
std::vector<double> standard_error_difference(const Image& a, const Image& b,
                                              const std::vector<std::string>& channels,
                                              const std::string& name_a, const std::string& name_b);

// The values through a bar's colour map, clamped to its range; NaN is magenta. Row-major,
// width * height values.
Picture map_values(int width, int height, const std::vector<double>& values, const ColourBar& bar);

// The bars that the pictures use unless told otherwise: [-5, 0], [-0.1, 0.1] and [-6, 6]. Fixed, so
// that two difference pictures can be compared with each other.
ColourBar log_difference_bar();
ColourBar signed_difference_bar();
ColourBar standard_error_bar();

// A picture with its bar beside it and the bar's label above, on white.
Picture with_colour_bar(const Picture& picture, const ColourBar& bar);

}  // namespace drude
