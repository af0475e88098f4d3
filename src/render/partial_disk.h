// A disk or ring, or a sector of one, intersected in double in its own space.
#pragma once

#include <algorithm>

#include "render/round_frame.h"
#include "scene/scene.h"

namespace drude {

class PartialDisk : public RoundFrame {
  public:
    PartialDisk(const Disk& disk, const glm::dmat4& world_from_object)
        : RoundFrame(world_from_object, disk.phi_max_deg, std::hypot(disk.radius, disk.height)),
          radius_(disk.radius),
          inner_(disk.inner_radius),
          height_(disk.height) {}

    glm::dvec3 low() const { return {-radius_, -radius_, height_}; }
    glm::dvec3 high() const { return {radius_, radius_, height_}; }

    glm::dvec3 on_surface(const glm::dvec3& object_point) const {
        return {object_point.x, object_point.y, height_};
    }
    glm::dvec3 normal(const glm::dvec3&) const { return {0, 0, 1}; }
    // u is the part of phi, v runs from the outer edge to the inner one (as pbrt-v4).
    glm::dvec2 uv(const glm::dvec3& object_point) const {
        const double r = std::hypot(object_point.x, object_point.y);
        return {u(object_point), std::clamp((radius_ - r) / (radius_ - inner_), 0.0, 1.0)};
    }

    double object_area() const { return phi_max() / 2 * (radius_ - inner_) * (radius_ + inner_); }
    // Uniform in that area for uniform u: the square of the radius is uniform.
    glm::dvec3 sample(const glm::dvec2& u) const {
        const double r = std::sqrt(inner_ * inner_ + u.x * (radius_ - inner_) * (radius_ + inner_));
        const double angle = u.y * phi_max();
        return {r * std::cos(angle), r * std::sin(angle), height_};
    }

    // As PartialSphere::intersect().
    double intersect(const glm::dvec3& o_world, const glm::dvec3& d_world, double t_min,
                     double t_max) const {
        const glm::dvec3 o = to_object(o_world), d = direction_to_object(d_world);
        const double t = (height_ - o.z) / d.z;
        if (!(t > t_min && t < t_max)) return -1;
        const glm::dvec3 p = o + t * d;
        const double r2 = p.x * p.x + p.y * p.y;
        return r2 <= radius_ * radius_ && r2 >= inner_ * inner_ && keeps_phi(p) ? t : -1;
    }

  private:
    double radius_, inner_, height_;
};

}  // namespace drude
