// How many wavelengths a path carries where nobody says.
#pragma once

#include <string>

#include "render/render.h"
#include "scene/scene.h"

namespace drude {

struct WavelengthChoice {
    int wavelengths = 8;  // 4, 8, 16 or spectral_bins
    std::string reason;
};

// How much a path's colour owes to which of the wavelengths it happens to carry, where it sees
// nothing but this light: the standard deviation over the phases of `wavelengths` (see Wavelengths)
// of its linear sRGB, relative to the length of its mean. `wavelengths` divides 400; 0 for a
// spectrum of zeros.
double phase_noise(const DenseSpectrum& light, int wavelengths);

// The cheapest number with which every layer that the options ask for is without bias;
// RenderOptions::wavelengths, which overrides it, is not looked at.
WavelengthChoice cheapest_exact_wavelengths(const Scene& scene, const RenderOptions& options);

}  // namespace drude
