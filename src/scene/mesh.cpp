// Shapes "trianglemesh" and "bilinearmesh", and what every mesh is checked for.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/numbers.h"
#include "scene/builders.h"
#include "scene/loop_subdivision.h"

namespace drude {

namespace {

// Squares of coordinates must stay within single precision.
constexpr double largest = 1e15;

float coordinate(const Parameter& parameter, size_t i) {
    const double value = parameter.numbers[i];
    if (!(std::abs(value) <= largest)) {
        user_error_at(parameter.place_of(i), "'{}': coordinate {}; expected at most {}",
                      parameter.name, format_double(value), format_double(largest));
    }
    return static_cast<float>(value);
}

std::vector<glm::vec3> triples(const Parameter& parameter) {
    std::vector<glm::vec3> result(parameter.numbers.size() / 3);
    for (size_t i = 0; i < result.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            result[i][c] = coordinate(parameter, 3 * i + static_cast<size_t>(c));
        }
    }
    return result;
}

void check_same_count(const ParameterList& list, const std::string& name, size_t count,
                      size_t positions) {
    if (count != positions) {
        user_error_at(list.place_of(name), "{}: {} of '{}' for {} of 'P'; expected one each",
                      list.owner(), count, name, positions);
    }
}

std::vector<glm::vec3> read_positions(ParameterList& list) {
    const Parameter* positions = list.values("P", ParameterType::point3);
    if (positions == nullptr) {
        user_error_at(list.place(), "{} without \"point3 P\"; expected the positions",
                      list.owner());
    }
    return triples(*positions);
}

// P, N, uv; tangents and face numbers serve materials that are not modelled.
TriangleMesh read_vertices(ParameterList& list) {
    TriangleMesh mesh;
    mesh.positions = read_positions(list);
    const size_t count = mesh.positions.size();
    if (const Parameter* normals = list.values("N", ParameterType::normal)) {
        mesh.normals = triples(*normals);
        check_same_count(list, "N", mesh.normals.size(), count);
    }
    if (const Parameter* uv = list.values("uv", ParameterType::point2)) {
        check_same_count(list, "uv", uv->numbers.size() / 2, count);
        for (size_t i = 0; i < count; ++i) {
            mesh.uv.emplace_back(coordinate(*uv, 2 * i), coordinate(*uv, 2 * i + 1));
        }
    }
    if (const Parameter* tangents = list.values("S", ParameterType::vector3)) {
        check_same_count(list, "S", tangents->numbers.size() / 3, count);
    }
    list.values("faceIndices", ParameterType::integer);
    return mesh;
}

// Groups of `corners` indices; absent where there is exactly one face.
std::vector<unsigned> read_indices(ParameterList& list, size_t corners, size_t positions) {
    std::vector<unsigned> indices;
    const Parameter* parameter = list.values("indices", ParameterType::integer);
    if (parameter == nullptr) {
        if (positions != corners) {
            user_error_at(
                list.place(),
                "{} without \"integer indices\" has {} positions; expected {}, or indices",
                list.owner(), positions, corners);
        }
        for (unsigned i = 0; i < corners; ++i) indices.push_back(i);
        return indices;
    }
    if (parameter->numbers.size() % corners != 0) {
        user_error_at(parameter->place, "{}: {} indices; expected a multiple of {}", list.owner(),
                      parameter->numbers.size(), corners);
    }
    indices.reserve(parameter->numbers.size());
    for (size_t i = 0; i < parameter->numbers.size(); ++i) {
        const double index = parameter->numbers[i];
        if (!(index >= 0 && index < static_cast<double>(positions))) {
            user_error_at(parameter->place_of(i), "{}: index {}; expected 0 to {}", list.owner(),
                          format_double(index), positions - 1);
        }
        indices.push_back(static_cast<unsigned>(index));
    }
    return indices;
}

glm::dvec3 face_normal(const TriangleMesh& mesh, const glm::uvec3& triangle) {
    const glm::dvec3 a = mesh.positions[triangle.x];
    return glm::cross(glm::dvec3(mesh.positions[triangle.y]) - a,
                      glm::dvec3(mesh.positions[triangle.z]) - a);
}

// A normal of length 0 would be NaN once normalised: such vertices get their faces' mean.
size_t mend_normals(TriangleMesh& mesh) {
    std::vector<glm::dvec3> mended;
    size_t count = 0;
    const auto is_bad = [](const glm::vec3& normal) {
        return !(glm::length(glm::dvec3(normal)) > 1e-18);
    };
    for (const glm::vec3& normal : mesh.normals) count += is_bad(normal) ? 1 : 0;
    if (count == 0) return 0;
    mended.assign(mesh.positions.size(), glm::dvec3(0));
    for (const glm::uvec3& triangle : mesh.triangles) {
        const glm::dvec3 normal = face_normal(mesh, triangle);
        for (int i = 0; i < 3; ++i) mended[triangle[i]] += normal;
    }
    for (size_t i = 0; i < mesh.normals.size(); ++i) {
        if (!is_bad(mesh.normals[i])) continue;
        const double length = glm::length(mended[i]);
        mesh.normals[i] = length > 0 ? glm::vec3(mended[i] / length) : glm::vec3(0, 0, 1);
    }
    return count;
}

// Gives every patch vertices of its own, so that each can have the uv of its corners.
void part_patches(TriangleMesh& mesh, std::vector<unsigned>& indices) {
    const TriangleMesh shared = std::move(mesh);
    mesh = {};
    for (size_t i = 0; i < indices.size(); ++i) {
        mesh.positions.push_back(shared.positions[indices[i]]);
        if (!shared.normals.empty()) mesh.normals.push_back(shared.normals[indices[i]]);
        mesh.uv.emplace_back(i % 2, i / 2 % 2);
        indices[i] = static_cast<unsigned>(i);
    }
}

}  // namespace

