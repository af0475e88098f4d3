// Disks, cylinders, spheres and meshes: what rays meet, uv, areas, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "materials/scalar.h"
#include "render/geometry.h"
#include "render/reference_geometry.h"
#include "scene/builders.h"

namespace drude {
namespace {

const char* const transforms[] = {
    "",
    "Translate 3 -20 7\n",
    "Scale -1 1 1\n",
    "Rotate 37 1 2 3\nScale 0.4 2 1.3\nTranslate 1 2 3\n",
    "Translate 100 50 -30\nRotate -110 3 1 -2\nScale 1 1 -0.01\n",
};

Scene scene_with(const std::string& transform, const std::string& shape) {
    return parse_scene("WorldBegin\nMaterial \"diffuse\"\n" + transform + shape, "t.pbrt");
}

constexpr double turn = 2 * pi;

// A shape as its definition has it: the point of (u, v) in its own space, and its normal.
struct Definition {
    const char* text;
    glm::dvec3 (*point)(double u, double v);
    glm::dvec3 (*normal)(double u, double v);
};

const Definition definitions[] = {
    {"Shape \"disk\" \"float height\" 0.5 \"float radius\" 2 \"float innerradius\" 0.5 "
     "\"float phimax\" 300",
     [](double u, double v) {
         const double phi = u * turn * 300 / 360, r = 2 - 1.5 * v;
         return glm::dvec3(r * std::cos(phi), r * std::sin(phi), 0.5);
     },
     [](double, double) { return glm::dvec3(0, 0, 1); }},
    {"Shape \"disk\" \"float radius\" 3",
     [](double u, double v) {
         const double r = 3 - 3 * v;
         return glm::dvec3(r * std::cos(turn * u), r * std::sin(turn * u), 0);
     },
     [](double, double) { return glm::dvec3(0, 0, 1); }},
    {"Shape \"cylinder\" \"float radius\" 0.7 \"float zmin\" -1 \"float zmax\" 2 "
     "\"float phimax\" 250",
     [](double u, double v) {
         const double phi = u * turn * 250 / 360;
         return glm::dvec3(0.7 * std::cos(phi), 0.7 * std::sin(phi), -1 + 3 * v);
     },
     [](double u, double) {
         const double phi = u * turn * 250 / 360;
         return glm::dvec3(std::cos(phi), std::sin(phi), 0);
     }},
    {"Shape \"sphere\" \"float radius\" 2 \"float zmin\" -1 \"float zmax\" 1.5 "
     "\"float phimax\" 200",
     [](double u, double v) {
         const double phi = u * turn * 200 / 360;
         const double low = std::acos(-0.5), high = std::acos(0.75);
         const double theta = low + v * (high - low);
         return 2.0 * glm::dvec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                 std::cos(theta));
     },
     [](double u, double v) {
         const double phi = u * turn * 200 / 360;
         const double low = std::acos(-0.5), high = std::acos(0.75);
         const double theta = low + v * (high - low);
         return glm::dvec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                           std::cos(theta));
     }},
    // A parallelogram in the pattern of pbrt's default uv: u is its first side, v its second.
    {"Shape \"trianglemesh\" \"point3 P\" [0 0 0  2 0 0  2 1 1  0 0 0  2 1 1  0 1 1] "
     "\"integer indices\" [0 1 2  3 4 5] \"point2 uv\" [0 0  1 0  1 1  0 0  1 1  0 1]",
     [](double u, double v) { return glm::dvec3(2 * u, v, v); },
     [](double, double) { return glm::dvec3(0, -std::sqrt(0.5), std::sqrt(0.5)); }},
    {"Shape \"bilinearmesh\" \"point3 P\" [0 0 0  2 0 0  0 1 1  2 1 1]",
     [](double u, double v) { return glm::dvec3(2 * u, v, v); },
     [](double, double) { return glm::dvec3(0, -std::sqrt(0.5), std::sqrt(0.5)); }},
};

class ShapeUv : public testing::TestWithParam<Definition> {};

