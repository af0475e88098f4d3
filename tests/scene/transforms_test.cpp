#include "scene/transforms.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "scene_text.h"

namespace drude {
namespace {

void expect_near(const glm::dvec3& value, const glm::dvec3& expected, double tolerance = 1e-14) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(value[i], expected[i], tolerance) << "component " << i;
}

const Place here{"t", 1, 1};

TEST(Transforms, RotationTurnsCounterClockwise) {
    // Exact for quarter turns.
    expect_near(transform_vector(rotation(90, {0, 0, 1}, here), {1, 0, 0}), {0, 1, 0}, 0);
    expect_near(transform_vector(rotation(90, {1, 0, 0}, here), {0, 1, 0}), {0, 0, 1}, 0);
    expect_near(transform_vector(rotation(-90, {0, 5, 0}, here), {1, 0, 0}), {0, 0, 1}, 0);
    expect_near(transform_vector(rotation(360 + 180, {0, 0, 1}, here), {1, 2, 3}), {-1, -2, 3}, 0);
    // About the diagonal, a third of a turn permutes the axes.
    expect_near(transform_vector(rotation(120, {1, 1, 1}, here), {1, 2, 3}), {3, 1, 2});
}

TEST(Transforms, LookAtIsLeftHanded) {
    // Looking along +z with y up: right is +x, as in the camera itself.
    const glm::dmat4 plain = look_at({0, 0, 0}, {0, 0, 5}, {0, 1, 0}, here);
    expect_near(transform_point(plain, {1, 2, 3}), {1, 2, 3});
    // pbrt's own: the first three columns are right, up and forward.
    const glm::dmat4 world_from_camera =
        glm::inverse(look_at({1, 2, 3}, {1, 2, 13}, {1, 1, 0}, here));
    const double h = std::sqrt(0.5);
    expect_near(transform_vector(world_from_camera, {0, 1, 0}), {h, h, 0});
    expect_near(transform_vector(world_from_camera, {1, 0, 0}), {h, -h, 0});
    expect_near(transform_point(world_from_camera, {0, 0, 2}), {1, 2, 5});
    EXPECT_GT(glm::determinant(world_from_camera), 0);
}

TEST(Transforms, TheCameraOfASceneIsTheInverse) {
    const Scene scene = scene_of(
        "LookAt 3 -4 2  0 0 1  0 0 1\nCamera \"perspective\" \"float fov\" 40\nWorldBegin\n");
    const glm::dmat4& m = scene.camera.world_from_camera;
    expect_near(transform_point(m, {0, 0, 0}), {3, -4, 2}, 1e-13);
    const glm::dvec3 forward = glm::normalize(glm::dvec3(-3, 4, -1));
    expect_near(transform_vector(m, {0, 0, 1}), forward);
    EXPECT_GT(glm::determinant(glm::dmat3(m)), 0);
    // A mirrored scene is right-handed.
    const Scene mirrored =
        scene_of("Scale -1 1 1\nLookAt 3 -4 2  0 0 1  0 0 1\nCamera \"perspective\"\nWorldBegin\n");
    EXPECT_LT(glm::determinant(glm::dmat3(mirrored.camera.world_from_camera)), 0);
    expect_near(transform_vector(mirrored.camera.world_from_camera, {1, 0, 0}),
                -transform_vector(m, {1, 0, 0}));
}

glm::dmat4 shape_matrix(const std::string& world) {
    const Scene scene = world_of(world + " Shape \"sphere\"");
    return scene.shapes.at(0).world_from_object;
}

TEST(Transforms, DirectivesMultiplyFromTheRight) {
    const glm::dmat4 m = shape_matrix("Translate 1 2 3 Rotate 90 0 0 1 Scale 2 3 4");
    expect_near(transform_point(m, {1, 1, 1}), {1 - 3, 2 + 2, 3 + 4});
    // Transform replaces, ConcatTransform multiplies; both are written column by column.
    const glm::dmat4 t =
        shape_matrix("Scale 9 9 9 Transform [ 0 2 0 0  1 0 0 0  0 0 1 0  5 6 7 1 ]");
    expect_near(transform_point(t, {1, 10, 100}), {10 + 5, 2 + 6, 107});
    const glm::dmat4 c =
        shape_matrix("Translate 1 0 0 ConcatTransform [ 1 0 0 0  0 1 0 0  0 0 1 0  5 6 7 1 ]");
    expect_near(transform_point(c, {0, 0, 0}), {6, 6, 7});
    expect_near(transform_point(shape_matrix("Scale 9 9 9 Identity"), {1, 2, 3}), {1, 2, 3});
}

TEST(Transforms, CoordinateSystemsAreKept) {
    const std::string head = "LookAt 1 2 3  1 2 9  0 1 0 Camera \"perspective\" WorldBegin\n";
    const Scene scene = scene_of(head +
                                 "Translate 4 4 4 CoordinateSystem \"here\" Identity\n"
                                 "AttributeBegin CoordSysTransform \"camera\" Shape \"sphere\"\n"
                                 "CoordSysTransform \"here\" Shape \"sphere\" AttributeEnd\n"
                                 "Shape \"sphere\" CoordSysTransform \"world\" Shape \"sphere\"");
    ASSERT_EQ(scene.shapes.size(), 4u);
    expect_near(transform_point(scene.shapes[0].world_from_object, {0, 0, 1}), {1, 2, 4});
    expect_near(transform_point(scene.shapes[1].world_from_object, {0, 0, 0}), {4, 4, 4});
    expect_near(transform_point(scene.shapes[2].world_from_object, {0, 0, 0}), {0, 0, 0});
    EXPECT_PLACE_AND_TEXT(world_error_of("CoordSysTransform \"wrold\""), "t.pbrt:2:1",
                          "did you mean 'world'?");
}

TEST(Transforms, MotionStandsAtItsStart) {
    const Scene scene = world_of(
        "TransformTimes 0 1 ActiveTransform EndTime Translate 9 9 9 ActiveTransform All\n"
        "Translate 1 0 0 Shape \"sphere\"");
    expect_near(transform_point(scene.shapes[0].world_from_object, {0, 0, 0}), {1, 0, 0});
    EXPECT_EQ(scene.stand_ins.size(), 2u);
}

TEST(Transforms, DegenerateOnesAreErrors) {
    EXPECT_PLACE_AND_TEXT(world_error_of("  Scale 1 0 1"), "t.pbrt:2:3", "flattens space");
    EXPECT_PLACE_AND_TEXT(world_error_of("Rotate 10 0 0 0"), "t.pbrt:2:1", "axis");
    EXPECT_PLACE_AND_TEXT(error_of("LookAt 1 1 1 1 1 1 0 1 0"), "t.pbrt:1:1", "point to itself");
    EXPECT_PLACE_AND_TEXT(error_of("LookAt 0 0 0 0 2 0 0 1 0"), "t.pbrt:1:1", "parallel");
    EXPECT_PLACE_AND_TEXT(world_error_of("Transform [ 1 2 3 0 2 4 6 0 0 0 1 0 0 0 0 1 ]"),
                          "t.pbrt:2:1", "singular");
    EXPECT_PLACE_AND_TEXT(world_error_of("Transform [ 1 0 0 5 0 1 0 0 0 0 1 0 0 0 0 1 ]"),
                          "t.pbrt:2:1", "affine");
    EXPECT_PLACE_AND_TEXT(world_error_of("Scale 1e10 1 1\nScale 1e10 1 1"), "t.pbrt:3:1",
                          "scales an axis");
    EXPECT_PLACE_AND_TEXT(world_error_of("Translate 1 nan 1"), "t.pbrt:2:13", "finite number");
    EXPECT_PLACE_AND_TEXT(world_error_of("Translate 1 1e999 1"), "t.pbrt:2:13", "finite number");
    EXPECT_PLACE_AND_TEXT(world_error_of("Transform [ 1 2 ]"), "t.pbrt:2:17", "finite number");
}

}  // namespace
}  // namespace drude
