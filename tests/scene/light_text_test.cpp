// Point lights, spots and polarised lights as a scene writes them.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "materials/scalar.h"
#include "scene_text.h"

namespace drude {
namespace {

TEST(LightText, PointsAndSpots) {
    const Scene scene = world_of(
        "Translate 1 0 0 Scale 2 2 2\n"
        "LightSource \"point\" \"point3 from\" [1 2 3] \"rgb I\" [4 4 4] \"float scale\" 2\n"
        "LightSource \"spot\" \"point3 from\" [0 0 1] \"point3 to\" [0 3 1]\n"
        "LightSource \"spot\" \"float power\" 10 \"float coneangle\" 90 \"float conedeltaangle\" "
        "90\n"
        "LightSource \"point\" \"blackbody I\" 3000 \"float power\" 20");
    ASSERT_EQ(scene.point_lights.size(), 4u);
    EXPECT_TRUE(scene.stand_ins.empty());
    const PointLight& point = scene.point_lights[0];
    EXPECT_EQ(point.position, glm::dvec3(3, 4, 6));
    EXPECT_NEAR(luminance(point.intensity), 8, 1e-9);
    EXPECT_EQ(point.cos_end, -1);
    const PointLight& spot = scene.point_lights[1];
    EXPECT_EQ(spot.position, glm::dvec3(1, 0, 2));
    EXPECT_LT(glm::distance(spot.axis, glm::dvec3(0, 1, 0)), 1e-15);
    EXPECT_NEAR(spot.cos_end, std::cos(pi / 6), 1e-15);
    EXPECT_NEAR(spot.cos_start, std::cos(25 * degree), 1e-15);
    EXPECT_NEAR(luminance(spot.intensity), 1, 1e-9);
    // A falloff over the whole hemisphere: half of its 2 pi.
    EXPECT_NEAR(luminance(scene.point_lights[2].intensity), 10 / pi, 1e-9);
    EXPECT_NEAR(luminance(scene.point_lights[3].intensity), 20 / (4 * pi), 1e-9);
}

TEST(LightText, WhatIsNotModelledIsSaid) {
    const Scene scene = world_of(
        "LightSource \"goniometric\" \"string filename\" \"a.exr\"\n"
        "LightSource \"projection\" \"string filename\" \"a.exr\" \"float fov\" 30\n"
        "LightSource \"infinite\" \"point3 portal\" [0 0 0 1 0 0 1 1 0 0 1 0]\n"
        "Scale 1 2 3 LightSource \"spot\"");
    EXPECT_EQ(scene.stand_ins.size(), 4u);
    EXPECT_TRUE(warns(scene, "LightSource \"goniometric\" is not modelled; it is left out"));
    EXPECT_TRUE(warns(scene, "a portal is not modelled"));
    EXPECT_TRUE(warns(scene, "t.pbrt:5:13: LightSource \"spot\": a cone"));
    EXPECT_EQ(scene.point_lights.size(), 1u);
}

TEST(LightText, Polarisation) {
    const Scene scene = world_of(
        "LightSource \"distant\" \"float dop\" 0.5 \"float aolp\" 30\n"
        "LightSource \"infinite\" \"float dop\" 1\n"
        "LightSource \"infinite\" \"string polarisation\" \"rayleigh\" \"vector3 sun\" [0 3 4] "
        "\"float dop\" 0.8 \"float scale\" 2\n"
        "Rotate 90 0 0 1 LightSource \"point\" \"float dop\" 0.25\n"
        "AreaLightSource \"diffuse\" \"float dop\" 0.75 \"float aolp\" -20 Shape \"sphere\"\n"
        "Attribute \"light\" \"float dop\" 0.125\nLightSource \"spot\"\n"
        "AreaLightSource \"diffuse\"  \"float power\" 3 Shape \"sphere\"");
    EXPECT_EQ(scene.distant_lights.at(0).polarisation.dop, 0.5);
    EXPECT_EQ(scene.distant_lights[0].polarisation.aolp_deg, 30);
    EXPECT_EQ(scene.distant_lights[0].x_axis, glm::dvec3(1, 0, 0));
    // One that shines along its own x has its angle from y.
    EXPECT_EQ(world_of("LightSource \"distant\" \"float dop\" 1 \"point3 to\" [2 0 0]")
                  .distant_lights.at(0)
                  .x_axis,
              glm::dvec3(0, 1, 0));
    EXPECT_EQ(scene.infinite_lights.at(0).polarisation.dop, 1);
    ASSERT_TRUE(scene.infinite_lights.at(1).rayleigh);
    EXPECT_TRUE(scene.infinite_lights[1].polarisation.none());
    EXPECT_EQ(scene.infinite_lights[1].rayleigh->maximum, 0.8);
    EXPECT_LT(glm::distance(scene.infinite_lights[1].rayleigh->sun, glm::dvec3(0, 0.6, 0.8)),
              1e-15);
    EXPECT_LT(glm::distance(scene.point_lights.at(0).x_axis, glm::dvec3(0, 1, 0)), 1e-15);
    EXPECT_EQ(scene.area_lights.at(0).polarisation.aolp_deg, -20);
    EXPECT_EQ(scene.point_lights.at(1).polarisation.dop, 0.125);
    EXPECT_EQ(scene.area_lights.at(1).polarisation.dop, 0.125);
    EXPECT_TRUE(scene.stand_ins.empty());
}

TEST(LightText, PolarisationThatMakesNoSense) {
    const auto expect_error = [](const std::string& parameters, const std::string& part) {
        const std::string message = world_error_of("LightSource \"infinite\" " + parameters);
        EXPECT_TRUE(contains(message, part)) << message;
    };
    expect_error("\"float dop\" 1.5", "dop is 1.5; expected 0 to 1");
    expect_error("\"float aolp\" 20", "aolp without \"float dop\"");
    expect_error("\"float dops\" 0.5", "did you mean 'dop'");
    expect_error("\"string polarisation\" \"raleigh\"", "'rayleigh'");
    expect_error("\"vector3 sun\" [0 0 1]", "a sun without");
    expect_error("\"string polarisation\" \"rayleigh\" \"vector3 sun\" [0 0 0]", "no direction");
    expect_error("\"string polarisation\" \"rayleigh\" \"vector3 sun\" [0 0 1 2 2 2]",
                 "expected 3");
    expect_error("\"string polarisation\" \"rayleigh\" \"float aolp\" 3", "angle of its own");
    EXPECT_TRUE(
        contains(world_error_of("LightSource \"point\" \"string polarisation\" \"rayleigh\""),
                 "has no parameter 'polarisation'"));
}

}  // namespace
}  // namespace drude
