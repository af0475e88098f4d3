// Smooth surfaces from coarse triangles (Loop 1987, "Smooth subdivision surfaces based on
// triangles"), with the vertex weights that pbrt-v4 has: 3/16 where three edges meet, else 3/(8 n)
// (Warren 1995), which is Loop's own for n = 3 and 6.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "scene/scene.h"

namespace drude {

// Splits every triangle in four `levels` times, then moves every vertex to its limit and gives it
// the limit surface's normal. Edges with one triangle are boundaries: cubic B-splines that depend
// on nothing but themselves. Vertices that no triangle uses stay where they are. Throws Error
// (user) where the mesh is no surface: an edge with more than two triangles or with two that are
// wound against each other, parts that touch in one vertex, a triangle that names a vertex twice;
// and where more than most_subdivided_triangles would come out.
TriangleMesh subdivide_loop(const std::vector<glm::dvec3>& positions,
                            const std::vector<glm::uvec3>& triangles, int levels);

inline constexpr size_t most_subdivided_triangles = 10'000'000;

}  // namespace drude
