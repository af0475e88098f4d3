// The colour that a surface gives white light, for denoisers and people; no picture depends on it.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "render/batch_tracer.h"
#include "render/textures.h"

namespace drude {

class Albedos {
  public:
    // `scene` must outlive it. Opens the pictures of textures: throws Error (user) where it cannot.
    explicit Albedos(const Scene& scene);

    // Linear sRGB of what comes back of D65 that is (1, 1, 1), seen at `cos_theta` from the shading
    // normal: reflectance, with transmittance where light goes through as well; of a metal the mean
    // of Rs and Rp of a smooth surface; of a coat the base alone; of clear glass 1; of a mix the
    // two in its proportion; of a plugin 0, because it does not say. Colours outside Rec.709 have
    // negative components.
    glm::dvec3 operator()(int material, const TexturePoint& at, double cos_theta) const;

  private:
    // Sampled in the middles of the spectral bins.
    using Value = PackedValue<spectral_bins>;
    struct Metal {
        bool fixed = false;
        Value reflectance;
        std::vector<glm::dvec3> by_cosine;  // of equally spaced cosines from 0 to 1
    };
    struct Entry {
        enum class Kind { none, clear, diffuse, transmitting, metal, mix } kind = Kind::none;
        Value reflectance, transmittance;
        Metal metal;
        int first = -1, second = -1;
        NumberValue amount;
    };
    struct Reader;

    Metal metal_of(const ConductorMaterial& metal) const;
    glm::dvec3 colour(const Value& value, const TexturePoint& at) const;

    NumberTextures numbers_;
    SpectrumTextures<spectral_bins> spectra_;
    // Of each bin in linear sRGB; together (1, 1, 1).
    std::array<glm::dvec3, spectral_bins> weights_{};
    std::vector<Entry> entries_;
};

}  // namespace drude