void tidy_mesh(TriangleMesh& mesh, const std::string& owner, const Place& place,
               Messages& messages) {
    const size_t before = mesh.triangles.size();
    const auto has_no_area = [&](const glm::uvec3& triangle) {
        return !(glm::length(face_normal(mesh, triangle)) > 0);
    };
    mesh.triangles.erase(std::remove_if(mesh.triangles.begin(), mesh.triangles.end(), has_no_area),
                         mesh.triangles.end());
    if (mesh.triangles.empty()) {
        user_error_at(place, "{} has {}; expected at least one with an area", owner,
                      before == 0 ? "no triangle" : "only triangles without area");
    }
    const size_t dropped = before - mesh.triangles.size();
    if (dropped > 0) {
        messages.note(place, fmt::format("{}: {} of {} triangles have no area and are left out",
                                         owner, dropped, before));
    }
    const size_t mended = mend_normals(mesh);
    if (mended > 0) {
        messages.note(place, fmt::format("{}: {} normals of length 0 are replaced by those of the "
                                         "faces around",
                                         owner, mended));
    }
}

TriangleMesh build_triangle_mesh(ParameterList& list, Messages& messages) {
    TriangleMesh mesh = read_vertices(list);
    const std::vector<unsigned> indices = read_indices(list, 3, mesh.positions.size());
    for (size_t i = 0; i < indices.size(); i += 3) {
        mesh.triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
    }
    tidy_mesh(mesh, list.owner(), list.place(), messages);
    return mesh;
}

TriangleMesh build_loop_surface(ParameterList& list, Messages& messages) {
    const int levels = list.integer_in("levels", 3, 0, 12);
    list.text("scheme", "loop");
    const std::vector<glm::vec3> given = read_positions(list);
    const std::vector<unsigned> indices = read_indices(list, 3, given.size());
    const std::vector<glm::dvec3> positions(given.begin(), given.end());
    std::vector<glm::uvec3> triangles;
    for (size_t i = 0; i < indices.size(); i += 3) {
        triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
    }
    TriangleMesh mesh;
    try {
        mesh = subdivide_loop(positions, triangles, levels);
    } catch (const Error& error) {
        throw Error(error.cause(), list.place_of("indices"), list.owner() + ": " + error.message());
    }
    tidy_mesh(mesh, list.owner(), list.place(), messages);
    return mesh;
}

TriangleMesh build_bilinear_mesh(ParameterList& list, Messages& messages) {
    TriangleMesh mesh = read_vertices(list);
    // pbrt numbers the corners (0,0), (1,0), (0,1), (1,1).
    std::vector<unsigned> indices = read_indices(list, 4, mesh.positions.size());
    if (mesh.uv.empty()) part_patches(mesh, indices);
    bool is_flat = true;
    for (size_t i = 0; i < indices.size(); i += 4) {
        const glm::uvec3 first(indices[i], indices[i + 1], indices[i + 3]);
        const glm::uvec3 second(indices[i], indices[i + 3], indices[i + 2]);
        mesh.triangles.push_back(first);
        mesh.triangles.push_back(second);
        const glm::dvec3 normal = face_normal(mesh, first);
        const glm::dvec3 offset =
            glm::dvec3(mesh.positions[second.z]) - glm::dvec3(mesh.positions[first.x]);
        is_flat = is_flat && std::abs(glm::dot(normal, offset)) <=
                                 1e-4 * glm::length(normal) * glm::length(offset);
    }
    if (!is_flat) {
        messages.stand_in(list.place(),
                          "Shape \"bilinearmesh\": curved patches are not modelled; "
                          "two triangles a patch stand in");
    }
    if (list.has("emissionfilename")) {
        list.text("emissionfilename", "");
        messages.stand_in(list.place_of("emissionfilename"),
                          "Shape \"bilinearmesh\": emissionfilename is not modelled; the light is "
                          "constant over the shape");
    }
    tidy_mesh(mesh, list.owner(), list.place(), messages);
    return mesh;
}

}  // namespace drude
