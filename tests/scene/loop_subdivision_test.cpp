// Loop surfaces against powers of the subdivision matrix and against finer and finer meshes.
#include "scene/loop_subdivision.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "scene_text.h"

namespace drude {
namespace {

using Points = std::vector<glm::dvec3>;
using Faces = std::vector<glm::uvec3>;

const Points octahedron = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
const Faces octahedron_faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
const Points tetrahedron = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
const Faces tetrahedron_faces = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};

// The limit of a vertex with a ring of n neighbours: the rows of the subdivision matrix of vertex
// and ring, written down from the rules, to a high power. Row and column 0 are the vertex.
std::vector<double> limit_weights(int n, double beta) {
    const int size = n + 1;
    std::vector<double> matrix(static_cast<size_t>(size * size), 0.0);
    const auto at = [&](std::vector<double>& m, int i, int j) -> double& {
        return m[static_cast<size_t>(i * size + j)];
    };
    at(matrix, 0, 0) = 1 - n * beta;
    for (int i = 1; i <= n; ++i) {
        at(matrix, 0, i) = beta;
        // A new ring vertex lies on the edge from the old vertex to the old ring vertex.
        at(matrix, i, 0) = 3.0 / 8;
        at(matrix, i, i) += 3.0 / 8;
        at(matrix, i, i % n + 1) += 1.0 / 8;
        at(matrix, i, (i + n - 2) % n + 1) += 1.0 / 8;
    }
    for (int doubling = 0; doubling < 10; ++doubling) {
        std::vector<double> square(matrix.size(), 0.0);
        for (int i = 0; i < size; ++i) {
            for (int j = 0; j < size; ++j) {
                for (int k = 0; k < size; ++k)
                    at(square, i, j) += at(matrix, i, k) * at(matrix, k, j);
            }
        }
        matrix = square;
    }
    matrix.resize(static_cast<size_t>(size));
    return matrix;
}

TEST(LoopSubdivision, VerticesOfSolidsGoToTheLimitOfTheSubdivisionMatrix) {
    for (const int levels : {0, 1, 2, 4}) {
        const TriangleMesh eight = subdivide_loop(octahedron, octahedron_faces, levels);
        const std::vector<double> four = limit_weights(4, 3.0 / 32);
        EXPECT_EQ(eight.triangles.size(), octahedron_faces.size() << (2 * levels));
        // The ring's sum is 0, so the vertex keeps its own weight.
        for (int v = 0; v < 6; ++v) {
            EXPECT_LT(glm::length(glm::dvec3(eight.positions[v]) - four[0] * octahedron[v]), 1e-6);
            EXPECT_LT(glm::length(glm::dvec3(eight.normals[v]) - octahedron[v]), 1e-6);
        }
        const TriangleMesh small = subdivide_loop(tetrahedron, tetrahedron_faces, levels);
        const std::vector<double> three = limit_weights(3, 3.0 / 16);
        // The ring's sum is minus the vertex.
        for (int v = 0; v < 4; ++v) {
            const glm::dvec3 expected = (three[0] - three[1]) * tetrahedron[v];
            EXPECT_LT(glm::length(glm::dvec3(small.positions[v]) - expected), 1e-6);
            EXPECT_LT(glm::length(glm::dvec3(small.normals[v]) - glm::normalize(tetrahedron[v])),
                      1e-6);
        }
    }
}

// A regular grid in the pattern of the three-directional mesh, its height a function of (x, y).
template <class Height>
void make_grid(int size, const Height& height, Points& points, Faces& faces) {
    for (int y = 0; y <= size; ++y) {
        for (int x = 0; x <= size; ++x) points.emplace_back(x, y, height(x, y));
    }
    const auto index = [&](int x, int y) { return static_cast<unsigned>(y * (size + 1) + x); };
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            faces.emplace_back(index(x, y), index(x + 1, y), index(x + 1, y + 1));
            faces.emplace_back(index(x, y), index(x + 1, y + 1), index(x, y + 1));
        }
    }
}

