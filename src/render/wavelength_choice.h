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
// nothing but this light, or a surface that sends this spectrum back: the standard deviation over
// the phases of `wavelengths` (see Wavelengths) of its linear sRGB, relative to the length of its
// mean. `wavelengths` divides 400; 0 for a spectrum of zeros.
double phase_noise(const DenseSpectrum& colour, int wavelengths);

// The cheapest number with which every layer that the options ask for is without bias and the
// colour of no light, and of no surface in the light of all of them together (metals with their
// films at normal incidence), scatters by more than 10 % between paths; the one with the least
// scatter where there is none. RenderOptions::wavelengths, which overrides it, is not looked at.
// Takes below a millisecond a metal, some where films are 100 micrometres thick; throws Error
// (user) as film_samples().
WavelengthChoice cheapest_exact_wavelengths(const Scene& scene, const RenderOptions& options);

}  // namespace drude