TEST_P(ShapeUv, RaysMeetThePointsOfTheDefinitionWithTheirUvAndNormal) {
    const Definition& shape = GetParam();
    for (const char* transform : transforms) {
        const Scene scene = scene_with(transform, shape.text);
        const Geometry geometry(scene);
        const ReferenceGeometry reference(scene);
        const glm::dmat4 m = scene.shapes[0].world_from_object;
        const glm::dmat3 normal_matrix = glm::transpose(glm::inverse(glm::dmat3(m)));
        std::mt19937 random(1);
        std::uniform_real_distribution<double> uniform(0.02, 0.98);
        for (int i = 0; i < 200; ++i) {
            const double u = uniform(random), v = uniform(random);
            const glm::dvec3 p(m * glm::dvec4(shape.point(u, v), 1));
            const glm::dvec3 n = glm::normalize(normal_matrix * shape.normal(u, v));
            // From close by, once on either side, so that the shape itself is not in the way.
            for (const double side : {1.0, -1.0}) {
                const glm::dvec3 o = p + side * 1e-3 * n;
                const glm::dvec3 d = -side * n;
                ReferenceHit slow;
                ASSERT_TRUE(reference.intersect(o, d, -1, &slow));
                EXPECT_NEAR(slow.uv.x, u, 1e-6);
                EXPECT_NEAR(slow.uv.y, v, 1e-6);
                EXPECT_LT(glm::length(slow.p - p), 1e-9 * (1 + glm::length(p)));
                EXPECT_LT(glm::length(slow.ng - n), 1e-7);
                Hit hit;
                ASSERT_TRUE(geometry.intersect(glm::vec3(o), glm::vec3(d), &hit));
                const glm::dvec2 uv = geometry.uv(hit);
                EXPECT_LT(glm::length(glm::dvec3(hit.p) - p), 2e-5);
                // The last transformation makes a float's rounding of 1e-5 a hundred times larger
                // in the shape's own space.
                const double far = glm::length(p) > 50 ? 5e-3 : 2e-5;
                EXPECT_LT(glm::length(glm::dvec3(hit.ng) - n), 10 * far);
                EXPECT_NEAR(uv.x, u, far);
                EXPECT_NEAR(uv.y, v, far);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, ShapeUv, testing::ValuesIn(definitions));

TEST(TriangleUv, WithoutUvEveryTriangleHasPbrtsDefaultCorners) {
    const Scene scene = scene_with("", "Shape \"trianglemesh\" \"point3 P\" [0 0 0  1 0 0  0 1 0]");
    const Geometry geometry(scene);
    Hit hit;
    // Weights 0.5, 0.3, 0.2 of the corners (0, 0), (1, 0), (1, 1).
    ASSERT_TRUE(geometry.intersect({0.3f, 0.2f, 1}, {0, 0, -1}, &hit));
    EXPECT_NEAR(geometry.uv(hit).x, 0.5, 1e-6);
    EXPECT_NEAR(geometry.uv(hit).y, 0.2, 1e-6);
}

TEST(RoundShapes, RaysMissWhatIsCutAway) {
    struct Case {
        const char* shape;
        glm::vec3 o, d;
        bool hits;
    };
    const char* ring = "Shape \"disk\" \"float innerradius\" 0.5 \"float phimax\" 90";
    const char* pipe = "Shape \"cylinder\" \"float zmin\" 0 \"float phimax\" 180";
    const Case cases[] = {
        {ring, {0.5f, 0.5f, 1}, {0, 0, -1}, true},
        {ring, {0.2f, 0.2f, 1}, {0, 0, -1}, false},   // the hole
        {ring, {0.8f, 0.8f, 1}, {0, 0, -1}, false},   // beyond the edge
        {ring, {-0.5f, 0.5f, 1}, {0, 0, -1}, false},  // beyond the sector
        {ring, {0.5f, 0.5f, 1}, {1, 0, 0}, false},    // along the plane
        {ring, {0.5f, 0.5f, 1}, {0, 0, 1}, false},    // behind the ray
        {pipe, {0, 3, 0.5f}, {0, -1, 0}, true},
        {pipe, {0, -3, 0.5f}, {0, 1, 0}, true},    // through the missing half to the inside
        {pipe, {0, 0, 0.5f}, {0, -1, 0}, false},   // from within, out of the missing half
        {pipe, {0, 3, -0.5f}, {0, -1, 0}, false},  // below
        {pipe, {0, 3, 1.5f}, {0, -1, 0}, false},   // above
        {pipe, {0.5f, 0, -3}, {0, 0, 1}, false},   // along the axis
        {pipe, {2, 2, 0.5f}, {1, 0, 0}, false},
    };
    for (const Case& c : cases) {
        const Scene scene = scene_with("", c.shape);
        const Geometry geometry(scene);
        Hit hit;
        ReferenceHit slow;
        EXPECT_EQ(geometry.intersect(c.o, c.d, &hit), c.hits) << c.shape;
        EXPECT_EQ(geometry.occluded(c.o, c.d, 100), c.hits) << c.shape;
        EXPECT_EQ(ReferenceGeometry(scene).intersect(c.o, c.d, -1, &slow), c.hits) << c.shape;
    }
}

// A ray that leaves the surface on one side must not meet the place it came from, however far from
// the origin, small or squeezed the shape is.
TEST(RoundShapes, LeavingRaysDoNotMeetTheirOwnStart) {
    const char* shapes[] = {"Shape \"disk\" \"float radius\" 1", "Shape \"cylinder\""};
    const char* places[] = {"", "Translate 1000 -2000 500\nScale 0.1 0.1 0.1\n",
                            "Translate 5 5 5\nScale 1 1e-3 1\n", "Scale 1e6 1e6 1e6\n"};
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(-1, 1);
    for (const char* shape : shapes) {
        for (const char* place : places) {
            const Scene scene = scene_with(place, shape);
            const Geometry geometry(scene);
            for (int i = 0; i < 2000; ++i) {
                const auto from = geometry.sample(
                    0, 0, {0.5f + 0.49f * uniform(random), 0.5f + 0.49f * uniform(random)});
                glm::vec3 d =
                    glm::normalize(glm::vec3(uniform(random), uniform(random), uniform(random)));
                // Outwards, where nothing of a convex shape can be in the way.
                if (glm::dot(d, from.hit.ng) < 0) d = -d;
                EXPECT_FALSE(geometry.occluded(leave(from.hit, d), d, 1e9f)) << shape << place;
            }
        }
    }
}

double numeric_area(const Definition& shape, const glm::dmat4& m) {
    // The area element |dp/du x dp/dv| by finite differences, midpoint rule.
    constexpr int steps = 200;
    const auto at = [&](double u, double v) {
        return glm::dvec3(m * glm::dvec4(shape.point(u, v), 1));
    };
    double sum = 0;
    const double h = 1e-4;
    for (int i = 0; i < steps; ++i) {
        for (int j = 0; j < steps; ++j) {
            const double u = (i + 0.5) / steps, v = (j + 0.5) / steps;
            sum +=
                glm::length(glm::cross(at(u + h, v) - at(u - h, v), at(u, v + h) - at(u, v - h)));
        }
    }
    return sum / (4 * h * h * steps * steps);
}

TEST(ShapeArea, AreaAndDensityAgreeWithTheDefinition) {
    for (const Definition& shape : definitions) {
        for (const char* transform : transforms) {
            const Scene scene = scene_with(transform, shape.text);
            const Geometry geometry(scene);
            double area = 0, density_check = 0;
            std::mt19937 random(3);
            std::uniform_real_distribution<float> uniform(0, 1);
            for (unsigned p = 0; p < geometry.primitives(0); ++p) {
                area += geometry.area(0, p);
                // The mean of 1 / density over the samples is the area.
                for (int i = 0; i < 40000; ++i) {
                    const auto s = geometry.sample(0, p, {uniform(random), uniform(random)});
                    density_check += 1 / static_cast<double>(s.density) / 40000;
                    if (i > 20) continue;
                    // The point is one that rays meet, and density() says the same of it there.
                    Hit hit;
                    const glm::vec3 o = s.hit.p + 1e-3f * s.hit.ng;
                    ASSERT_TRUE(geometry.intersect(o, -s.hit.ng, &hit));
                    EXPECT_NEAR(geometry.density(hit) / s.density, 1, 2e-3);
                }
            }
            const double expected = numeric_area(shape, scene.shapes[0].world_from_object);
            EXPECT_NEAR(area / expected, 1, 2e-4) << shape.text << transform;
            EXPECT_NEAR(density_check / expected, 1, 1e-2) << shape.text << transform;
        }
    }
}

// The parts of a cut surface get the share of samples that their area has.
TEST(ShapeArea, SamplesAreUniformInTheShapesOwnSpace) {
    const Scene scene = scene_with("", definitions[0].text);
    const Geometry geometry(scene);
    std::mt19937 random(9);
    std::uniform_real_distribution<float> uniform(0, 1);
    constexpr int count = 100000;
    int inner = 0, first_third = 0;
    for (int i = 0; i < count; ++i) {
        const glm::dvec2 uv =
            geometry.uv(geometry.sample(0, 0, {uniform(random), uniform(random)}).hit);
        inner += uv.y > 0.5;  // radius below 1.25
        first_third += uv.x < 1.0 / 3;
    }
    const double share = (1.25 * 1.25 - 0.25) / (4 - 0.25);
    const auto sigma = [&](double p) { return std::sqrt(count * p * (1 - p)); };
    EXPECT_NEAR(inner, count * share, 4 * sigma(share));
    EXPECT_NEAR(first_third, count / 3.0, 4 * sigma(1.0 / 3));
}

}  // namespace
}  // namespace drude
