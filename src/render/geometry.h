// What rays meet: the scene's shapes behind Embree.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "scene/scene.h"

namespace drude {

struct Hit {
    glm::vec3 p;      // recomputed on the surface, not o + t d
    glm::vec3 ng;     // geometric normal, unit; an emitter that is not two-sided shines there.
                      // Vertex normals decide its side, else winding, as in pbrt-v4
    glm::vec3 ns;     // shading normal, unit, in the hemisphere of ng
    float error = 0;  // no coordinate of p is farther than this from the surface
    int shape = -1;   // index of Scene::shapes
    unsigned primitive = 0;  // triangle of a mesh; 0 for other shapes
    // Of a triangle: the weights of its second and third corner.
    glm::vec2 barycentric{0};
};

// A surface through the world's origin still needs room to leave it.
inline constexpr float least_hit_error = 1e-14f;

// The point from which a ray of direction d leaves a surface without meeting it again: moved off
// it, along the normal, by the error bound of the hit.
inline glm::vec3 leave(const Hit& hit, const glm::vec3& d) {
    const float side = glm::dot(d, hit.ng) > 0 ? 1.0f : -1.0f;
    return hit.p + side * hit.error * hit.ng;
}

class Geometry {
  public:
    // Keeps a reference to `scene`, which must outlive it. Throws Error (outside) where Embree
    // refuses (no memory).
    // Takes in the shapes for which `wanted` holds; absent: those that scatter, which is all but
    // interfaces and optical elements.
    explicit Geometry(const Scene& scene, const std::string& isa = "",
                      const std::function<bool(const Shape&)>& wanted = {});
    ~Geometry();
    Geometry(const Geometry&) = delete;
    Geometry& operator=(const Geometry&) = delete;

    // The nearest surface along o + t d, t > 0; d unit.
    bool intersect(const glm::vec3& o, const glm::vec3& d, Hit* hit) const;
    // Whether something stands between o and o + distance * d.
    bool occluded(const glm::vec3& o, const glm::vec3& d, float distance) const;

    // A sphere around all shapes; radius 0 for an empty scene.
    glm::vec3 centre() const { return centre_; }
    float radius() const { return radius_; }
    // The instruction set Embree runs on, "avx2" and the like.
    const std::string& isa() const { return isa_; }

    // pbrt-v4's surface parameters of a hit. Meshes: those of the vertices, interpolated, or where
    // there are none (0, 0), (1, 0), (1, 1) at the corners of every triangle. Others: u is the part
    // of phi; v that of theta from z_min to z_max (sphere), of z (cylinder), of the radius from the
    // outer edge inwards (disk). Computed here and not with the hit: most hits need none.
    glm::dvec2 uv(const Hit& hit) const;

    // ---- points of a shape, as lights choose them: a primitive (hit.primitive) at a time

    // The number of primitives: the triangles of a mesh, 1 of any other shape.
    unsigned primitives(int shape) const;
    // The area of one in the world.
    double area(int shape, unsigned primitive) const;
    struct AreaSample {
        Hit hit;
        float density = 0;  // of this choice per area of the world; 0 where the area is 0
    };
    // A point of it for u uniform in [0, 1)^2: uniform on a triangle; on other shapes uniform in
    // the shape's own space, which its transformation stretches.
    AreaSample sample(int shape, unsigned primitive, const glm::vec2& u) const;
    // The density of sample() at a hit, for the hit's own primitive.
    float density(const Hit& hit) const;

    struct Impl;

  private:
    std::unique_ptr<Impl> impl_;
    glm::vec3 centre_{0};
    float radius_ = 0;
    std::string isa_;
};

}  // namespace drude
