// A point of a path: the surface that was met, turned to the side the path arrives from.
#pragma once

#include "materials/frame.h"
#include "render/geometry.h"

namespace drude {

struct Vertex {
    Hit hit;        // normals on the side of `out`
    bool front;     // the path arrives on the side that the surface's own normal points to
    glm::vec3 out;  // world, unit: back along the path, towards the camera

    Vertex(const Hit& h, const glm::vec3& d) : hit(h), front(glm::dot(h.ng, d) <= 0), out(-d) {
        if (!front) {
            hit.ng = -hit.ng;
            hit.ns = -hit.ns;
        }
        if (!(glm::dot(hit.ns, out) > 0)) hit.ns = hit.ng;
        tangent_ = any_perpendicular(hit.ns);
        bitangent_ = glm::cross(hit.ns, tangent_);
    }

    // Local coordinates: z along the shading normal.
    glm::vec3 to_world(const glm::vec3& v) const {
        return v.x * tangent_ + v.y * bitangent_ + v.z * hit.ns;
    }
    glm::vec3 to_local(const glm::vec3& v) const {
        return {glm::dot(v, tangent_), glm::dot(v, bitangent_), glm::dot(v, hit.ns)};
    }

  private:
    glm::vec3 tangent_, bitangent_;
};

}  // namespace drude
