#include "render/reference_geometry.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "materials/scalar.h"

namespace drude {

ReferenceGeometry::ReferenceGeometry(const Scene& scene) {
    for (size_t i = 0; i < scene.shapes.size(); ++i) {
        const Shape& shape = scene.shapes[i];
        if (shape.material < 0) continue;
        const glm::dmat4& m = shape.world_from_object;
        Primitive base;
        base.shape = static_cast<int>(i);
        base.flip = shape.reverse_orientation;
        base.world_from_object = m;
        base.object_from_world = glm::inverse(m);
        if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
            base.is_sphere = true;
            base.sphere = *sphere;
            primitives_.push_back(base);
            continue;
        }
        const auto& mesh = std::get<TriangleMesh>(shape.geometry);
        // A mirroring transformation turns the winding round.
        if (glm::determinant(glm::dmat3(m)) < 0) base.flip = !base.flip;
        base.has_normals = !mesh.normals.empty();
        const glm::dmat3 normal_matrix = glm::transpose(glm::inverse(glm::dmat3(m)));
        for (const glm::uvec3& t : mesh.triangles) {
            Primitive p = base;
            for (int c = 0; c < 3; ++c) {
                p.corner[c] = glm::dvec3(m * glm::dvec4(mesh.positions[t[c]], 1));
                if (p.has_normals) {
                    p.normal[c] = glm::normalize(normal_matrix * glm::dvec3(mesh.normals[t[c]]));
                    if (shape.reverse_orientation) p.normal[c] = -p.normal[c];
                }
            }
            primitives_.push_back(p);
        }
    }
}

// Cramer's rule on o + t d = a + v (b - a) + w (c - a) (Moeller & Trumbore 1997).
bool ReferenceGeometry::meet_triangle(const Primitive& p, const glm::dvec3& o, const glm::dvec3& d,
                                      ReferenceHit* hit) const {
    const glm::dvec3 e1 = p.corner[1] - p.corner[0], e2 = p.corner[2] - p.corner[0];
    const glm::dvec3 across = glm::cross(d, e2);
    const double determinant = glm::dot(e1, across);
    if (determinant == 0) return false;
    const glm::dvec3 to = o - p.corner[0];
    const double v = glm::dot(to, across) / determinant;
    if (!(v >= 0 && v <= 1)) return false;
    const glm::dvec3 other = glm::cross(to, e1);
    const double w = glm::dot(d, other) / determinant;
    if (!(w >= 0 && v + w <= 1)) return false;
    const double t = glm::dot(e2, other) / determinant;
    if (!(t > 0 && t < hit->t)) return false;
    hit->t = t;
    hit->p = o + t * d;
    hit->ng = glm::normalize(glm::cross(e1, e2));
    if (p.flip) hit->ng = -hit->ng;
    hit->ns = hit->ng;
    if (p.has_normals) {
        hit->ns = glm::normalize((1 - v - w) * p.normal[0] + v * p.normal[1] + w * p.normal[2]);
        if (glm::dot(hit->ns, hit->ng) < 0) hit->ng = -hit->ng;
    }
    return true;
}

bool ReferenceGeometry::meet_sphere(const Primitive& p, const glm::dvec3& o, const glm::dvec3& d,
                                    double t_min, ReferenceHit* hit) const {
    const glm::dvec3 a(p.object_from_world * glm::dvec4(o, 1));
    const glm::dvec3 b(p.object_from_world * glm::dvec4(d, 0));
    const double bb = glm::dot(b, b), ab = glm::dot(a, b);
    const double root = ab * ab - bb * (glm::dot(a, a) - p.sphere.radius * p.sphere.radius);
    if (root < 0) return false;
    for (const double sign : {-1.0, 1.0}) {
        const double t = (-ab + sign * std::sqrt(root)) / bb;
        if (!(t > t_min && t < hit->t)) continue;
        const glm::dvec3 q = a + t * b;
        double phi = std::atan2(q.y, q.x);
        if (phi < 0) phi += 2 * pi;
        const bool lower = p.sphere.z_min > -p.sphere.radius && q.z < p.sphere.z_min;
        const bool upper = p.sphere.z_max < p.sphere.radius && q.z > p.sphere.z_max;
        if (lower || upper || phi > p.sphere.phi_max_deg * pi / 180) continue;
        hit->t = t;
        hit->p = o + t * d;
        hit->ng = glm::normalize(glm::transpose(glm::dmat3(p.object_from_world)) * q);
        if (p.flip) hit->ng = -hit->ng;
        hit->ns = hit->ng;
        return true;
    }
    return false;
}

bool ReferenceGeometry::intersect(const glm::dvec3& o, const glm::dvec3& d, int from,
                                  ReferenceHit* hit) const {
    hit->t = std::numeric_limits<double>::infinity();
    hit->shape = -1;
    for (size_t i = 0; i < primitives_.size(); ++i) {
        const Primitive& p = primitives_[i];
        const bool leaves = static_cast<int>(i) == from;
        bool met = false;
        if (p.is_sphere) {
            // t is a length in the world, so the ray's own start lies within rounding of 0.
            const double own =
                1e-9 * (glm::length(o) + p.sphere.radius * glm::length(p.world_from_object[0]));
            met = meet_sphere(p, o, d, leaves ? own : 0, hit);
        } else if (!leaves) {
            met = meet_triangle(p, o, d, hit);
        }
        if (met) {
            hit->shape = p.shape;
            hit->primitive = static_cast<int>(i);
        }
    }
    return hit->shape >= 0;
}

}  // namespace drude
