// Cameras: known rays, areas and blurs, and the reference integrator's own formulas.
#include <gtest/gtest.h>

#include <random>

#include "chi_square.h"
#include "render/camera_ray.h"
#include "render/reference_camera.h"
#include "test_scenes.h"

namespace drude {
namespace {

Scene with_camera(const std::string& camera, int width, int height, const std::string& before = "",
                  const std::string& film = "") {
    return parse_scene(
        fmt::format("{}\nCamera {}\nFilm \"rgb\" \"integer xresolution\" {} \"integer "
                    "yresolution\" {} {}\nPixelFilter \"box\"\nWorldBegin\n",
                    before, camera, width, height, film),
        "camera.pbrt");
}

CameraRays rays_of(const Scene& scene) {
    return CameraRays(scene.camera, scene.film.width, scene.film.height);
}

void expect_near(const glm::vec3& a, const glm::dvec3& b, double tolerance = 1e-6) {
    EXPECT_LT(glm::distance(glm::dvec3(a), b), tolerance)
        << a.x << " " << a.y << " " << a.z << " is not " << b.x << " " << b.y << " " << b.z;
}

TEST(Camera, OrthographicRaysAreParallelAndStartInTheWindow) {
    const CameraRays rays = rays_of(with_camera("\"orthographic\"", 8, 4));
    const CameraRay corner = rays(0, 0), inside = rays(5, 3);
    expect_near(corner.o, {-2, 1, 0});
    expect_near(inside.o, {0.5, -0.5, 0});
    expect_near(corner.d, {0, 0, 1});
    expect_near(inside.d, {0, 0, 1});
    EXPECT_NEAR(std::abs(inside.horizontal.x), 1, 1e-6);
}

// Luminous squares like those of one colour of a chessboard, at distances that an orthographic
// picture does not see, and one behind the camera.
TEST(Camera, OrthographicPictureOfAChessboard) {
    constexpr int size = 8;
    std::string text =
        "Scale 1 1 3\nCamera \"orthographic\" \"float screenwindow\" [-4 4 -4 4]\n"
        "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\nPixelFilter \"box\"\n"
        "Integrator \"path\" \"integer maxdepth\" 0\nWorldBegin\n"
        "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"bool twosided\" true\n";
    const auto is_light = [](int x, int y) { return (x + 3 * y) % 4 == 0; };
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const bool light = is_light(x, y);
            const double x0 = x - 4, y1 = 4 - y, z = light ? 1 + x + y : -1;
            text += fmt::format(
                "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" "
                "[{0} {1} {4} {2} {1} {4} {2} {3} {4} {0} {3} {4}]\n",
                x0, y1, x0 + 1, y1 - 1, z);
        }
    }
    const RenderResult result = render_quietly(parse_scene(text, "board.pbrt"), 16);
    const Channel& g = *result.image.find("G");
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            EXPECT_NEAR(g.data[static_cast<size_t>(y) * size + x], is_light(x, y) ? 1 : 0, 5e-3)
                << x << " " << y;
        }
    }
}

TEST(Camera, SphericalDirections) {
    const double r = std::sqrt(0.5);
    // Left edge and right edge: camera x. A quarter of the way: ahead. The middle: -x.
    const CameraRays around =
        rays_of(with_camera("\"spherical\" \"string mapping\" \"equirectangular\"", 16, 8));
    expect_near(around(0, 4).d, {1, 0, 0});
    expect_near(around(4, 4).d, {0, 0, 1});
    expect_near(around(8, 4).d, {-1, 0, 0});
    expect_near(around(4, 2).d, {0, r, r});
    expect_near(around(11, 0).d, {0, 1, 0});
    expect_near(around(11, 8).d, {0, -1, 0});
    // Beyond the edge it goes on.
    expect_near(around(-1, 3).d, around(15, 3).d);
    expect_near(around(2, -1).d, around(10, 1).d);

    // The middle looks up, the corners down, the middles of the edges along the horizon.
    const CameraRays square = rays_of(with_camera("\"spherical\"", 8, 8));
    expect_near(square(4, 4).d, {0, 1, 0});
    for (const auto& [x, y] : {std::pair{0, 0}, {8, 0}, {0, 8}, {8, 8}}) {
        expect_near(square(x, y).d, {0, -1, 0}, 1e-3);
    }
    expect_near(square(8, 4).d, {1, 0, 0});
    expect_near(square(0, 4).d, {-1, 0, 0});
    expect_near(square(4, 8).d, {0, 0, 1});
    expect_near(square(4, 0).d, {0, 0, -1});
    // 1 - z = r^2 halfway along the axis: r = 1/2.
    expect_near(square(6, 4).d, {std::sqrt(1 - 0.75 * 0.75), 0.75, 0});
    for (const double t : {0.3, 2.0, 6.7}) {
        for (const double step : {1e-5, 0.4}) {
            expect_near(square(-step, t).d, square(step, 8 - t).d);
            expect_near(square(8 + step, t).d, square(8 - step, 8 - t).d);
            expect_near(square(t, -step).d, square(8 - t, step).d);
            expect_near(square(t, 8 + step).d, square(8 - t, 8 - step).d);
        }
    }
}

