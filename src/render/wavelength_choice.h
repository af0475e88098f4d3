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

// The cheapest number with which every layer that the options ask for is without bias;
// RenderOptions::wavelengths, which overrides it, is not looked at.
WavelengthChoice cheapest_exact_wavelengths(const Scene& scene, const RenderOptions& options);

}  // namespace drude
