#include "render/convexity.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <map>

namespace drude {

namespace {

glm::dvec3 in_object_space(const Shape& shape, const Camera& camera) {
    const glm::dvec4 eye(glm::dvec3(camera.world_from_camera[3]), 1);
    return glm::dvec3(glm::inverse(shape.world_from_object) * eye);
}

// The checks below say "no" where they do not know.

bool is_closed(const Sphere& sphere) {
    return sphere.phi_max_deg >= 360 && sphere.z_min <= -sphere.radius &&
           sphere.z_max >= sphere.radius;
}

// Whether every ray from the camera meets only the outside of this sphere, and every ray that
// leaves that outside misses the rest of it, where nothing else is in the scene.
bool only_outside_is_seen(const Sphere& sphere, const glm::dvec3& eye) {
    if (glm::length(eye) <= sphere.radius) return false;
    // A cut sphere shows its inside through the cut; from the far side of every cut's plane no
    // line of sight reaches the cut before it reaches the shell.
    const bool open_below = sphere.z_min > -sphere.radius;
    const bool open_above = sphere.z_max < sphere.radius;
    if (sphere.phi_max_deg < 360) return false;
    if (open_below && !(eye.z > sphere.z_min)) return false;
    if (open_above && !(eye.z < sphere.z_max)) return false;
    return !(open_below && open_above);
}

// Flat, or closed and convex with the eye outside. Sides count by the geometry alone: vertex
// normals bend reflections, but never below a surface.
//
// A vertex counts as within a face's plane where coordinates in single precision may have taken it
// out: by a millionth of the mesh at most, and at so small an angle that the face hardly sees it.
// Relief of any depth has steep sides, which fail by their angle.
bool never_sees_itself(const TriangleMesh& mesh, const glm::dvec3& eye) {
    constexpr size_t most_checks = 20'000'000;
    if (mesh.triangles.size() * mesh.positions.size() > most_checks) return false;
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const glm::vec3& p : mesh.positions) {
        low = glm::min(low, glm::dvec3(p));
        high = glm::max(high, glm::dvec3(p));
    }
    const double slack = 1e-6 * glm::length(high - low);
    constexpr double least_angle = 1e-3;
    bool is_flat = true, is_convex = true, is_outside = false;
    using Corner = std::array<float, 3>;
    const auto corner = [&](uint32_t i) {
        const glm::vec3& p = mesh.positions[i];
        return Corner{p.x, p.y, p.z};
    };
    std::map<std::pair<Corner, Corner>, int> edges;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        const glm::dvec3 n = glm::normalize(glm::cross(b - a, c - a));
        bool is_below_some = false, is_above_some = false;
        for (const glm::vec3& position : mesh.positions) {
            const glm::dvec3 p(position);
            const double height = glm::dot(p - a, n);
            const double distance =
                std::min({glm::length(p - a), glm::length(p - b), glm::length(p - c)});
            if (std::abs(height) <= std::min(slack, least_angle * distance)) continue;
            if (distance > 0) (height > 0 ? is_below_some : is_above_some) = true;
        }
        is_flat = is_flat && !is_below_some && !is_above_some;
        is_convex = is_convex && !(is_below_some && is_above_some);
        const double of_eye = glm::dot(eye - a, n);
        // The body is on one side of each of its faces.
        is_outside = is_outside || (is_below_some ? of_eye < -slack : of_eye > slack);
        for (int side = 0; side < 3; ++side) {
            Corner from = corner(t[side]), to = corner(t[(side + 1) % 3]);
            if (to < from) std::swap(from, to);
            ++edges[{from, to}];
        }
    }
    if (is_flat) return true;
    const bool is_closed =
        std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second == 2; });
    return is_convex && is_closed && is_outside;
}

}  // namespace

bool reflects_once(const Shape& shape, const Camera& camera, bool alone) {
    // Rays of other cameras start at many points.
    const bool one_eye = camera.kind != CameraKind::orthographic && !(camera.lens_radius > 0);
    if (std::holds_alternative<Disk>(shape.geometry)) return true;
    if (!one_eye) return false;
    const glm::dvec3 eye = in_object_space(shape, camera);
    if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
        if (is_closed(*sphere)) return glm::length(eye) > sphere->radius;
        return alone && only_outside_is_seen(*sphere, eye);
    }
    const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry);
    return mesh != nullptr && never_sees_itself(*mesh, eye);
}

}  // namespace drude
