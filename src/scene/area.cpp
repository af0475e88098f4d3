// The area of a shape, for lights whose power is given.
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scene/builders.h"
#include "scene/transforms.h"

namespace drude {

namespace {

double area_of(const TriangleMesh& mesh, const glm::dmat4& world_from_object) {
    double area = 0;
    for (const glm::uvec3& triangle : mesh.triangles) {
        glm::dvec3 corner[3];
        for (int i = 0; i < 3; ++i) {
            corner[i] = transform_point(world_from_object, mesh.positions[triangle[i]]);
        }
        area += glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0])) / 2;
    }
    return area;
}

// In z and phi a sphere's area element is constant, radius dz dphi; the transformation stretches it
// by the length of the images' cross product. Midpoint rule: exact for uniform scales.
double area_of(const Sphere& sphere, const glm::dmat4& world_from_object) {
    constexpr int steps_z = 256, steps_phi = 256;
    const double phi_max = sphere.phi_max_deg * std::numbers::pi / 180;
    double sum = 0;
    for (int i = 0; i < steps_z; ++i) {
        const double z = sphere.z_min + (sphere.z_max - sphere.z_min) * (i + 0.5) / steps_z;
        const double cosine = z / sphere.radius;
        const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
        for (int j = 0; j < steps_phi; ++j) {
            const double phi = phi_max * (j + 0.5) / steps_phi;
            const glm::dvec3 around(-std::sin(phi), std::cos(phi), 0);
            const glm::dvec3 along(cosine * std::cos(phi), cosine * std::sin(phi), -sine);
            sum += glm::length(glm::cross(transform_vector(world_from_object, around),
                                          transform_vector(world_from_object, along)));
        }
    }
    return sum / (steps_z * steps_phi) * sphere.radius * (sphere.z_max - sphere.z_min) * phi_max;
}

double area_of(const Disk& disk, const glm::dmat4& world_from_object) {
    const double phi_max = disk.phi_max_deg * std::numbers::pi / 180;
    const double own =
        (disk.radius - disk.inner_radius) * (disk.radius + disk.inner_radius) * phi_max / 2;
    return own * glm::length(glm::cross(glm::dvec3(world_from_object[0]),
                                        glm::dvec3(world_from_object[1])));
}

double area_of(const Cylinder& cylinder, const glm::dmat4& world_from_object) {
    constexpr int steps = 4096;
    const double phi_max = cylinder.phi_max_deg * std::numbers::pi / 180;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double phi = phi_max * (i + 0.5) / steps;
        const glm::dvec3 around(-std::sin(phi), std::cos(phi), 0);
        sum += glm::length(glm::cross(transform_vector(world_from_object, around),
                                      glm::dvec3(world_from_object[2])));
    }
    return sum / steps * cylinder.radius * (cylinder.z_max - cylinder.z_min) * phi_max;
}

}  // namespace

double surface_area(const ShapeGeometry& geometry, const glm::dmat4& world_from_object) {
    return std::visit([&](const auto& shape) { return area_of(shape, world_from_object); },
                      geometry);
}

}  // namespace drude
