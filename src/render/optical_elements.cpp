#include "render/optical_elements.h"

#include <algorithm>
#include <glm/matrix.hpp>

#include "materials/optical_elements.h"

namespace drude {

OpticalElements::OpticalElements(const Scene& scene, const std::string& isa) : scene_(scene) {
    const auto is_one = [&](const Shape& shape) { return is_optical_element(scene, shape); };
    if (std::none_of(scene.shapes.begin(), scene.shapes.end(), is_one)) return;
    geometry_ = std::make_unique<Geometry>(scene, isa, is_one);
}

Mueller<float> OpticalElements::mueller(const Hit& hit, const glm::vec3& k, const glm::vec3& x,
                                        float handedness) const {
    const Shape& s = scene_.shapes[hit.shape];
    const auto& e = std::get<OpticalElementMaterial>(scene_.materials[s.material]);
    const glm::vec3 zero(glm::dmat3(s.world_from_object)[0]);
    const Rotation<float> axis =
        element_axis(k, x, zero, hit.ng, static_cast<float>(e.axis_deg * degree), handedness);
    Mueller<float> m;
    switch (e.kind) {
        case OpticalElementMaterial::Kind::linear_polariser:
            m = linear_polariser(axis);
            break;
        case OpticalElementMaterial::Kind::retarder:
            m = linear_retarder(axis, static_cast<float>(e.retardance_deg * degree));
            break;
        case OpticalElementMaterial::Kind::circular_polariser:
            m = circular_polariser<float>(e.right_handed);
            break;
    }
    for (auto& row : m.m) {
        for (float& element : row) element *= static_cast<float>(e.transmittance);
    }
    return m;
}

}  // namespace drude
