// The reference integrator's camera: the picture's rays in double, by formulas of its own.
#pragma once

#include <glm/vec3.hpp>

#include "scene/scene.h"

namespace drude {

struct ReferenceRay {
    glm::dvec3 o, d;        // world; d unit
    glm::dvec3 horizontal;  // of the pixel, unit, across d: S1 > 0 lies along it
};

class ReferenceCamera {
  public:
    // Keeps a reference to `scene`.
    explicit ReferenceCamera(const Scene& scene);

    // Through (x, y) in pixels, y downwards. u1, u2 uniform in [0, 1) choose a point of the lens.
    ReferenceRay ray(double x, double y, double u1 = 0, double u2 = 0) const;
    bool has_lens() const {
        return scene_.camera.kind != CameraKind::spherical && scene_.camera.lens_radius > 0;
    }
    // The h of y = h cross(k, x): found by looking where neighbouring rays go.
    double handedness() const { return handedness_; }

  private:
    const Scene& scene_;
    double handedness_ = -1;
};

}  // namespace drude
