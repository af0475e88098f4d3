// An image around the scene: lookup, importance sampling, density.
//
// Two layouts. Lat-long (width = 2 height): light-space direction
// (sin t cos p, sin t sin p, cos t), t = pi (y + 1/2)/height, p = 2 pi (x + 1/2)/width, z up.
// Equal-area octahedral (square; Clarberg 2008, JGT 13(1)), as pbrt-v4 wants it. The radiance of a
// texel is constant over it, so that sampling by it leaves no noise of its own.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "base/huge_pages.h"
#include "image/image.h"
#include "render/cumulative.h"

namespace drude {

class Environment {
  public:
    // Channels R, G, B (or Y) of `image`, times `scale`. Negative and non-finite texels become 0
    // and are counted. Throws Error (user), naming `where`, unless the picture is 2:1 or square,
    // has colour and is not black all over.
    // `compensated`: see sample().
    Environment(const Image& image, double scale, const glm::dmat4& world_from_light,
                const std::string& where, bool compensated = true);

    // Linear RGB radiance that arrives from world direction d (unit, away from the viewer).
    glm::vec3 radiance(const glm::vec3& d) const;
    // The same with the density of sample(), which is 0 where it never goes.
    struct Light {
        glm::vec3 radiance;
        float pdf = 0;  // per solid angle
    };
    Light light(const glm::vec3& d) const;

    struct Sample {
        glm::vec3 d;         // world direction towards the light
        glm::vec3 radiance;  // linear RGB
        float pdf = 0;       // per solid angle
    };
    // Sampled in proportion to luminance less its mean (MIS compensation: Karlik et al. 2019, ACM
    // TOG 38(6)): what lobe sampling finds by itself is left to it. Without compensation in
    // proportion to luminance. Uniform numbers in [0, 1).
    Sample sample(const glm::vec2& u) const;
    float pdf(const glm::vec3& d) const { return light(d).pdf; }

    int repaired_texels() const { return repaired_; }
    double mean_luminance() const { return mean_luminance_; }

  private:
    // `l` in light space, of any length.
    size_t texel(const glm::vec3& l) const;
    size_t texel_of_group(size_t y, size_t first, float u, float* inside) const;

    bool lat_long_;
    int width_, height_;
    glm::mat3 light_from_world_, world_from_light_;  // of determinant +-1
    HugePageVector<glm::vec4> texels_;  // radiance, and the density over the unit square
    // Texels are chosen by row, by group of neighbours in it, and within the group by the texels
    // themselves: they fill the cache line that is read for the radiance anyway.
    static constexpr int group_size = 4;
    CumulativeRows rows_, groups_;
    std::vector<float> edge_;  // lat-long: cosines between the rows
    int repaired_ = 0;
    double mean_luminance_ = 0;
};

}  // namespace drude
