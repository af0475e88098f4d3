// The direction in which a light's waves swing.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "scene/scene.h"

namespace drude {

// Whether any light of the scene is polarised.
bool has_polarised_lights(const Scene& scene);

// The degree of linear polarisation of light that arrives from somewhere, and the direction along
// which it is polarised: unit, across the ray, in the world. Its sign means nothing. The Stokes
// vector in a frame whose x axis is turned from it by an angle a is (1, dop cos 2a, dop sin 2a, 0).
struct ArrivingPolarisation {
    float dop = 0;
    glm::vec3 axis{0};
};

// A light whose polarisation is the same everywhere in its own space.
class UniformPolarisation {
  public:
    UniformPolarisation() = default;
    // `handedness` is that of the picture (camera_ray.h).
    UniformPolarisation(const LightPolarisation& polarisation, double handedness);

    bool none() const { return !(dop_ > 0); }
    // Along d, unit, from the viewer to the light. The angle zero is the direction `zero` (of any
    // length but 0), projected across d; where d runs along it, any direction.
    ArrivingPolarisation arriving(const glm::vec3& d, const glm::vec3& zero) const;

  private:
    float dop_ = 0, cosine_ = 1, sine_ = 0;  // the sine with the sign of -h
};

// An infinite light: its angle zero is cross(d, the light's z), or its pattern that of a clear sky.
class SkyPolarisation {
  public:
    SkyPolarisation() = default;
    SkyPolarisation(const InfiniteLight& light, double handedness);

    bool none() const { return !(maximum_ > 0) && uniform_.none(); }
    ArrivingPolarisation arriving(const glm::vec3& d) const;

  private:
    UniformPolarisation uniform_;
    float maximum_ = 0;                  // of a clear sky
    glm::vec3 sun_{0, 0, 1};             // world, unit
    glm::vec3 x_{1, 0, 0}, z_{0, 0, 1};  // of the light, world, unit
};

}  // namespace drude
