// The spectra of a scene: rgb, blackbody, inline pairs, named, from a file, through a texture.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "materials/optical_constants.h"
#include "scene/builders.h"

namespace drude {

// A spectrum as it was given, before any grid.
struct SampledTable {
    std::string name;                   // for messages
    std::vector<double> wavelength_nm;  // strictly ascending
    std::vector<double> values;
};

// pbrt's named spectra of metals: "metal-Cu-eta" is n, "metal-Cu-k" is k of the published set "Cu"
// of this project. Nothing where `name` does not start with "metal-". Gives its message.
struct MetalSpectrum {
    const OpticalConstants* set = nullptr;
    bool is_k = false;
};
std::optional<MetalSpectrum> metal_spectrum(const std::string& name, const Place& place,
                                            Messages& messages);

// Of a parameter of type spectrum: pairs as they stand, a name, or a file of pairs (.spd).
SampledTable sampled_table(const Parameter& parameter, BuildContext& context);

// Of a parameter of type rgb that describes matter: all its colours, in linear sRGB.
std::vector<double> matter_rgb_values(const Parameter& parameter, BuildContext& context);

// A parameter that describes a property of matter, on the project's grid: rgb of its ColorSpace
// (see colour_space.h) through the basis of Mallett and Yuksel (unbounded), blackbody with its peak
// at 1, or a texture.
SpectrumValue matter_value(const Parameter& parameter, BuildContext& context);
// The same where it cannot change over a surface: a texture that does gives a message, and a value
// that is typical of it.
DenseSpectrum matter_spectrum(const Parameter& parameter, BuildContext& context);

// A reflectance; `otherwise` everywhere where the parameter is absent. What is given as a constant
// is in [0, 1], else Error (user); what a texture gives is held there when it is drawn.
SpectrumValue reflectance_value(ParameterList& list, const std::string& name, double otherwise,
                                BuildContext& context);
// The same where it cannot change over a surface.
DenseSpectrum reflectance(ParameterList& list, const std::string& name, double otherwise,
                          BuildContext& context);

// The spectrum of a light as pbrt-v4 normalises it, which divides every light's scale by the
// luminance of its spectrum (lights.cpp, SpectrumToPhotometric): "spectrum" and "blackbody" come
// out with Y = 1 in spectrum_to_xyz; "rgb" is D65 of Y = 1 times the colour, so that rgb 1 1 1 has
// Y = 1 too and brighter colours stay brighter; absent means rgb 1 1 1. A spectrum of zeros stays
// zero. Error (user) for negative values, and for light that no eye sees.
DenseSpectrum light_spectrum(ParameterList& list, const std::string& name, BuildContext& context);

// A "float" or a "texture" of floats.
NumberValue number_value(ParameterList& list, const std::string& name, double otherwise,
                         BuildContext& context);
// The same where it cannot change over a surface.
double number_or_texture(ParameterList& list, const std::string& name, double otherwise,
                         BuildContext& context);

}  // namespace drude
