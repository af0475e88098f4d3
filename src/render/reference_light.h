// The reference integrator's infinite lights: a lookup of the picture in double, nothing sampled.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "image/image.h"
#include "scene/scene.h"

namespace drude {

// Linear between the spectrum's whole nanometres; nm in [380, 780].
double spectrum_at(const DenseSpectrum& spectrum, double nm);

class ReferenceSky {
  public:
    // Keeps a reference to `light`. Reads its picture, if any: throws Error (user) where it cannot.
    explicit ReferenceSky(const InfiniteLight& light);

    // Radiance that arrives from world direction d (unit, away from the viewer). Texels are
    // constant; what is negative or not finite in them counts as 0.
    double radiance(const glm::dvec3& d, double nm) const;

  private:
    const InfiniteLight& light_;
    Image image_;
    glm::dmat3 light_from_world_;
    std::array<DenseSpectrum, 3> basis_;  // of light of R, G, B = 1
};

}  // namespace drude
