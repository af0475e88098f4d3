// Metals as renderers of three channels have them, and scenes turned into such: what spectra are
// measured against.
#pragma once

#include <array>
#include <string_view>

#include "materials/optical_constants.h"
#include "scene/scene.h"

namespace drude {

// What stands for the metal in the channels R, G, B.
enum class RgbMetal {
    // n and k at the dominant wavelengths of sRGB's primaries: 611.4, 549.1 and 464.2 nm.
    at_primaries,
    // n(lambda) and k(lambda) turned into RGB as if they were colours seen in D65.
    as_colours,
    // Per channel the n and k whose reflectance is that colour at normal incidence and comes
    // closest to it at all other angles: after Gulbrandsen 2014 (JCGT 3(4)), with the angles'
    // exact colours instead of an artist's edge tint.
    fitted,
    // No n and k: the exact colour at normal incidence and Schlick's approximation (1994, Computer
    // Graphics Forum 13(3)). Not for scenes.
    schlick
};
inline constexpr RgbMetal all_rgb_metals[] = {RgbMetal::at_primaries, RgbMetal::as_colours,
                                              RgbMetal::fitted, RgbMetal::schlick};
std::string_view rgb_metal_name(RgbMetal way);

// Linear sRGB of a spectrum of matter seen in D65, white being (1, 1, 1).
RGB colour_in_d65(const DenseSpectrum& spectrum);

// The unpolarised reflectance of a metal at cos_theta.
DenseSpectrum reflectance_spectrum(const DenseIndex& metal, double cos_theta);

// n and k of the channels R, G, B; of all ways but schlick.
std::array<Index, 3> rgb_constants(const DenseIndex& metal, RgbMetal way);

// What the channels reflect at each of some cosines. Reflectances above 1, which saturated metals
// have in sRGB, are held at 1, as renderers must.
std::vector<RGB> rgb_reflectances(const DenseIndex& metal, RgbMetal way,
                                  const std::vector<double>& cosines);

// The scene in three channels: lane 0, 1, 2 of a path of 4 wavelengths is B, G, R, the same at
// every phase, and lane 3 is dark. All lights become white and keep their luminance, so that a
// channel of the picture times the light's colour is what light of one colour brings. Metals and
// diffusers alone; std::logic_error for anything else, textures, films or pictures of light.
Scene rgb_scene(const Scene& scene, RgbMetal way);

// Sees in such a scene: linear sRGB of the film is R, G, B.
ColourMatching rgb_observer();

}  // namespace drude
