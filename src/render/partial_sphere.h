// A sphere cut in z and phi, intersected in double in its own space.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "materials/scalar.h"
#include "scene/scene.h"

namespace drude {

class PartialSphere {
  public:
    PartialSphere(const Sphere& sphere, const glm::dmat4& world_from_object)
        : world_from_object_(world_from_object),
          object_from_world_(glm::inverse(world_from_object)),
          radius_(sphere.radius),
          z_min_(std::max(sphere.z_min, -sphere.radius)),
          z_max_(std::min(sphere.z_max, sphere.radius)),
          phi_max_(sphere.phi_max_deg * pi / 180),
          whole_(z_min_ <= -radius_ && z_max_ >= radius_ && sphere.phi_max_deg >= 360) {}

    bool whole() const { return whole_; }
    double radius() const { return radius_; }
    double z_min() const { return z_min_; }
    double z_max() const { return z_max_; }
    double phi_max() const { return phi_max_; }
    const glm::dmat4& world_from_object() const { return world_from_object_; }

    glm::dvec3 to_object(const glm::dvec3& p) const {
        return glm::dvec3(object_from_world_ * glm::dvec4(p, 1));
    }
    glm::dvec3 to_world(const glm::dvec3& p) const {
        return glm::dvec3(world_from_object_ * glm::dvec4(p, 1));
    }
    glm::dvec3 direction_to_object(const glm::dvec3& d) const {
        return glm::dvec3(object_from_world_ * glm::dvec4(d, 0));
    }
    // Outward normal in the world at a point of the object's surface, unit.
    glm::dvec3 world_normal(const glm::dvec3& object_point) const {
        return glm::normalize(glm::transpose(glm::dmat3(object_from_world_)) * object_point);
    }
    // World area per object area where the object's outward normal is n (unit): that of a surface
    // element is |det M| |M^-T n|.
    double area_stretch(const glm::dvec3& n) const {
        return std::abs(glm::determinant(glm::dmat3(world_from_object_))) *
               glm::length(glm::transpose(glm::dmat3(object_from_world_)) * n);
    }
    // What rounding in double does to the world's coordinates of a point of the surface.
    double rounding() const {
        double size = glm::length(glm::dvec3(world_from_object_[3]));
        for (int i = 0; i < 3; ++i)
            size += radius_ * glm::length(glm::dvec3(world_from_object_[i]));
        return 16 * std::numeric_limits<double>::epsilon() * size;
    }
    // The point of the surface on the same radius, in object space.
    glm::dvec3 on_surface(const glm::dvec3& object_point) const {
        return object_point * (radius_ / glm::length(object_point));
    }

    // The smallest t in (t_min, t_max) at which o + t d (world space) meets the surface, or a
    // negative number. The discriminant comes from the ray's distance to the centre, which keeps
    // its digits when the sphere is small and far (Haines et al. 2019, Ray Tracing Gems, ch. 7).
    double intersect(const glm::dvec3& o_world, const glm::dvec3& d_world, double t_min,
                     double t_max) const {
        const glm::dvec3 o = to_object(o_world), d = direction_to_object(d_world);
        const double a = glm::dot(d, d);
        const double b = -glm::dot(o, d);
        const glm::dvec3 closest = o + (b / a) * d;
        const double gap = radius_ * radius_ - glm::dot(closest, closest);
        if (!(gap >= 0)) return -1;
        const double c = glm::dot(o, o) - radius_ * radius_;
        const double q = b + std::copysign(std::sqrt(a * gap), b);
        double t0 = c / q, t1 = q / a;
        if (t0 > t1) std::swap(t0, t1);
        for (const double t : {t0, t1}) {
            if (t > t_min && t < t_max && keeps(o + t * d)) return t;
        }
        return -1;
    }

  private:
    bool keeps(const glm::dvec3& p) const {
        if (whole_) return true;
        if (p.z < z_min_ || p.z > z_max_) return false;
        if (phi_max_ >= 2 * pi) return true;
        double phi = std::atan2(p.y, p.x);
        if (phi < 0) phi += 2 * pi;
        return phi <= phi_max_;
    }

    glm::dmat4 world_from_object_, object_from_world_;
    double radius_, z_min_, z_max_, phi_max_;
    bool whole_;
};

}  // namespace drude
