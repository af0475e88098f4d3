// From scene-linear radiance to a picture for a display.
#pragma once

#include <vector>

namespace drude {

// F. Durand & J. Dorsey, "Fast Bilateral Filtering for the Display of High-Dynamic-Range Images",
// SIGGRAPH 2002, section 6: log10 intensity I = (20 R + 40 G + B)/61 is split by a bilateral filter
// (2 % of the larger side, 0.4 in log10) into a base, whose contrast is compressed, and a detail,
// which stays; colour ratios R/I, G/I, B/I stay too.
struct DurandParameters {
    double compression = 1.0;  // factor on the base, in (0, 1]
    double max_base = 0.0;     // log10 of the base intensity that becomes 1
    double floor = 1e-6;       // intensities below it, and what is no number, count as this
};

struct DurandOptions {
    double contrast = 50.0;  // of the base after compression, above 1
    bool exact = false;      // the exact filter instead of the grid: the tests' oracle, slow
    int threads = 0;
};

// Parameters from one picture (`rgb` as in write_png, linear). The floor is 1e-6 of the 99.9 %
// percentile of the intensities above 0; the base's extent is taken between its 0.1 % and 99.9 %
// percentiles over the pixels above the floor (nearest rank). So neither a firefly nor a black
// background sets the compression. A picture that fits the contrast already is scaled only. An
// all-black picture gives the defaults.
DurandParameters durand_parameters(int width, int height, const std::vector<float>& rgb,
                                   const DurandOptions& options);

// Applies parameters, of this picture or of the one it is shown beside: both of a pair need the
// same, or the operator makes up differences. Linear, to be clipped and sRGB-encoded by write_png.
// std::logic_error where the size of `rgb` is wrong.
std::vector<float> tonemap_durand(int width, int height, const std::vector<float>& rgb,
                                  const DurandParameters& parameters, const DurandOptions& options);

// rgb * 2^exposure.
std::vector<float> expose(std::vector<float> rgb, double exposure);

}  // namespace drude
