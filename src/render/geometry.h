// What rays meet: the scene's shapes behind Embree.
#pragma once

#include <functional>
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
    unsigned primitive = 0;  // triangle of a mesh; 0 for a sphere
};

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

    // The point of a triangle at the barycentric coordinates v of its second corner and w of its
    // third, and of a sphere at a point of its surface in its own space, as intersect() has them.
    Hit on_triangle(int shape, unsigned primitive, float v, float w) const;
    Hit on_sphere(int shape, const glm::dvec3& object_point) const;
    // By how much the transformation of a sphere stretches its surface where the normal in its own
    // space is n (unit), or at the point p of the world.
    double area_stretch(int shape, const glm::dvec3& n) const;
    double area_stretch_at(int shape, const glm::vec3& p) const;

    // The corners of a triangle in the world.
    void triangle(int shape, unsigned primitive, glm::vec3 corners[3]) const;

    struct Impl;

  private:
    std::unique_ptr<Impl> impl_;
    glm::vec3 centre_{0};
    float radius_ = 0;
    std::string isa_;
};

}  // namespace drude
