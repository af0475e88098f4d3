// What surfaces are made of, as a scene describes it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "materials/material.h"
#include "materials/spectrum.h"
#include "scene/textures.h"

namespace drude {

// Trowbridge-Reitz with Smith masking by pbrt's roughness.
struct Roughness {
    NumberValue roughness;  // >= 0
    bool remap = true;      // alpha is its square root, as in pbrt-v4
};

struct ConductorMaterial {
    // Substrate, films, lobe, masking and beta. Where the scene gives pbrt's roughness the lobe is
    // Trowbridge-Reitz with Smith masking and `alpha` holds pbrt's alpha, which beta cannot always
    // express; alpha < 0 means "use surface.beta".
    Material surface;
    double alpha = -1;
    // Where it is given, alpha changes over the surface; `alpha` is then typical of it.
    std::optional<Roughness> textured_roughness;
    // Instead of a metal: pbrt's "reflectance", the same at every angle for s and p, with the phase
    // of an ideal conductor (Delta = 180 degrees: C = -R, S = 0).
    std::optional<SpectrumValue> reflectance;
};

struct DiffuseMaterial {
    SpectrumValue reflectance;  // in [0, 1]; a perfect depolariser
};

// Depolarises both ways.
struct DiffuseTransmissionMaterial {
    SpectrumValue reflectance, transmittance;  // their sum in [0, 1]
};

// A clear medium of refractive index eta on the inside of the surface (where the normal points
// away from), vacuum on the other side. alpha is pbrt's; below mirror_below_beta it is smooth.
struct DielectricMaterial {
    DenseSpectrum eta{};  // > 0
    double alpha = 0;
    // Whether eta changes with wavelength, so that refraction parts the wavelengths of a path.
    bool is_dispersive() const {
        for (const double n : eta) {
            if (n != eta[0]) return true;
        }
        return false;
    }
};

// A thin plate of a dielectric with all its inner reflections, summed incoherently; light goes
// through without being bent.
struct ThinDielectricMaterial {
    DenseSpectrum eta{};
};

// A clear coat, vacuum above it, over a metal or a diffuse base. Light in the coat walks between
// its surfaces, polarised, until it leaves.
struct CoatedMaterial {
    DenseSpectrum eta{};   // of the coat; a walk bends by the value at 550 nm
    double alpha = 0;      // of its surface
    double thickness = 0;  // optical depth: a passage at cosine c is attenuated by exp(-t/c)
    std::variant<ConductorMaterial, DiffuseMaterial> base;
};

// One of two materials, chosen at random at every point.
struct MixMaterial {
    int first = 0, second = 0;  // of Scene::materials; -1 is an interface
    NumberValue amount;         // probability of the second, in [0, 1]
};

// A flat element that light goes straight through: it changes polarisation alone. Its frame at a
// point: zero is the object's x axis projected perpendicular to the ray, angles counter-clockwise
// seen looking towards the source. Light sampling sees through it.
struct OpticalElementMaterial {
    enum class Kind { linear_polariser, retarder, circular_polariser };
    Kind kind = Kind::linear_polariser;
    double axis_deg = 0;         // transmission axis, or fast axis
    double retardance_deg = 90;  // retarder
    bool right_handed = true;    // circular polariser: passes S3 > 0
    double transmittance = 1;    // of the light it passes, in [0, 1]
};

class PluginSurface;

// A material from a shared object (see render/plugin.h).
struct PluginMaterial {
    std::string name;
    std::shared_ptr<const PluginSurface> surface;
};

using SurfaceMaterial =
    std::variant<ConductorMaterial, DiffuseMaterial, DiffuseTransmissionMaterial,
                 DielectricMaterial, ThinDielectricMaterial, CoatedMaterial, MixMaterial,
                 OpticalElementMaterial, PluginMaterial>;

}  // namespace drude
