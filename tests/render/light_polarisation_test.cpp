// Polarised lights: where their axes lie, in ordinary and in mirrored worlds, derived twice.
#include <gtest/gtest.h>

#include <random>

#include "materials/frame.h"
#include "render/camera_ray.h"
#include "render/geometry.h"
#include "render/lights.h"
#include "render/reference.h"
#include "render/reference_light.h"
#include "test_scenes.h"

namespace drude {
namespace {

// The AoLP, in degrees within [0, 180), of (s1, s2).
double aolp(double s1, double s2) {
    const double angle = std::atan2(s2, s1) / 2 / degree;
    return angle < 0 ? angle + 180 : angle;
}

// Between two directions of polarisation, in degrees.
double apart(double a, double b) {
    const double difference = std::abs(std::fmod(a - b, 180));
    return std::min(difference, 180 - difference);
}

// S0..S3 of pixel (x, y) of a picture of `size` pixels, seen from the origin along +z of an
// ordinary pbrt world with `before` in front of it.
std::array<double, 4> seen(const std::string& before, const std::string& world, int x, int y,
                           double fov = 60, int size = 5) {
    const Scene scene = parse_scene(
        fmt::format("{}\nCamera \"perspective\" \"float fov\" {}\nFilm \"rgb\" \"integer "
                    "xresolution\" {} \"integer yresolution\" {}\nPixelFilter \"box\" \"float "
                    "xradius\" 0.001 \"float yradius\" 0.001\nWorldBegin\n{}",
                    before, fov, size, size, world),
        "seen.pbrt");
    ReferenceOptions options;
    options.bands_nm = {{550}};
    options.samples_per_pixel = 2;
    options.threads = 1;
    return render_reference(scene, options).at(x, y, 0).mean;
}

// A luminous square across the view: its x axis is turned by 30 degrees from right to up, and its
// light by another 20. Mirrored, the picture shows its x axis at 150 degrees; the 20 are counter-
// clockwise still.
TEST(LightPolarisation, AnAreaLightTurnsWithItsObject) {
    const std::string light =
        "AreaLightSource \"diffuse\" \"float dop\" 0.6 \"float aolp\" 20 \"bool twosided\" true\n"
        "Translate 0 0 2 Rotate 30 0 0 1\nShape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] "
        "\"point3 P\" [-1 -1 0 1 -1 0 1 1 0 -1 1 0]\n";
    for (const auto& [before, expected] : {std::pair{"", 50.0}, std::pair{"Scale -1 1 1", 170.0}}) {
        const auto s = seen(before, light, 2, 2);
        EXPECT_GT(s[0], 0);
        EXPECT_NEAR(std::hypot(s[1], s[2]) / s[0], 0.6, 1e-9);
        EXPECT_LT(apart(aolp(s[1], s[2]), expected), 0.05) << before;
        EXPECT_EQ(s[3], 0);
    }
    // An object that is mirrored itself: its x axis is another, the sense of the angle is the
    // viewer's.
    const auto s = seen("",
                        "AreaLightSource \"diffuse\" \"float dop\" 1 \"float aolp\" 20 \"bool "
                        "twosided\" true\nTranslate 0 0 2 Rotate 30 0 0 1 Scale -1 1 1\n"
                        "Shape \"disk\"\n",
                        2, 2);
    EXPECT_LT(apart(aolp(s[1], s[2]), 50), 0.05);
}

// With the light's z upwards the zero of a sky is the horizontal of the picture in its middle
// column, so that AoLP in the picture is the light's own.
TEST(LightPolarisation, ASkyHasItsAngleFromTheHorizontal) {
    for (const char* before : {"", "Scale -1 1 1"}) {
        const std::string sky =
            "Rotate -90 1 0 0\nLightSource \"infinite\" \"float dop\" 0.25 \"float aolp\" 40\n";
        for (const int y : {0, 2, 4}) {
            const auto s = seen(before, sky, 2, y);
            EXPECT_NEAR(std::hypot(s[1], s[2]) / s[0], 0.25, 1e-9);
            EXPECT_LT(apart(aolp(s[1], s[2]), 40), 0.05) << before << y;
        }
    }
}

// Rayleigh's pattern around a sun in the middle of the picture: tangential, and of the degree
// sin^2 g / (1 + cos^2 g).
TEST(LightPolarisation, RayleighIsTangentialAroundTheSun) {
    const std::string sky =
        "LightSource \"infinite\" \"string polarisation\" \"rayleigh\" \"float dop\" 0.8 "
        "\"vector3 sun\" [0 0 2]\n";
    for (const char* before : {"", "Scale -1 1 1"}) {
        for (const auto& [x, y, expected] :
             {std::tuple{4, 0, 135.0}, std::tuple{0, 0, 45.0}, std::tuple{2, 0, 0.0},
              std::tuple{4, 2, 90.0}, std::tuple{4, 4, 45.0}}) {
            // Close to the axis, where the pixel's horizontal is the picture's.
            const auto s = seen(before, sky, x, y, 10);
            EXPECT_LT(apart(aolp(s[1], s[2]), expected), 0.2) << x << y << before;
            const double px = (x + 0.5) / 5 * 2 - 1, py = (y + 0.5) / 5 * 2 - 1;
            const double tangent = std::tan(5 * degree);
            const double tan2 = (px * px + py * py) * tangent * tangent;
            EXPECT_NEAR(std::hypot(s[1], s[2]) / s[0], 0.8 * tan2 / (2 + tan2), 1e-5);
        }
    }
}

TEST(LightPolarisation, RayleighAtKnownDirections) {
    InfiniteLight light;
    light.rayleigh = RayleighPattern{{0, 0, 1}, 0.75};
    const SkyPolarisation sky(light, -1);
    EXPECT_FALSE(sky.none());
    EXPECT_EQ(sky.arriving({0, 0, 1}).dop, 0);
    EXPECT_EQ(sky.arriving({0, 0, -1}).dop, 0);
    const ArrivingPolarisation across = sky.arriving({1, 0, 0});
    EXPECT_NEAR(across.dop, 0.75, 1e-6);
    EXPECT_NEAR(std::abs(across.axis.y), 1, 1e-6);
    const float h = std::sqrt(0.5f);
    const ArrivingPolarisation between = sky.arriving({0, h, h});  // sin^2 = cos^2 = 1/2
    EXPECT_NEAR(between.dop, 0.75 / 3, 1e-6);
    EXPECT_NEAR(std::abs(between.axis.x), 1, 1e-6);
    // Close to the sun g^2/2, without cancellation.
    EXPECT_NEAR(sky.arriving(glm::normalize(glm::vec3(1e-3f, 0, 1))).dop / (0.75 * 0.5e-6), 1,
                1e-4);
    // It turns with the light.
    light.world_from_light = glm::dmat4({0, 0, -1, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, 0, 1});
    const SkyPolarisation turned(light, -1);
    EXPECT_NEAR(turned.arriving({1, 0, 0}).dop, 0, 1e-6);
    EXPECT_NEAR(turned.arriving({0, 0, 1}).dop, 0.75, 1e-6);
}

// The axis that light sampling and hits are told, against the reference's Stokes vector: the two
// are derived independently.
TEST(LightPolarisation, SamplesAndHitsAgreeWithTheReference) {
    for (const char* before :
         {"LookAt 3 -4 2  0 0 1  0 0 1", "Scale -1 1 1 LookAt 3 -4 2  0 0 1  0 0 1"}) {
        const Scene scene = parse_scene(
            std::string(before) +
                "\nWorldBegin\nMaterial \"diffuse\"\n"
                "AttributeBegin Rotate 50 1 2 -1\n"
                "LightSource \"infinite\" \"float dop\" 0.3 \"float aolp\" 70\n"
                "Scale -1 1 1 LightSource \"infinite\" \"string polarisation\" \"rayleigh\" "
                "\"vector3 sun\" [1 -2 3]\n"
                "LightSource \"distant\" \"float dop\" 0.4 \"float aolp\" -35 "
                "\"point3 to\" [1 1 -2]\n"
                "LightSource \"point\" \"point3 from\" [1 2 3] \"float dop\" 1 \"float aolp\" 10\n"
                "LightSource \"spot\" \"point3 from\" [2 -2 3] \"float coneangle\" 170 \"float "
                "dop\" "
                "0.5 \"float aolp\" 10\nAttributeEnd\n"
                "AttributeBegin\nAreaLightSource \"diffuse\" \"float dop\" 0.9 \"float aolp\" 130\n"
                "Rotate 40 1 2 3 Scale -2 0.5 0.2 Shape \"sphere\" AttributeEnd\n"
                "AreaLightSource \"diffuse\" Translate 0 8 0 Shape \"sphere\"\n",
            "lights.pbrt");
        const Geometry geometry(scene);
        const Lights lights(scene, geometry);
        EXPECT_TRUE(lights.any_polarised());
        const double h = picture_handedness(scene.camera);
        const ReferenceSky skies[] = {ReferenceSky(scene.infinite_lights[0]),
                                      ReferenceSky(scene.infinite_lights[1])};
        std::mt19937 random(9);
        std::uniform_real_distribution<float> uniform(0, 0x1.fffffep-1f);
        int counts[5] = {0, 0, 0, 0, 0};
        for (int i = 0; i < 4000; ++i) {
            const float choice = uniform(random), u = uniform(random), v = uniform(random);
            const glm::vec3 at(0.3f, -9.0f, 1.0f + u);
            const Lights::Sample s = lights.sample(at, choice, {u, v});
            if (!(s.pdf > 0)) continue;
            ++counts[static_cast<int>(s.kind)];
            const glm::dvec3 d(s.d);
            const glm::dvec3 frame = any_perpendicular(d);
            Stokes<double> expected{};
            switch (s.kind) {
                case Lights::Kind::environment:
                case Lights::Kind::constant:
                    expected = skies[s.light].stokes(d, frame, h);
                    break;
                case Lights::Kind::distant: {
                    const DistantLight& light = scene.distant_lights[s.light];
                    expected = emitted_stokes(light.polarisation, light.x_axis, -d, frame, h);
                    break;
                }
                case Lights::Kind::point: {
                    const PointLight& light = scene.point_lights[s.light];
                    expected = emitted_stokes(light.polarisation, light.x_axis, -d, frame, h);
                    break;
                }
                case Lights::Kind::area: {
                    Hit hit;
                    ASSERT_TRUE(geometry.intersect(at, s.d, &hit));
                    if (hit.shape != s.light) break;  // hidden by the other
                    expected = emitted_stokes(
                        scene.area_lights[s.light].polarisation,
                        glm::dvec3(scene.shapes[s.light].world_from_object[0]), -d, frame, h);
                    // What a path is told that walks into it.
                    const ArrivingPolarisation walked = lights.area_polarisation(hit, s.d);
                    EXPECT_EQ(walked.dop, s.polarisation.dop);
                    if (walked.dop > 0) {
                        EXPECT_EQ(walked.axis, s.polarisation.axis);
                    }
                    break;
                }
            }
            if (expected[0] == 0) continue;
            const double dop = static_cast<double>(s.polarisation.dop);
            EXPECT_NEAR(std::hypot(expected[1], expected[2]), dop, 1e-5);
            if (!(dop > 0)) continue;
            EXPECT_NEAR(glm::length(s.polarisation.axis), 1, 1e-5);
            EXPECT_NEAR(glm::dot(s.polarisation.axis, s.d), 0, 1e-5);
            const auto r = rotation_between<double>(-d, frame, glm::dvec3(s.polarisation.axis), h);
            EXPECT_NEAR(dop * r.cos2, expected[1], 2e-5);
            EXPECT_NEAR(dop * r.sin2, expected[2], 2e-5);
        }
        for (const Lights::Kind kind : {Lights::Kind::constant, Lights::Kind::distant,
                                        Lights::Kind::point, Lights::Kind::area}) {
            EXPECT_GT(counts[static_cast<int>(kind)], 50) << static_cast<int>(kind);
        }
    }
}

TEST(LightPolarisation, IsNoneWhereNothingIsSaid) {
    const Scene scene = parse_scene(
        "WorldBegin LightSource \"infinite\" \"float dop\" 0 \"float aolp\" 30 LightSource "
        "\"point\" LightSource \"infinite\" \"string polarisation\" \"rayleigh\" \"float dop\" 0 "
        "Shape \"sphere\"",
        "plain.pbrt");
    EXPECT_FALSE(has_polarised_lights(scene));
    const Geometry geometry(scene);
    const Lights lights(scene, geometry);
    EXPECT_FALSE(lights.any_polarised());
    EXPECT_EQ(lights.sample({0, 0, 5}, 0.1f, {0.5f, 0.5f}).polarisation.dop, 0);
}

}  // namespace
}  // namespace drude
