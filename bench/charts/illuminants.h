// Lights that metals are looked at in.
#pragma once

#include <string>
#include <vector>

#include "materials/spectrum.h"

namespace drude {

struct ChartIlluminant {
    std::string id, name;
    DenseSpectrum spectrum;  // relative
    // XYZ of it, Y = 1.
    XYZ white() const;
};

// D65; A (incandescent); a lamp of three bands, 10 nm wide at 450, 540 and 610 nm, mixed to the
// chromaticity of D65; and a sodium lamp, 589 nm, 2 nm wide (the two lines of low pressure are 0.6
// nm apart). Bands are Gaussian, of that standard deviation.
const std::vector<ChartIlluminant>& chart_illuminants();

}  // namespace drude
