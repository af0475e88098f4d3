// From a point of the picture to a ray, and the picture's own axes for polarised light.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "materials/scalar.h"
#include "scene/scene.h"

namespace drude {

struct CameraRay {
    glm::vec3 o, d;        // world; d unit
    glm::vec3 horizontal;  // of the pixel, across d: S1 > 0 lies along it
};

class CameraRays {
  public:
    CameraRays(const Camera& camera, int width, int height)
        : axes_(camera.world_from_camera),
          origin_(camera.world_from_camera[3]),
          tangent_(std::tan(camera.fov_deg * pi / 360)) {
        for (int i = 0; i < 4; ++i) window_[i] = camera.screen_window[i];
        step_x_ = (window_[1] - window_[0]) / width;
        step_y_ = (window_[3] - window_[2]) / height;
        up_ = glm::normalize(axes_[1]);
        right_ = glm::normalize(axes_[0]);
        // Polarisation is seen with the eyes of the picture: where the world's coordinates are
        // left-handed (an ordinary pbrt scene), cross products turn the other way.
        handedness_ = glm::determinant(axes_) > 0 ? -1.0f : 1.0f;
    }

    float handedness() const { return handedness_; }
    glm::dvec3 origin() const { return origin_; }

    // (x, y) in pixels, y downwards from the top edge.
    CameraRay operator()(double x, double y) const {
        const glm::dvec3 local((window_[0] + x * step_x_) * tangent_,
                               (window_[3] - y * step_y_) * tangent_, 1);
        const glm::dvec3 d = glm::normalize(axes_ * local);
        // Across the ray and the camera's own up; where the ray runs along it, camera x serves.
        glm::dvec3 across = glm::cross(d, up_);
        if (glm::dot(across, across) < 1e-12) across = right_ - glm::dot(right_, d) * d;
        return {glm::vec3(origin_), glm::vec3(d), glm::vec3(glm::normalize(across))};
    }

  private:
    glm::dmat3 axes_;
    glm::dvec3 origin_, up_{0, 1, 0}, right_{1, 0, 0};
    double tangent_, window_[4], step_x_, step_y_;
    float handedness_;
};

}  // namespace drude
