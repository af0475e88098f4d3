#include "scene/transforms.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "base/numbers.h"

namespace drude {

glm::dmat4 translation(const glm::dvec3& by) {
    glm::dmat4 matrix(1);
    matrix[3] = glm::dvec4(by, 1);
    return matrix;
}

glm::dmat4 scaling(const glm::dvec3& by, const Place& place) {
    for (int i = 0; i < 3; ++i) {
        if (by[i] == 0) {
            user_error_at(place, "Scale {} {} {} flattens space; expected factors other than 0",
                          format_double(by.x), format_double(by.y), format_double(by.z));
        }
    }
    glm::dmat4 matrix(1);
    for (int i = 0; i < 3; ++i) matrix[i][i] = by[i];
    return matrix;
}

glm::dmat4 rotation(double degrees, const glm::dvec3& axis, const Place& place) {
    const double length = glm::length(axis);
    if (!(length > 0) || !std::isfinite(length)) {
        user_error_at(place, "Rotate about the axis {} {} {}; expected an axis of finite length",
                      format_double(axis.x), format_double(axis.y), format_double(axis.z));
    }
    const glm::dvec3 a = axis / length;
    // Whole turns are taken off in degrees, where they are exact; so are the quarter turns.
    const double angle = std::remainder(degrees, 360.0);
    double sine = std::sin(angle * std::numbers::pi / 180);
    double cosine = std::cos(angle * std::numbers::pi / 180);
    if (angle == 90 || angle == -90) cosine = 0;
    if (angle == 180 || angle == -180) sine = 0;
    glm::dmat4 matrix(1);
    for (int column = 0; column < 3; ++column) {
        glm::dvec3 e(0);
        e[column] = 1;
        // Rodrigues: v cos + (a x v) sin + a (a.v)(1 - cos).
        const glm::dvec3 turned =
            e * cosine + glm::cross(a, e) * sine + a * (a[column] * (1 - cosine));
        matrix[column] = glm::dvec4(turned, 0);
    }
    return matrix;
}

glm::dmat4 look_at(const glm::dvec3& eye, const glm::dvec3& look, const glm::dvec3& up,
                   const Place& place) {
    const glm::dvec3 towards = look - eye;
    if (!(glm::length(towards) > 0)) {
        user_error_at(place, "LookAt from a point to itself; expected two different points");
    }
    if (!(glm::length(up) > 0)) {
        user_error_at(place, "LookAt with an up vector of length 0; expected a direction");
    }
    const glm::dvec3 forward = glm::normalize(towards);
    const glm::dvec3 side = glm::cross(glm::normalize(up), forward);
    if (!(glm::length(side) > 1e-9)) {
        user_error_at(place,
                      "LookAt with an up vector parallel to the view; expected another up vector");
    }
    const glm::dvec3 right = glm::normalize(side);
    const glm::dvec3 above = glm::cross(forward, right);
    const glm::dmat4 world_from_camera(glm::dvec4(right, 0), glm::dvec4(above, 0),
                                       glm::dvec4(forward, 0), glm::dvec4(eye, 1));
    check_matrix(world_from_camera, place);
    return glm::inverse(world_from_camera);
}

glm::dmat4 matrix_of(const std::array<double, 16>& values, const Place& place) {
    glm::dmat4 matrix;
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = values[static_cast<size_t>(i)];
    check_matrix(matrix, place);
    return matrix;
}

void check_matrix(const glm::dmat4& matrix, const Place& place) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!std::isfinite(matrix[column][row])) {
                user_error_at(place, "the transformation overflows; expected finite numbers");
            }
        }
        if (std::abs(matrix[column][3] - (column == 3 ? 1 : 0)) > 1e-9) {
            user_error_at(place,
                          "the matrix is not affine; expected its last row to be 0 0 0 1 (numbers "
                          "are written column by column)");
        }
    }
    // Squares of lengths must stay within single precision on both sides.
    constexpr double smallest = 1e-15, largest = 1e15;
    double product = 1;
    for (int column = 0; column < 3; ++column) {
        const double length = glm::length(glm::dvec3(matrix[column]));
        if (!(length > smallest && length < largest)) {
            user_error_at(place,
                          "the transformation scales an axis by {}; expected a factor between {} "
                          "and {}",
                          format_double(length), format_double(smallest), format_double(largest));
        }
        product *= length;
    }
    if (!(glm::length(glm::dvec3(matrix[3])) < largest)) {
        user_error_at(place, "the transformation moves things by more than {}",
                      format_double(largest));
    }
    if (!(std::abs(glm::determinant(glm::dmat3(matrix))) > 1e-10 * product)) {
        user_error_at(place,
                      "the transformation is singular: it flattens space; expected a matrix that "
                      "can be inverted");
    }
}

glm::dvec3 transform_point(const glm::dmat4& matrix, const glm::dvec3& point) {
    return glm::dvec3(matrix * glm::dvec4(point, 1));
}

glm::dvec3 transform_vector(const glm::dmat4& matrix, const glm::dvec3& vector) {
    return glm::dvec3(matrix * glm::dvec4(vector, 0));
}

}  // namespace drude
