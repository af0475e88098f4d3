// The bilateral filter: an average over near pixels of near value, so that edges stay.
#pragma once

#include <vector>

namespace drude {

// Standard deviations of the two Gaussians: in space (pixels) and in value (the values' unit).
struct BilateralWidths {
    double space = 1.0, range = 1.0;
};

// The filter as it is defined (C. Tomasi & R. Manduchi, ICCV 1998, eqs. 7 and 8), the spatial
// Gaussian cut at 4 standard deviations. Slow: pixels x (8 space)^2. `values` holds width*height
// finite numbers, both widths are above 0; std::logic_error otherwise.
std::vector<float> bilateral_exact(int width, int height, const std::vector<float>& values,
                                   const BilateralWidths& widths, int threads);

// The same on a coarse grid of space and value, where it becomes a Gaussian blur (S. Paris &
// F. Durand, ECCV 2006; J. Chen, S. Paris & F. Durand, SIGGRAPH 2007). The grid has three nodes a
// standard deviation in space and two in value, linear interpolation both ways, and the blur is
// narrowed by what the interpolation adds. Against bilateral_exact, with space >= 4 pixels: within
// 0.04 range at every pixel and 0.01 range in the root mean square, as tested on steps, ramps,
// waves, noise and spots. The result does not depend on `threads`.
std::vector<float> bilateral_grid(int width, int height, const std::vector<float>& values,
                                  const BilateralWidths& widths, int threads);

}  // namespace drude
