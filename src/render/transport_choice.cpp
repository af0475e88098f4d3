#include "render/transport_choice.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace drude {

std::string_view transport_name(Transport transport) {
    switch (transport) {
        case Transport::scalar:
            return "scalar";
        case Transport::intensity:
            return "intensity";
        case Transport::stokes:
            break;
    }
    return "stokes";
}

namespace {

// Whether every ray from the camera can meet only the outside of this sphere, and every ray that
// leaves that outside misses the rest of it.
bool only_outside_is_seen(const Shape& shape, const Camera& camera) {
    const auto* sphere = std::get_if<Sphere>(&shape.geometry);
    if (!sphere) return false;
    const glm::dvec4 world(glm::dvec3(camera.world_from_camera[3]), 1);
    const glm::dvec3 eye(glm::inverse(shape.world_from_object) * world);
    if (glm::length(eye) <= sphere->radius) return false;
    // A cut sphere shows its inside through the cut; from the far side of every cut's plane no
    // line of sight reaches the cut before it reaches the shell.
    const bool open_below = sphere->z_min > -sphere->radius;
    const bool open_above = sphere->z_max < sphere->radius;
    if (sphere->phi_max_deg < 360) return false;
    if (open_below && !(eye.z > sphere->z_min)) return false;
    if (open_above && !(eye.z < sphere->z_max)) return false;
    return !(open_below && open_above);
}

}  // namespace

TransportChoice cheapest_exact_transport(const Scene& scene, int max_depth) {
    const auto is_metal = [&](const Shape& shape) {
        return shape.material >= 0 &&
               std::holds_alternative<ConductorMaterial>(scene.materials[shape.material]);
    };
    const auto metals = std::count_if(scene.shapes.begin(), scene.shapes.end(), is_metal);
    if (metals == 0) return {Transport::scalar, "nothing in the scene polarises light"};
    if (max_depth <= 1) {
        return {Transport::scalar, "paths have one reflection at most, and lights are unpolarised"};
    }
    if (metals == 1 && scene.shapes.size() == 1 &&
        only_outside_is_seen(scene.shapes[0], scene.camera)) {
        return {Transport::scalar,
                "the only metal is seen from its convex side alone, so no path is reflected twice"};
    }
    return {Transport::intensity,
            "a path may be reflected by metal more than once, and only S0 is wanted"};
}

}  // namespace drude
