// The values of a scene's textures at a point of a surface.
//
// Every texture that is made of others is a sum of them with weights that depend on the point; a
// picture is a sum of the three RGB basis spectra. So numbers, packets of wavelengths and single
// wavelengths in double share one evaluation. Definitions are pbrt-v4's (textures.cpp,
// TextureMapping2D), without its filtering of checkerboards and pictures: the samples of a pixel
// average them.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <vector>

#include "render/texture_picture.h"
#include "render/texture_point.h"
#include "render/wavelengths.h"
#include "scene/scene.h"

namespace drude {

// (s, t) of a point. uv: scaled and shifted; spherical: theta / pi and phi / (2 pi) about z;
// cylindrical: (pi + atan2(y, x)) / (2 pi) and z; planar: the dot products with v1 and v2, shifted.
glm::dvec2 texture_coordinates(const TextureMapping& mapping, const TexturePoint& at);

// Whether a value, or a material's parameters, change over a surface.
inline bool is_textured(const NumberValue& value) {
    return value.texture >= 0;
}
inline bool is_textured(const SpectrumValue& value) {
    return value.texture >= 0;
}

// Up to four summands.
struct TextureWeights {
    int count = 0;
    std::array<double, 4> weight{};
};

// The pictures of one list of textures, by its index; null for other textures.
using TexturePictures = std::vector<std::unique_ptr<const TexturePicture>>;

// Numbers, in double: "float" textures.
class NumberTextures {
  public:
    // Opens the pictures of all textures of the scene; `scene` must outlive it. Throws Error (user)
    // at the texture's place for one that cannot be read, Error (outside) without OpenImageIO.
    explicit NumberTextures(const Scene& scene);

    // What a texture gives that is not finite is 0.
    double value(const NumberValue& number, const TexturePoint& at) const {
        return number.texture < 0 ? number.constant : textured(number.texture, at);
    }
    // pbrt's alpha (it is 0 for a mirror), from a roughness held in [0, 10].
    double alpha(const Roughness& roughness, const TexturePoint& at) const {
        const double r = value(roughness.roughness, at);
        const double held = r > 0 ? std::fmin(r, 10) : 0;
        return roughness.remap ? std::sqrt(held) : held;
    }
    // Held in [0, 1]: the amount of a mix.
    double fraction(const NumberValue& number, const TexturePoint& at) const {
        const double f = value(number, at);
        return f > 0 ? std::fmin(f, 1) : 0;
    }

    // The weights of a texture's parts, in the order of texture_parts(). Not for pictures.
    template <class Value>
    TextureWeights weights(const Texture<Value>& texture, const TexturePoint& at) const;
    const TexturePictures& spectrum_pictures() const { return spectrum_pictures_; }

  private:
    double textured(int texture, const TexturePoint& at) const;

    const Scene& scene_;
    TexturePictures pictures_, spectrum_pictures_;
};

// The values a texture is made of: none of a picture, else one to four.
template <class Value>
struct TextureParts {
    int count = 0;
    std::array<const Value*, 4> part{};
};
template <class Value>
TextureParts<Value> texture_parts(const Texture<Value>& texture);

// One wavelength in double, for the reference integrator: nm in [380, 780], linear between the
// grid's. What is not finite is 0.
double spectrum_texture_value(const Scene& scene, const NumberTextures& numbers,
                              const SpectrumValue& value, const TexturePoint& at, double nm);

// A SpectrumValue laid out for packets.
template <int N>
struct PackedValue {
    PackedSpectrum<N> constant;
    int texture = -1;
};

// The N wavelengths of a path: "spectrum" textures.
template <int N>
class SpectrumTextures {
  public:
    // Both must outlive it.
    SpectrumTextures(const Scene& scene, const NumberTextures& numbers)
        : scene_(scene), numbers_(numbers) {
        for (int c = 0; c < 3; ++c) basis_[c] = PackedSpectrum<N>(mallett_yuksel_basis()[c]);
        for (const Texture<SpectrumValue>& texture : scene.spectrum_textures) {
            parts_.emplace_back();
            const TextureParts<SpectrumValue> parts = texture_parts(texture);
            for (int i = 0; i < parts.count; ++i) parts_.back().push_back(pack(*parts.part[i]));
        }
    }

    static PackedValue<N> pack(const SpectrumValue& value) {
        return {value.texture < 0 ? PackedSpectrum<N>(value.constant) : PackedSpectrum<N>(),
                value.texture};
    }

    // A constant costs one load. Textures are unbounded: reflectance() holds them in [0, 1], which
    // constants are from the start.
    Packet<N> value(const PackedValue<N>& value, const TexturePoint& at, int phase) const {
        return value.texture < 0 ? value.constant[phase] : textured(value.texture, at, phase);
    }
    Packet<N> reflectance(const PackedValue<N>& value, const TexturePoint& at, int phase) const {
        if (value.texture < 0) return value.constant[phase];
        // In this order what is not a number becomes 0.
        return min(max(Packet<N>(0.0f), textured(value.texture, at, phase)), Packet<N>(1.0f));
    }

  private:
    Packet<N> textured(int texture, const TexturePoint& at, int phase) const {
        Packet<N> sum(0.0f);
        if (const auto& picture = numbers_.spectrum_pictures()[texture]) {
            const glm::dvec3 rgb = picture->rgb(texture_coordinates(picture->mapping(), at));
            for (int c = 0; c < 3; ++c) sum += Packet<N>(rgb[c]) * basis_[c][phase];
            return sum;
        }
        const TextureWeights w = numbers_.weights(scene_.spectrum_textures[texture], at);
        for (int i = 0; i < w.count; ++i) {
            if (w.weight[i] != 0) {
                sum += Packet<N>(w.weight[i]) * value(parts_[texture][i], at, phase);
            }
        }
        return sum;
    }

    const Scene& scene_;
    const NumberTextures& numbers_;
    PackedSpectrum<N> basis_[3];
    std::vector<std::vector<PackedValue<N>>> parts_;
};

}  // namespace drude
