// A sphere cut in z and phi, intersected in double in its own space.
#pragma once

#include <algorithm>

#include "render/round_frame.h"
#include "scene/scene.h"

namespace drude {

class PartialSphere : public RoundFrame {
  public:
    PartialSphere(const Sphere& sphere, const glm::dmat4& world_from_object)
        : RoundFrame(world_from_object, sphere.phi_max_deg, sphere.radius),
          radius_(sphere.radius),
          z_min_(std::max(sphere.z_min, -sphere.radius)),
          z_max_(std::min(sphere.z_max, sphere.radius)),
          theta_min_(std::acos(z_min_ / radius_)),
          theta_max_(std::acos(z_max_ / radius_)),
          whole_(z_min_ <= -radius_ && z_max_ >= radius_ && all_round()) {}

    // A box around it in object space.
    glm::dvec3 low() const { return {-widest(), -widest(), z_min_}; }
    glm::dvec3 high() const { return {widest(), widest(), z_max_}; }

    // The point of the surface on the same radius, in object space.
    glm::dvec3 on_surface(const glm::dvec3& object_point) const {
        return object_point * (radius_ / glm::length(object_point));
    }
    // Outward, of any length; `object_point` need not lie on the surface exactly.
    glm::dvec3 normal(const glm::dvec3& object_point) const { return object_point; }
    // u is the part of phi, v that of theta from z_min to z_max; both in [0, 1] (as pbrt-v4).
    glm::dvec2 uv(const glm::dvec3& object_point) const {
        const double cosine = object_point.z / glm::length(object_point);
        const double theta = std::acos(std::clamp(cosine, -1.0, 1.0));
        const double v = (theta - theta_min_) / (theta_max_ - theta_min_);
        return {u(object_point), std::clamp(v, 0.0, 1.0)};
    }

    // In its own space.
    double object_area() const { return phi_max() * radius_ * (z_max_ - z_min_); }
    // Uniform in that area for uniform u (Archimedes: z and phi are uniform).
    glm::dvec3 sample(const glm::dvec2& u) const {
        const double z = z_min_ + u.x * (z_max_ - z_min_), angle = u.y * phi_max();
        const double r = std::sqrt(std::max(0.0, radius_ * radius_ - z * z));
        return {r * std::cos(angle), r * std::sin(angle), z};
    }

    // The smallest t in (t_min, t_max) at which o + t d (world space) meets the surface, or a
    // negative number. The discriminant comes from the ray's distance to the centre, which keeps
    // its digits when the sphere is small and far (Haines et al. 2019, Ray Tracing Gems, ch. 7).
    double intersect(const glm::dvec3& o_world, const glm::dvec3& d_world, double t_min,
                     double t_max) const {
        const glm::dvec3 o = to_object(o_world), d = direction_to_object(d_world);
        const double a = glm::dot(d, d), over_a = 1 / a;
        const double b = -glm::dot(o, d);
        const glm::dvec3 closest = o + (b * over_a) * d;
        const double gap = radius_ * radius_ - glm::dot(closest, closest);
        if (!(gap >= 0)) return -1;
        const double c = glm::dot(o, o) - radius_ * radius_;
        const double q = b + std::copysign(std::sqrt(a * gap), b);
        double t0 = c / q, t1 = q * over_a;
        if (t0 > t1) std::swap(t0, t1);
        for (const double t : {t0, t1}) {
            if (t > t_min && t < t_max && keeps(o + t * d)) return t;
        }
        return -1;
    }

  private:
    bool keeps(const glm::dvec3& p) const {
        if (whole_) return true;
        return p.z >= z_min_ && p.z <= z_max_ && keeps_phi(p);
    }
    // Radius of the widest circle between the cuts.
    double widest() const {
        if (z_min_ <= 0 && z_max_ >= 0) return radius_;
        const double nearest = std::min(std::abs(z_min_), std::abs(z_max_));
        return std::sqrt(std::max(0.0, radius_ * radius_ - nearest * nearest));
    }

    double radius_, z_min_, z_max_;
    double theta_min_, theta_max_;  // at z_min and z_max; theta is measured from +z
    bool whole_;
};

}  // namespace drude