// The solid angle of a pixel, from triangles between finely spaced rays.
double solid_angle(const CameraRays& rays, int x, int y) {
    constexpr int n = 32;
    double sum = 0;
    const auto at = [&](int i, int j) {
        return glm::dvec3(rays(x + static_cast<double>(i) / n, y + static_cast<double>(j) / n).d);
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const glm::dvec3 a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
            sum += glm::length(glm::cross(b - a, c - a)) / 2;
            sum += glm::length(glm::cross(c - a, d - a)) / 2;
        }
    }
    return sum;
}

TEST(Camera, SphericalPixelsHaveTheirSolidAngle) {
    const CameraRays square = rays_of(with_camera("\"spherical\"", 8, 8));
    const CameraRays around =
        rays_of(with_camera("\"spherical\" \"string mapping\" \"equirectangular\"", 8, 8));
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) {
            EXPECT_NEAR(solid_angle(square, x, y), 4 * pi / 64, 2e-3 * 4 * pi / 64);
            EXPECT_NEAR(solid_angle(around, x, y),
                        pi / 4 * (std::cos(pi * y / 8) - std::cos(pi * (y + 1) / 8)), 2e-4);
        }
    }
}

// A pixel sees of the plane at depth z, through a lens of radius R that is focused at f, a disk of
// radius R |1 - z/f| around what a pinhole would see there, all of it alike.
TEST(Camera, CircleOfConfusion) {
    constexpr int cells = 8, samples = 40000;
    const double lens = 0.25, focus = 4;
    for (const char* kind : {"perspective", "orthographic"}) {
        const Scene scene =
            with_camera(fmt::format("\"{}\" \"float lensradius\" {} \"float focaldistance\" {}",
                                    kind, lens, focus),
                        16, 16);
        const CameraRays rays = rays_of(scene);
        ASSERT_TRUE(rays.has_lens());
        Scene pinhole = scene;
        pinhole.camera.lens_radius = 0;
        const CameraRay centre = rays_of(pinhole)(3, 5);
        for (const double z : {1.0, 4.0, 10.0}) {
            const glm::dvec3 middle =
                glm::dvec3(centre.o) + z / static_cast<double>(centre.d.z) * glm::dvec3(centre.d);
            const double radius = lens * std::abs(1 - z / focus);
            std::vector<double> observed(cells * cells),
                expected(cells * cells, samples / 1.0 / cells / cells);
            std::mt19937 random(3);
            std::uniform_real_distribution<float> uniform(0, 0x1.fffffep-1f);
            for (int i = 0; i < samples; ++i) {
                const float u = uniform(random), v = uniform(random);
                const CameraRay ray = rays(3, 5, {u, v});
                EXPECT_EQ(ray.o.z, 0);
                const glm::dvec3 p =
                    glm::dvec3(ray.o) + z / static_cast<double>(ray.d.z) * glm::dvec3(ray.d);
                const double x = p.x - middle.x, y = p.y - middle.y;
                const double r2 = x * x + y * y;
                ASSERT_LT(std::sqrt(r2), radius + 1e-5);
                if (radius == 0) continue;
                // Even in the square of the radius and in the angle.
                const int a = std::min(cells - 1, static_cast<int>(r2 / (radius * radius) * cells));
                const int b = std::clamp(
                    static_cast<int>((std::atan2(y, x) / (2 * pi) + 0.5) * cells), 0, cells - 1);
                observed[static_cast<size_t>(a * cells + b)] += 1;
            }
            if (radius > 0) {
                EXPECT_LT(chi_square_deviate(observed, expected), 4) << kind << z;
            }
        }
    }
}

