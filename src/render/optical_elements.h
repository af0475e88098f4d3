// The polarisers and retarders of a scene: flat surfaces that rays go straight through.
//
// They stand apart from the geometry that scatters, so that rays towards lights see through them
// and scenes without any pay nothing.
#pragma once

#include <memory>

#include "materials/mueller.h"
#include "render/geometry.h"

namespace drude {

inline bool is_optical_element(const Scene& scene, const Shape& shape) {
    return shape.material >= 0 &&
           std::holds_alternative<OpticalElementMaterial>(scene.materials[shape.material]);
}

class OpticalElements {
  public:
    // `scene` must outlive it. Throws Error (outside) where Embree refuses.
    OpticalElements(const Scene& scene, const std::string& isa);

    bool empty() const { return geometry_ == nullptr; }

    // Calls visit(hit) for every element that the ray o + t d crosses at t < distance (d unit),
    // from near to far; after as many as no scene has (a ray along a surface) the rest is passed
    // over.
    template <class Visit>
    void along(glm::vec3 o, const glm::vec3& d, float distance, Visit&& visit) const {
        Hit hit;
        for (int i = 0; i < most && geometry_->intersect(o, d, &hit); ++i) {
            const float step = glm::dot(hit.p - o, d);
            distance -= step;
            if (!(distance > 0)) return;
            visit(hit);
            o = leave(hit, d);
        }
    }

    // What the element does to light that travels along k (unit, world), between frames of the x
    // axis x on either side: element_axis() of materials/optical_elements.h from the object's own x
    // axis and its normal.
    Mueller<float> mueller(const Hit& hit, const glm::vec3& k, const glm::vec3& x,
                           float handedness) const;

  private:
    static constexpr int most = 1000;
    const Scene& scene_;
    std::unique_ptr<Geometry> geometry_;
};

}  // namespace drude
