// The reference integrator's geometry: every ray against every primitive, in double.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <variant>
#include <vector>

#include "scene/scene.h"

namespace drude {

struct ReferenceHit {
    double t = 0;
    glm::dvec3 p, ng, ns;  // ng as the shape is oriented, ns on the side of ng; unit
    int shape = -1;
    int primitive = -1;  // of the whole scene
    // pbrt-v4's surface parameters, as Geometry::uv() has them.
    glm::dvec2 uv{0};
};

class ReferenceGeometry {
  public:
    explicit ReferenceGeometry(const Scene& scene);

    // The nearest hit along o + t d (d unit), or false. `from` is the primitive that the ray leaves
    // (-1: none): what is flat is not met again, what is round not within rounding.
    bool intersect(const glm::dvec3& o, const glm::dvec3& d, int from, ReferenceHit* hit) const;

  private:
    struct Primitive {
        int shape;
        bool flip;  // the computed normal
        // A triangle in the world, ...
        glm::dvec3 corner[3], normal[3];
        bool has_normals = false;
        glm::dvec2 uv[3];
        // ... or another shape in its own space.
        bool is_triangle = true;
        std::variant<Sphere, Disk, Cylinder> round;
        glm::dmat4 world_from_object{1}, object_from_world{1};
    };
    bool meet_triangle(const Primitive& p, const glm::dvec3& o, const glm::dvec3& d,
                       ReferenceHit* hit) const;
    bool meet_round(const Primitive& p, const glm::dvec3& o, const glm::dvec3& d, double t_min,
                    ReferenceHit* hit) const;

    std::vector<Primitive> primitives_;
};

}  // namespace drude