// Formulas of its own, kinds, mirrored and turned worlds, crops.
TEST(Camera, AgreesWithTheReferenceIntegrators) {
    const char* cameras[] = {"\"perspective\" \"float fov\" 70", "\"orthographic\"",
                             "\"spherical\"",
                             "\"spherical\" \"string mapping\" \"equirectangular\""};
    const char* worlds[] = {"LookAt 3 -4 2  0 0 1  0.2 0 1",
                            "Scale -1 1 1 LookAt 3 -4 2  0 0 1  0 0.1 1",
                            "Rotate 30 1 2 3 Scale 2 2 2"};
    const char* films[] = {"", "\"float cropwindow\" [0.25 0.75 0.1 0.6]"};
    std::mt19937 random(8);
    std::uniform_real_distribution<double> across(-1, 25), down(-1, 17);
    for (const char* camera : cameras) {
        for (const char* world : worlds) {
            for (const char* film : films) {
                SCOPED_TRACE(fmt::format("{} {} {}", camera, world, film));
                const Scene scene = with_camera(camera, 24, 16, world, film);
                const CameraRays rays = rays_of(scene);
                const ReferenceCamera reference(scene);
                EXPECT_EQ(rays.handedness(), static_cast<float>(reference.handedness()));
                EXPECT_FALSE(rays.has_lens());
                for (int i = 0; i < 200; ++i) {
                    const double x = across(random), y = down(random);
                    const CameraRay fast = rays(x, y);
                    const ReferenceRay slow = reference.ray(x, y);
                    expect_near(fast.o, slow.o);
                    expect_near(fast.d, slow.d);
                    // In float the horizontal is the less certain the closer the ray is to camera
                    // y.
                    const double sine = glm::length(glm::cross(
                        slow.d, glm::normalize(glm::dvec3(scene.camera.world_from_camera[1]))));
                    expect_near(fast.horizontal, slow.horizontal, 1e-6 / std::max(sine, 1e-3));
                }
            }
        }
    }
    // With a lens: the same bundle, sampled otherwise.
    const Scene scene = with_camera(
        "\"perspective\" \"float lensradius\" 0.5 \"float focaldistance\" 3", 24, 16, worlds[1]);
    const CameraRays rays = rays_of(scene);
    const ReferenceCamera reference(scene);
    ASSERT_TRUE(reference.has_lens());
    const auto focus_of = [&](const glm::dvec3& o, const glm::dvec3& d) {
        const glm::dvec3 ahead = glm::normalize(glm::dvec3(scene.camera.world_from_camera[2]));
        const glm::dvec3 eye(scene.camera.world_from_camera[3]);
        return o + (3 - glm::dot(o - eye, ahead)) / glm::dot(d, ahead) * d;
    };
    double mean[2] = {0, 0};
    for (int i = 0; i < 1000; ++i) {
        const double u = (i % 10 + 0.5) / 10, v = (i / 10 % 10 + 0.5) / 10;
        const CameraRay fast = rays(5, 11, {static_cast<float>(u), static_cast<float>(v)});
        const ReferenceRay slow = reference.ray(5, 11, u, v);
        expect_near(glm::vec3(focus_of(glm::dvec3(fast.o), glm::dvec3(fast.d))),
                    focus_of(slow.o, slow.d), 1e-5);
        mean[0] += glm::length(glm::dvec3(fast.o) - reference.ray(5, 11).o) / 1000;
        mean[1] += glm::length(slow.o - reference.ray(5, 11).o) / 1000;
    }
    // The points of a disk are on average 2/3 of its radius from its middle.
    EXPECT_NEAR(mean[0], 0.5 * 2 / 3, 5e-3);
    EXPECT_NEAR(mean[1], 0.5 * 2 / 3, 5e-3);
}

// A crop is the part of the whole: its rays are the whole's.
TEST(Camera, CropsAreParts) {
    for (const char* camera : {"\"perspective\"", "\"orthographic\"", "\"spherical\""}) {
        const Scene whole = with_camera(camera, 20, 12);
        const Scene part = with_camera(camera, 20, 12, "", "\"integer pixelbounds\" [3 11 2 10]");
        EXPECT_EQ(part.film.width, 8);
        EXPECT_EQ(part.film.height, 8);
        const CameraRays a = rays_of(whole), b = rays_of(part);
        expect_near(b(2.5, 7).d, glm::dvec3(a(5.5, 9).d));
        expect_near(b(2.5, 7).o, glm::dvec3(a(5.5, 9).o));
    }
}

}  // namespace
}  // namespace drude
