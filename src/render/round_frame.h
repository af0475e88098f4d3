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
        : to_world_(world_from_object),
          world_origin_(world_from_object[3]),
          phi_max_(phi_max_deg >= 360 ? 2 * pi : phi_max_deg * pi / 180),
          all_round_(phi_max_deg >= 360) {
        const glm::dmat4 inverse = glm::inverse(world_from_object);
        to_object_ = glm::dmat3(inverse);
        object_origin_ = glm::dvec3(inverse[3]);
        normal_to_world_ = glm::transpose(to_object_);
        double size = glm::length(world_origin_);
        for (int i = 0; i < 3; ++i) size += extent * glm::length(to_world_[i]);
        rounding_ = 16 * std::numeric_limits<double>::epsilon() * size;
    }

    glm::dvec3 to_object(const glm::dvec3& p) const { return to_object_ * p + object_origin_; }
    glm::dvec3 to_world(const glm::dvec3& p) const { return to_world_ * p + world_origin_; }
    glm::dvec3 direction_to_object(const glm::dvec3& d) const { return to_object_ * d; }
    // The world's unit normal of an object normal of any length.
    glm::dvec3 world_normal(const glm::dvec3& n) const {
        return glm::normalize(normal_to_world_ * n);
    }
    // World area per object area where the object's normal is n (unit): that of a surface element
    // is |det M| |M^-T n|.
    double area_stretch(const glm::dvec3& n) const {
        return std::abs(glm::determinant(to_world_)) * glm::length(normal_to_world_ * n);
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
    glm::dmat3 to_world_, to_object_{1}, normal_to_world_{1};
    glm::dvec3 world_origin_, object_origin_{0};
    double phi_max_, rounding_;
    bool all_round_;
};

}  // namespace drude
