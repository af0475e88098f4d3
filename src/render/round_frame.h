// What spheres, disks and cylinders have in common: an exact surface in its own space, turned about
// z, and everything in double. A surface adds intersect(), on_surface(), normal(), uv(), sample(),
// object_area(), low(), high().
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "materials/scalar.h"

namespace drude {

class RoundFrame {
  public:
    // phi_max_deg in (0, 360]; `extent`: no point of the surface is farther from its own origin.
    RoundFrame(const glm::dmat4& world_from_object, double phi_max_deg, double extent)
        : world_from_object_(world_from_object),
          object_from_world_(glm::inverse(world_from_object)),
          phi_max_(phi_max_deg >= 360 ? 2 * pi : phi_max_deg * pi / 180),
          all_round_(phi_max_deg >= 360) {
        double size = glm::length(glm::dvec3(world_from_object_[3]));
        for (int i = 0; i < 3; ++i) size += extent * glm::length(glm::dvec3(world_from_object_[i]));
        rounding_ = 16 * std::numeric_limits<double>::epsilon() * size;
    }

    glm::dvec3 to_object(const glm::dvec3& p) const {
        return glm::dvec3(object_from_world_ * glm::dvec4(p, 1));
    }
    glm::dvec3 to_world(const glm::dvec3& p) const {
        return glm::dvec3(world_from_object_ * glm::dvec4(p, 1));
    }
    glm::dvec3 direction_to_object(const glm::dvec3& d) const {
        return glm::dvec3(object_from_world_ * glm::dvec4(d, 0));
    }
    // The world's unit normal of an object normal of any length.
    glm::dvec3 world_normal(const glm::dvec3& n) const {
        return glm::normalize(glm::transpose(glm::dmat3(object_from_world_)) * n);
    }
    // World area per object area where the object's normal is n (unit): that of a surface element
    // is |det M| |M^-T n|.
    double area_stretch(const glm::dvec3& n) const {
        return std::abs(glm::determinant(glm::dmat3(world_from_object_))) *
               glm::length(glm::transpose(glm::dmat3(object_from_world_)) * n);
    }
    // What rounding in double does to the world's coordinates of a point of the surface.
    double rounding() const { return rounding_; }

    double phi_max() const { return phi_max_; }
    bool all_round() const { return all_round_; }

  protected:
    // Angle about z in [0, 2 pi).
    static double phi(const glm::dvec3& p) {
        const double angle = std::atan2(p.y, p.x);
        return angle < 0 ? angle + 2 * pi : angle;
    }
    bool keeps_phi(const glm::dvec3& p) const { return all_round_ || phi(p) <= phi_max_; }
    // pbrt's u. Rounding may put a point beyond the edge of its sector.
    double u(const glm::dvec3& p) const { return std::fmin(phi(p) / phi_max_, 1.0); }

  private:
    glm::dmat4 world_from_object_, object_from_world_;
    double phi_max_, rounding_;
    bool all_round_;
};

}  // namespace drude
