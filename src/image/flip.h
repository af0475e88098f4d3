// FLIP: how different two pictures look when one flips between them.
//
// LDR: P. Andersson, J. Nilsson, T. Akenine-Moeller, M. Oskarsson, K. Astrom, M. D. Fairchild,
// "FLIP: A Difference Evaluator for Alternating Images", Proc. ACM Comput. Graph. Interact. Tech.
// 3(2), 2020. HDR: Andersson, Nilsson, Shirley, Akenine-Moeller, "Visualizing Errors in Rendered
// High Dynamic Range Images", Eurographics Short Papers 2021: the largest LDR error over a range of
// exposures that the reference decides.
#pragma once

#include <vector>

#include "image/picture.h"

namespace drude {

struct FlipOptions {
    // Pixels a degree of the visual field; the authors' default: 0.7 m before a screen 0.7 m wide
    // of 3840 pixels.
    double pixels_per_degree = 67.0206432765823;
    int threads = 0;
};

struct FlipResult {
    std::vector<double> error;  // a pixel, row-major, in [0, 1]
    double mean = 0.0;
    // Of the HDR variant: log2 of the first and last exposure, and how many there are.
    double start_exposure = 0.0, stop_exposure = 0.0;
    int exposures = 1;
};

// Linear R, G, B (Rec.709) of both pictures, clipped to [0, 1]; what is no number counts as 0.
// Throws std::logic_error where the sizes differ. The result does not depend on `threads`.
FlipResult flip_ldr(const Picture& test, const Picture& reference, const FlipOptions& options = {});

// Scene-linear R, G, B without an upper bound, through the ACES tone curve at each exposure.
// Where the reference is black nothing decides an exposure, and exposure 0 alone is looked at.
FlipResult flip_hdr(const Picture& test, const Picture& reference, const FlipOptions& options = {});

}  // namespace drude
