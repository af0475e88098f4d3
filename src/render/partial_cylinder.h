// The side of a cylinder, or a sector of it, intersected in double in its own space.
#pragma once

#include <algorithm>

#include "render/round_frame.h"
#include "scene/scene.h"

namespace drude {

class PartialCylinder : public RoundFrame {
  public:
    PartialCylinder(const Cylinder& cylinder, const glm::dmat4& world_from_object)
        : RoundFrame(world_from_object, cylinder.phi_max_deg,
                     std::hypot(cylinder.radius,
                                std::max(std::abs(cylinder.z_min), std::abs(cylinder.z_max)))),
          radius_(cylinder.radius),
          z_min_(cylinder.z_min),
          z_max_(cylinder.z_max) {}

    glm::dvec3 low() const { return {-radius_, -radius_, z_min_}; }
    glm::dvec3 high() const { return {radius_, radius_, z_max_}; }

    glm::dvec3 on_surface(const glm::dvec3& object_point) const {
        const double scale = radius_ / std::hypot(object_point.x, object_point.y);
        return {object_point.x * scale, object_point.y * scale, object_point.z};
    }
    glm::dvec3 normal(const glm::dvec3& object_point) const {
        return {object_point.x, object_point.y, 0};
    }
    // u is the part of phi, v that of the height (as pbrt-v4).
    glm::dvec2 uv(const glm::dvec3& object_point) const {
        return {u(object_point),
                std::clamp((object_point.z - z_min_) / (z_max_ - z_min_), 0.0, 1.0)};
    }

    double object_area() const { return phi_max() * radius_ * (z_max_ - z_min_); }
    glm::dvec3 sample(const glm::dvec2& u) const {
        const double angle = u.y * phi_max();
        return {radius_ * std::cos(angle), radius_ * std::sin(angle),
                z_min_ + u.x * (z_max_ - z_min_)};
    }

    // As PartialSphere::intersect(), with the ray's distance to the axis.
    double intersect(const glm::dvec3& o_world, const glm::dvec3& d_world, double t_min,
                     double t_max) const {
        const glm::dvec3 o = to_object(o_world), d = direction_to_object(d_world);
        const glm::dvec2 across_o(o), across_d(d);
        const double a = glm::dot(across_d, across_d);
        if (!(a > 0)) return -1;  // along the axis
        const double b = -glm::dot(across_o, across_d);
        const glm::dvec2 closest = across_o + (b / a) * across_d;
        const double gap = radius_ * radius_ - glm::dot(closest, closest);
        if (!(gap >= 0)) return -1;
        const double c = glm::dot(across_o, across_o) - radius_ * radius_;
        const double q = b + std::copysign(std::sqrt(a * gap), b);
        double t0 = c / q, t1 = q / a;
        if (t0 > t1) std::swap(t0, t1);
        for (const double t : {t0, t1}) {
            if (!(t > t_min && t < t_max)) continue;
            const glm::dvec3 p = o + t * d;
            if (p.z >= z_min_ && p.z <= z_max_ && keeps_phi(p)) return t;
        }
        return -1;
    }

  private:
    double radius_, z_min_, z_max_;
};

}  // namespace drude