// Where all valences are 6 the surface is a box spline, which repeats planes exactly and turns the
// control heights x^2 into x^2 + c with a constant c.
TEST(LoopSubdivision, PlanesStayAndParabolasShift) {
    Points points;
    Faces faces;
    make_grid(
        6, [](double x, double y) { return 0.5 * x - 0.25 * y; }, points, faces);
    const TriangleMesh plane = subdivide_loop(points, faces, 3);
    const glm::dvec3 up = glm::normalize(glm::dvec3(-0.5, 0.25, 1));
    for (size_t i = 0; i < plane.positions.size(); ++i) {
        const glm::dvec3 p = plane.positions[i];
        EXPECT_NEAR(p.z, 0.5 * p.x - 0.25 * p.y, 1e-6);
        EXPECT_LT(glm::length(glm::dvec3(plane.normals[i]) - up), 1e-6);
        EXPECT_TRUE(p.x > -1e-6 && p.x < 6 + 1e-6 && p.y > -1e-6 && p.y < 6 + 1e-6);
    }
    points.clear();
    faces.clear();
    make_grid(
        8, [](double x, double) { return x * x; }, points, faces);
    const TriangleMesh parabola = subdivide_loop(points, faces, 2);
    // The limit's weights at a vertex are 1/2 and 1/12 six times; four of the six neighbours lie
    // 1 away in x: c = 4/12.
    int inner = 0;
    for (size_t i = 0; i < parabola.positions.size(); ++i) {
        const glm::dvec3 p = parabola.positions[i];
        if (p.x < 2 || p.x > 6 || p.y < 2 || p.y > 6) continue;
        ++inner;
        EXPECT_NEAR(p.z, p.x * p.x + 1.0 / 3, 1e-5);
        const glm::dvec3 n = glm::normalize(glm::dvec3(-2 * p.x, 0, 1));
        EXPECT_LT(glm::length(glm::dvec3(parabola.normals[i]) - n), 1e-5);
    }
    EXPECT_GT(inner, 200);
}

// The limit does not depend on when the triangles are split.
TEST(LoopSubdivision, BoundariesAndNormalsAgreeWithFinerMeshes) {
    // An open fan with corners of one, two and more triangles, all of it curved.
    for (const int around : {2, 3, 4, 5, 7}) {
        Points points = {{0, 0, 0.4}};
        Faces faces;
        for (int i = 0; i <= around; ++i) {
            const double angle = 3.0 * i / around;
            points.emplace_back(std::cos(angle), std::sin(angle), 0.1 * i * i / around);
            if (i > 0) faces.emplace_back(0, i, i + 1);
        }
        const TriangleMesh coarse = subdivide_loop(points, faces, 0);
        const TriangleMesh fine = subdivide_loop(points, faces, 7);
        std::vector<glm::dvec3> face_normals(points.size(), glm::dvec3(0));
        for (const glm::uvec3& t : fine.triangles) {
            const glm::dvec3 a = fine.positions[t.x];
            const glm::dvec3 across = glm::normalize(glm::cross(
                glm::dvec3(fine.positions[t.y]) - a, glm::dvec3(fine.positions[t.z]) - a));
            for (int c = 0; c < 3; ++c) {
                if (t[c] < points.size()) face_normals[t[c]] += across;
            }
        }
        for (size_t v = 0; v < points.size(); ++v) {
            EXPECT_LT(glm::length(coarse.positions[v] - fine.positions[v]), 1e-5) << around << v;
            EXPECT_LT(glm::length(coarse.normals[v] - fine.normals[v]), 1e-3) << around << v;
            const glm::dvec3 n = glm::normalize(face_normals[v]);
            EXPECT_LT(glm::length(glm::dvec3(coarse.normals[v]) - n), 0.05) << around << " " << v;
        }
    }
}

TEST(LoopSubdivision, IsAShapeOfAScene) {
    const Scene scene = world_of(
        "Shape \"loopsubdiv\" \"integer levels\" 2 \"string scheme\" \"loop\"\n"
        "\"point3 P\" [1 0 0  -1 0 0  0 1 0  0 -1 0  0 0 1  0 0 -1]\n"
        "\"integer indices\" [0 2 4  2 1 4  1 3 4  3 0 4  2 0 5  1 2 5  3 1 5  0 3 5]");
    EXPECT_EQ(std::get<TriangleMesh>(scene.shapes.at(0).geometry).triangles.size(), 128u);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(LoopSubdivision, WhatIsNoSurfaceIsAnError) {
    const auto error = [](const std::string& indices, const std::string& more = "") {
        return world_error_of(
            "Shape \"loopsubdiv\" \"point3 P\" [0 0 0 1 0 0 0 1 0 0 0 1 1 1 1]\n"
            "  \"integer indices\" [" +
            indices + "]" + more);
    };
    EXPECT_PLACE_AND_TEXT(error("0 1 2 1 0 3 0 1 4"), "t.pbrt:3:3", "3 triangles share the edge");
    EXPECT_PLACE_AND_TEXT(error("0 1 2 0 1 3"), "t.pbrt:3:3", "wound against each other");
    EXPECT_PLACE_AND_TEXT(error("0 1 2 0 3 4"), "t.pbrt:3:3", "touch in the single vertex 0");
    EXPECT_PLACE_AND_TEXT(error("0 1 1"), "t.pbrt:3:3", "three different ones");
    EXPECT_PLACE_AND_TEXT(error("0 1 2 2 1 3", " \"integer levels\" 12"), "t.pbrt:3:3",
                          "expected fewer levels");
    EXPECT_PLACE_AND_TEXT(error("0 1 2", " \"integer levels\" 13"), "t.pbrt:3:46", "0 to 12");
}

}  // namespace
}  // namespace drude
