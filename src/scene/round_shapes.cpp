// Shapes "sphere", "disk" and "cylinder": the sphere as it is, the others as fine meshes.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/numbers.h"
#include "scene/builders.h"

namespace drude {

namespace {

constexpr double largest = 1e15, smallest = 1e-15;

// Of a full turn: the sagitta of one segment is 2e-5 of the radius.
constexpr int segments_per_turn = 512;

int segments(double phi_max_deg) {
    return std::max(3, static_cast<int>(std::ceil(segments_per_turn * phi_max_deg / 360)));
}

// A strip between two curves of (u, phi) on the surface, with normals and uv as pbrt has them.
template <class Position, class Normal>
TriangleMesh strip(double phi_max_deg, Position&& position, Normal&& normal) {
    TriangleMesh mesh;
    const int count = segments(phi_max_deg);
    for (int i = 0; i <= count; ++i) {
        const double u = static_cast<double>(i) / count;
        const double phi = u * phi_max_deg * std::numbers::pi / 180;
        for (const double v : {0.0, 1.0}) {
            mesh.positions.emplace_back(position(phi, v));
            mesh.normals.emplace_back(normal(phi));
            mesh.uv.emplace_back(u, v);
        }
    }
    for (unsigned i = 0; i < static_cast<unsigned>(count); ++i) {
        mesh.triangles.emplace_back(2 * i, 2 * i + 2, 2 * i + 3);
        mesh.triangles.emplace_back(2 * i, 2 * i + 3, 2 * i + 1);
    }
    return mesh;
}

double phi_max(ParameterList& list) {
    return list.number_in("phimax", 360, 1e-3, 360);
}

void note_tessellated(const ParameterList& list, Messages& messages) {
    messages.note(list.place(), fmt::format("{}: drawn as a mesh of {} segments a turn",
                                            list.owner(), segments_per_turn));
}

}  // namespace

Sphere build_sphere(ParameterList& list) {
    Sphere sphere;
    sphere.radius = list.number_in("radius", 1, smallest, largest);
    const double a = list.number("zmin", -sphere.radius), b = list.number("zmax", sphere.radius);
    sphere.z_min = std::clamp(std::min(a, b), -sphere.radius, sphere.radius);
    sphere.z_max = std::clamp(std::max(a, b), -sphere.radius, sphere.radius);
    if (!(sphere.z_max > sphere.z_min)) {
        user_error_at(list.has("zmin") ? list.place_of("zmin") : list.place_of("zmax"),
                      "Shape \"sphere\": nothing is left between zmin {} and zmax {}; expected a "
                      "part of -{} to {}",
                      format_double(a), format_double(b), format_double(sphere.radius),
                      format_double(sphere.radius));
    }
    sphere.phi_max_deg = phi_max(list);
    return sphere;
}

TriangleMesh build_disk(ParameterList& list, Messages& messages) {
    const double height = list.number_in("height", 0, -largest, largest);
    const double radius = list.number_in("radius", 1, smallest, largest);
    const double inner = list.number_in("innerradius", 0, 0, radius);
    if (inner == radius) {
        user_error_at(list.place_of("innerradius"),
                      "Shape \"disk\": innerradius equals radius; expected a smaller one");
    }
    TriangleMesh mesh = strip(
        phi_max(list),
        [&](double phi, double v) {
            const double r = radius + (inner - radius) * v;
            return glm::vec3(r * std::cos(phi), r * std::sin(phi), height);
        },
        [](double) { return glm::vec3(0, 0, 1); });
    mesh.normals.clear();  // a plane needs none
    if (inner == 0) {
        // The inner edge is one point: every second triangle of the strip has no area.
        const std::vector<glm::uvec3> both = std::move(mesh.triangles);
        mesh.triangles.clear();
        for (size_t i = 0; i < both.size(); i += 2) mesh.triangles.push_back(both[i]);
    }
    note_tessellated(list, messages);
    return mesh;
}

TriangleMesh build_cylinder(ParameterList& list, Messages& messages) {
    const double radius = list.number_in("radius", 1, smallest, largest);
    const double a = list.number_in("zmin", -1, -largest, largest);
    const double b = list.number_in("zmax", 1, -largest, largest);
    if (a == b) {
        user_error_at(list.place_of("zmin"),
                      "Shape \"cylinder\": zmin equals zmax; expected two different heights");
    }
    const double low = std::min(a, b), high = std::max(a, b);
    TriangleMesh mesh = strip(
        phi_max(list),
        [&](double phi, double v) {
            return glm::vec3(radius * std::cos(phi), radius * std::sin(phi),
                             low + (high - low) * v);
        },
        [](double phi) { return glm::vec3(std::cos(phi), std::sin(phi), 0); });
    note_tessellated(list, messages);
    return mesh;
}

}  // namespace drude
