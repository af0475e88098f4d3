// From a point of the picture to a ray, and the picture's own axes for polarised light.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "image/equal_area.h"
#include "materials/scalar.h"
#include "scene/scene.h"

namespace drude {

struct CameraRay {
    glm::vec3 o, d;        // world; d unit
    glm::vec3 horizontal;  // of the pixel, across d: S1 > 0 lies along it
};

// +1 where the world is right-handed as the picture shows it, -1 where it is left-handed (an
// ordinary pbrt scene): the h of y = h cross(k, x) in every frame of polarised light.
//
// Polarisation is seen with the eyes of the picture, so h is minus the sign of the triple product
// of the picture's right, its up and the viewing direction. Those are the camera's x, y, z, except
// that pbrt-v4's equirectangular picture runs the other way round: seen from within, directions
// further to its right lie further to the left (azimuths grow from camera x, the right, to camera
// z, ahead).
inline double picture_handedness(const Camera& camera) {
    const bool mirrored = camera.kind == CameraKind::spherical && !camera.equal_area;
    return (glm::determinant(glm::dmat3(camera.world_from_camera)) > 0) != mirrored ? -1 : 1;
}

// Uniform in [0, 1)^2 to uniform in the unit disk, with little distortion (Shirley & Chiu 1997, J.
// Graphics Tools 2(3)).
inline glm::dvec2 concentric_disk(const glm::vec2& u) {
    const double x = 2 * static_cast<double>(u.x) - 1, y = 2 * static_cast<double>(u.y) - 1;
    if (x == 0 && y == 0) return {0, 0};
    const bool across = std::abs(x) > std::abs(y);
    const double r = across ? x : y;
    const double angle = across ? y / x * pi / 4 : pi / 2 - x / y * pi / 4;
    return {r * std::cos(angle), r * std::sin(angle)};
}

class CameraRays {
  public:
    CameraRays(const Camera& camera, int width, int height)
        : kind_(camera.kind),
          equal_area_(camera.equal_area),
          axes_(camera.world_from_camera),
          origin_(camera.world_from_camera[3]),
          // An orthographic window is in the camera's own units.
          tangent_(camera.kind == CameraKind::perspective ? std::tan(camera.fov_deg * pi / 360)
                                                          : 1),
          lens_radius_(camera.kind == CameraKind::spherical ? 0 : camera.lens_radius),
          focal_distance_(camera.focal_distance),
          handedness_(static_cast<float>(picture_handedness(camera))) {
        for (int i = 0; i < 4; ++i) window_[i] = camera.screen_window[i];
        step_x_ = (window_[1] - window_[0]) / width;
        step_y_ = (window_[3] - window_[2]) / height;
        corner_ = axes_ * glm::dvec3(window_[0] * tangent_, window_[3] * tangent_, 1);
        along_x_ = axes_[0] * (step_x_ * tangent_);
        along_y_ = axes_[1] * (-step_y_ * tangent_);
        is_pinhole_ = kind_ == CameraKind::perspective && !(lens_radius_ > 0);
        up_ = glm::vec3(glm::normalize(axes_[1]));
        right_ = glm::vec3(glm::normalize(axes_[0]));
    }

    float handedness() const { return handedness_; }
    glm::dvec3 origin() const { return origin_; }
    // Whether rays depend on `lens_u`; otherwise no random numbers need be drawn for it.
    bool has_lens() const { return lens_radius_ > 0; }

    // (x, y) in pixels, y downwards from the top edge; lens_u uniform in [0, 1)^2, of which
    // (0.5, 0.5) is the middle of the lens.
    CameraRay operator()(double x, double y, const glm::vec2& lens_u = {0.5f, 0.5f}) const {
        if (is_pinhole_) {
            return ray(glm::vec3(origin_), glm::vec3(corner_ + x * along_x_ + y * along_y_));
        }
        const double right = window_[0] + x * step_x_, up = window_[3] - y * step_y_;
        glm::dvec3 from(0), towards;
        switch (kind_) {
            case CameraKind::perspective:
                towards = {right * tangent_, up * tangent_, 1};
                break;
            case CameraKind::orthographic:
                from = {right, up, 0};
                towards = {0, 0, 1};
                break;
            case CameraKind::spherical:
                return camera_ray(from, direction_around(right, 1 - up));
        }
        if (lens_radius_ > 0) {
            // All rays of a point of the picture meet in the plane of focus.
            const glm::dvec3 lens(lens_radius_ * concentric_disk(lens_u), 0);
            towards = towards * focal_distance_ - lens;
            from += lens;
        }
        return camera_ray(from, towards);
    }

  private:
    // In camera space.
    CameraRay camera_ray(const glm::dvec3& from, const glm::dvec3& towards) const {
        return ray(glm::vec3(origin_ + axes_ * from), glm::vec3(axes_ * towards));
    }

    // In the world; `towards` of any length.
    CameraRay ray(const glm::vec3& o, const glm::vec3& towards) const {
        const glm::vec3 d = glm::normalize(towards);
        // Across the ray and the camera's own up; where the ray runs along it, camera x serves.
        glm::vec3 across = glm::cross(d, up_);
        if (glm::dot(across, across) < 1e-12f) across = right_ - glm::dot(right_, d) * d;
        return {o, d, glm::normalize(across)};
    }

    // Camera space; u, v from 0 to 1 over the whole picture, v downwards. Both mappings have
    // their pole, which is +z in light space, upwards.
    glm::dvec3 direction_around(double u, double v) const {
        if (equal_area_) {
            const glm::dvec3 d = equal_area_direction(wrapped_equal_area(glm::dvec2(u, v)));
            return {d.x, d.z, d.y};
        }
        const double theta = pi * v, phi = 2 * pi * u;
        return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
    }

    CameraKind kind_;
    bool equal_area_;
    glm::dmat3 axes_;
    glm::dvec3 origin_;
    // Of a pinhole: the direction of the upper left corner, and its steps a pixel.
    glm::dvec3 corner_{0}, along_x_{0}, along_y_{0};
    bool is_pinhole_ = false;
    glm::vec3 up_{0, 1, 0}, right_{1, 0, 0};
    double tangent_, window_[4], step_x_, step_y_;
    double lens_radius_, focal_distance_;
    float handedness_;
};

}  // namespace drude
