// pbrt's transformations as matrices on column vectors, in double precision.
//
// All of them are pbrt's own (Pharr, Jakob, Humphreys 2023, "Physically Based Rendering", 3.9):
// the world is left-handed, angles are degrees, a directive multiplies the current matrix from the
// right. Bad arguments are Errors (user) at `place`.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "base/error.h"

namespace drude {

glm::dmat4 translation(const glm::dvec3& by);
// No factor may be 0.
glm::dmat4 scaling(const glm::dvec3& by, const Place& place);
// About an axis (of any length but 0), counter-clockwise in a right-handed frame.
glm::dmat4 rotation(double degrees, const glm::dvec3& axis, const Place& place);
// camera-from-world of a camera at `eye` that sees `look` in the middle (+z) and `up` upwards (+y).
glm::dmat4 look_at(const glm::dvec3& eye, const glm::dvec3& look, const glm::dvec3& up,
                   const Place& place);
// 16 numbers, column by column, as pbrt writes them (the translation is the last column).
glm::dmat4 matrix_of(const std::array<double, 16>& values, const Place& place);

// Error (user) where a matrix is not finite, not affine (last row 0 0 0 1), flattens space, or
// stretches it beyond what single-precision geometry can follow.
void check_matrix(const glm::dmat4& matrix, const Place& place);

glm::dvec3 transform_point(const glm::dmat4& matrix, const glm::dvec3& point);
glm::dvec3 transform_vector(const glm::dmat4& matrix, const glm::dvec3& vector);

}  // namespace drude
