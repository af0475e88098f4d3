// The reference integrator's lights in double: the pictures of infinite lights looked up, the
// intensity of point lights, and the Stokes vectors of what is polarised. Nothing is sampled.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "image/image.h"
#include "materials/mueller.h"
#include "scene/scene.h"

namespace drude {

// Linear between the spectrum's whole nanometres; nm in [380, 780].
double spectrum_at(const DenseSpectrum& spectrum, double nm);

// The Stokes vector, for S0 = 1, of light that travels along k, in the frame of x axis `frame`
// (unit, across k) and handedness h. Its angle zero is the projection of `zero` across k.
Stokes<double> emitted_stokes(const LightPolarisation& light, const glm::dvec3& zero,
                              const glm::dvec3& k, const glm::dvec3& frame, double handedness);

// W sr^-1 nm^-1 that a point light or spot sends towards the point `at`.
double intensity_towards(const PointLight& light, const glm::dvec3& at, double nm);

class ReferenceSky {
  public:
    // Keeps a reference to `light`. Reads its picture, if any: throws Error (user) where it cannot.
    explicit ReferenceSky(const InfiniteLight& light);

    // Radiance that arrives from world direction d (unit, away from the viewer). Texels are
    // constant; what is negative or not finite in them counts as 0.
    double radiance(const glm::dvec3& d, double nm) const;

    // The Stokes vector, for S0 = 1, of what arrives from d, in the frame of x axis `frame` (unit,
    // across d) on the ray along -d.
    Stokes<double> stokes(const glm::dvec3& d, const glm::dvec3& frame, double handedness) const;

  private:
    const InfiniteLight& light_;
    Image image_;
    glm::dmat3 light_from_world_;
    std::array<DenseSpectrum, 3> basis_;  // of light of R, G, B = 1
};

}  // namespace drude
