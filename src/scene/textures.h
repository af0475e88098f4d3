// Values that may change over a surface: constants, and textures that are named, nested and shared.
//
// Textures are a list in which a texture comes behind those it is made of, so that an index always
// points backwards and nothing can be circular.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <variant>
#include <vector>

#include "base/error.h"
#include "materials/spectrum.h"

namespace drude {

// A number or a spectrum that is the same everywhere, or, with texture >= 0, the value of a texture
// of Scene::number_textures or Scene::spectrum_textures. Beside a texture `constant` holds one
// value that is typical of it, for estimates and choices (never for a picture).
struct NumberValue {
    double constant = 0;
    int texture = -1;
};
struct SpectrumValue {
    DenseSpectrum constant{};
    int texture = -1;
};

// From a point of a surface to (s, t).
struct TextureMapping {
    enum class Kind { uv, spherical, cylindrical, planar };
    Kind kind = Kind::uv;
    double scale_u = 1, scale_v = 1;      // uv
    double delta_u = 0, delta_v = 0;      // uv, planar
    glm::dvec3 v1{1, 0, 0}, v2{0, 1, 0};  // planar
    glm::dmat4 texture_from_world{1};
};

template <class Value>
struct ConstantTexture {
    Value value;
};

struct ImageTexture {
    enum class Wrap { repeat, black, clamp };
    enum class Encoding { srgb, linear, gamma };
    std::string path;  // resolved
    TextureMapping mapping;
    Wrap wrap = Wrap::repeat;
    bool bilinear = true;
    double scale = 1;
    bool invert = false;
    Encoding encoding = Encoding::srgb;  // of pictures whose samples are integers
    double gamma = 2.2;
    Place place;  // of its "filename"
};

// Two values in squares of (s, t), or in cubes of texture space.
template <class Value>
struct CheckerboardTexture {
    TextureMapping mapping;
    int dimension = 2;
    Value first, second;
};

template <class Value>
struct ScaleTexture {
    Value texture;
    NumberValue scale;
};

template <class Value>
struct MixTexture {
    Value first, second;
    NumberValue amount;
};

// Bilinear between four corners: v01 at s = 0, t = 1.
template <class Value>
struct BilerpTexture {
    TextureMapping mapping;
    Value v00, v01, v10, v11;
};

// `first` where the geometric normal lies along `direction`, `second` where it is perpendicular to
// it, weighted by the cosine between.
template <class Value>
struct DirectionMixTexture {
    Value first, second;
    glm::dvec3 direction{0, 1, 0};  // world, unit
};

template <class Value>
using Texture = std::variant<ConstantTexture<Value>, ImageTexture, CheckerboardTexture<Value>,
                             ScaleTexture<Value>, MixTexture<Value>, BilerpTexture<Value>,
                             DirectionMixTexture<Value>>;

}  // namespace drude
