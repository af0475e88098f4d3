// Texture "imagemap": what a picture gives at (s, t).
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "image/texel_source.h"
#include "scene/textures.h"

namespace drude {

class TexturePicture {
  public:
    // `source` may be shared. The values follow from `texture`'s wrap, filter, scale, invert and
    // encoding.
    TexturePicture(const ImageTexture& texture, std::shared_ptr<const TexelSource> source);

    // As in pbrt-v4: t = 0 is the bottom edge; pixel centres lie at (i + 1/2) / size; encoded
    // values are made linear before they are averaged; then comes the scale, then 1 - value where
    // inverted. Colours are 0 at least; a picture of one channel is grey.
    glm::dvec3 rgb(const glm::dvec2& st) const;
    // The first channel.
    double number(const glm::dvec2& st) const;

    const TextureMapping& mapping() const { return texture_.mapping; }

  private:
    // Before scale and invert.
    glm::dvec3 look_up(glm::dvec2 st) const;
    // Four corners of a square of pixels; those that wrap around or are black come singly.
    void corners(long long x, long long y, glm::dvec3 values[4]) const;
    glm::dvec3 texel(long long x, long long y) const;
    double decode(float value) const;
    glm::dvec3 colour(const float* values) const;

    ImageTexture texture_;
    std::shared_ptr<const TexelSource> source_;
    std::array<float, 256> decoded_{};  // of 8-bit values
};

}  // namespace drude
