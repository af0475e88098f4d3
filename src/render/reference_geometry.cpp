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
        if (!std::holds_alternative<TriangleMesh>(shape.geometry)) {
            base.is_triangle = false;
            if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) base.round = *sphere;
            if (const auto* disk = std::get_if<Disk>(&shape.geometry)) base.round = *disk;
            if (const auto* side = std::get_if<Cylinder>(&shape.geometry)) base.round = *side;
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
                constexpr double unnamed[3][2] = {{0, 0}, {1, 0}, {1, 1}};
                p.uv[c] = mesh.uv.empty() ? glm::dvec2(unnamed[c][0], unnamed[c][1])
                                          : glm::dvec2(mesh.uv[t[c]]);
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
    hit->uv = (1 - v - w) * p.uv[0] + v * p.uv[1] + w * p.uv[2];
    hit->ng = glm::normalize(glm::cross(e1, e2));
    if (p.flip) hit->ng = -hit->ng;
    hit->ns = hit->ng;
    if (p.has_normals) {
        hit->ns = glm::normalize((1 - v - w) * p.normal[0] + v * p.normal[1] + w * p.normal[2]);
        if (glm::dot(hit->ns, hit->ng) < 0) hit->ng = -hit->ng;
    }
    return true;
}

namespace {

// The part of a full turn from +x towards +y at which q stands, over that which the shape has.
double part_of_turn(const glm::dvec3& q, double phi_max_deg) {
    double phi = std::atan2(q.y, q.x);
    if (phi < 0) phi += 2 * pi;
    return phi / (phi_max_deg * pi / 180);
}

// Roots of aa t^2 + 2 ab t + c, ascending; none where `count` is 0.
struct Roots {
    int count = 0;
    double t[2] = {0, 0};
};
Roots roots(double aa, double ab, double c) {
    const double root = ab * ab - aa * c;
    if (!(root >= 0) || !(aa > 0)) return {};
    return {2, {(-ab - std::sqrt(root)) / aa, (-ab + std::sqrt(root)) / aa}};
}

// Where the line a + t b meets the whole surface, whether a point of that is kept, its outward
// normal, and v.
struct OwnSpace {
    glm::dvec3 a, b;

    Roots meet(const Sphere& s) const {
        return roots(glm::dot(b, b), glm::dot(a, b), glm::dot(a, a) - s.radius * s.radius);
    }
    Roots meet(const Cylinder& s) const {
        return roots(b.x * b.x + b.y * b.y, a.x * b.x + a.y * b.y,
                     a.x * a.x + a.y * a.y - s.radius * s.radius);
    }
    Roots meet(const Disk& s) const {
        if (b.z == 0) return {};
        return {1, {(s.height - a.z) / b.z, 0}};
    }
    static bool keeps(const Sphere& s, const glm::dvec3& q) {
        const bool lower = s.z_min > -s.radius && q.z < s.z_min;
        const bool upper = s.z_max < s.radius && q.z > s.z_max;
        return !lower && !upper;
    }
    static bool keeps(const Cylinder& s, const glm::dvec3& q) {
        return q.z >= s.z_min && q.z <= s.z_max;
    }
    static bool keeps(const Disk& s, const glm::dvec3& q) {
        const double r = std::sqrt(q.x * q.x + q.y * q.y);
        return r >= s.inner_radius && r <= s.radius;
    }
    static glm::dvec3 normal(const Sphere&, const glm::dvec3& q) { return q; }
    static glm::dvec3 normal(const Cylinder&, const glm::dvec3& q) { return {q.x, q.y, 0}; }
    static glm::dvec3 normal(const Disk&, const glm::dvec3&) { return {0, 0, 1}; }
    static double v(const Sphere& s, const glm::dvec3& q) {
        const auto theta = [&](double z) {
            return std::acos(std::fmax(-1, std::fmin(1, z / s.radius)));
        };
        return (theta(q.z) - theta(s.z_min)) / (theta(s.z_max) - theta(s.z_min));
    }
    static double v(const Cylinder& s, const glm::dvec3& q) {
        return (q.z - s.z_min) / (s.z_max - s.z_min);
    }
    static double v(const Disk& s, const glm::dvec3& q) {
        return (s.radius - std::sqrt(q.x * q.x + q.y * q.y)) / (s.radius - s.inner_radius);
    }
};

}  // namespace

bool ReferenceGeometry::meet_round(const Primitive& p, const glm::dvec3& o, const glm::dvec3& d,
                                   double t_min, ReferenceHit* hit) const {
    const OwnSpace own{glm::dvec3(p.object_from_world * glm::dvec4(o, 1)),
                       glm::dvec3(p.object_from_world * glm::dvec4(d, 0))};
    const auto meet = [&](const auto& shape) {
        const Roots found = own.meet(shape);
        for (int i = 0; i < found.count; ++i) {
            const double t = found.t[i];
            if (!(t > t_min && t < hit->t)) continue;
            const glm::dvec3 q = own.a + t * own.b;
            const double u = part_of_turn(q, shape.phi_max_deg);
            if (u > 1 || !OwnSpace::keeps(shape, q)) continue;
            hit->t = t;
            hit->p = o + t * d;
            hit->uv = {u, OwnSpace::v(shape, q)};
            hit->ng = glm::normalize(glm::transpose(glm::dmat3(p.object_from_world)) *
                                     OwnSpace::normal(shape, q));
            if (p.flip) hit->ng = -hit->ng;
            hit->ns = hit->ng;
            return true;
        }
        return false;
    };
    return std::visit(meet, p.round);
}

bool ReferenceGeometry::intersect(const glm::dvec3& o, const glm::dvec3& d, int from,
                                  ReferenceHit* hit) const {
    hit->t = std::numeric_limits<double>::infinity();
    hit->shape = -1;
    for (size_t i = 0; i < primitives_.size(); ++i) {
        const Primitive& p = primitives_[i];
        const bool leaves = static_cast<int>(i) == from;
        bool met = false;
        const bool is_flat = p.is_triangle || std::holds_alternative<Disk>(p.round);
        if (is_flat && leaves) continue;
        if (p.is_triangle) {
            met = meet_triangle(p, o, d, hit);
        } else {
            // t is a length in the world, so the ray's own start lies within rounding of 0.
            const double radius =
                std::visit([](const auto& shape) { return shape.radius; }, p.round);
            const double own =
                1e-9 * (glm::length(o) + radius * glm::length(p.world_from_object[0]));
            met = meet_round(p, o, d, leaves ? own : 0, hit);
        }
        if (met) {
            hit->shape = p.shape;
            hit->primitive = static_cast<int>(i);
        }
    }
    return hit->shape >= 0;
}

}  // namespace drude
