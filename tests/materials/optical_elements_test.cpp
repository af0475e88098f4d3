// Polariser and retarder: answers from the textbook, and from the motion of the field itself.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "materials/field.h"
#include "materials/numeric.h"
#include "materials/optical_elements.h"

namespace drude {
namespace {

Rotation<double> at(double degrees) {
    const double a = degrees * pi / 180;
    return rotation_from_dots(std::cos(a), std::sin(a));
}

void expect_stokes(const Stokes<double>& v, double s0, double s1, double s2, double s3) {
    const double expected[4] = {s0, s1, s2, s3};
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(v[i], expected[i], 1e-15) << "S" << i;
}

TEST(Polariser, HalvesUnpolarisedLightAndPolarisesItAlongItsAxis) {
    const Stokes<double> light = {{1, 0, 0, 0}};
    expect_stokes(linear_polariser(at(0)) * light, 0.5, 0.5, 0, 0);
    expect_stokes(linear_polariser(at(45)) * light, 0.5, 0, 0.5, 0);
    expect_stokes(linear_polariser(at(90)) * light, 0.5, -0.5, 0, 0);
    expect_stokes(linear_polariser(at(135)) * light, 0.5, 0, -0.5, 0);
    // Circular light passes by half whatever the axis.
    expect_stokes(linear_polariser(at(45)) * Stokes<double>{{1, 0, 0, 1}}, 0.5, 0, 0.5, 0);
}

TEST(Polariser, CrossedOnesAreDarkAndOthersFollowMalus) {
    for (double axis = -90; axis <= 180; axis += 15) {
        const Stokes<double> light = linear_polariser(at(axis)) * Stokes<double>{{2, 0, 0, 0}};
        EXPECT_NEAR((linear_polariser(at(axis + 90)) * light)[0], 0, 1e-15) << axis;
        for (double turn = 0; turn < 180; turn += 10) {
            const double cosine = std::cos(turn * pi / 180);
            EXPECT_NEAR((linear_polariser(at(axis + turn)) * light)[0], cosine * cosine, 1e-14);
        }
    }
}

TEST(Retarder, QuarterWavePlateTurnsLinearIntoCircularAndBack) {
    const Mueller<double> plate = linear_retarder(at(45), pi / 2);
    expect_stokes(plate * Stokes<double>{{1, 1, 0, 0}}, 1, 0, 0, 1);
    expect_stokes(plate * Stokes<double>{{1, -1, 0, 0}}, 1, 0, 0, -1);
    expect_stokes(plate * Stokes<double>{{1, 0, 1, 0}}, 1, 0, 1, 0);  // along an axis: untouched
    expect_stokes(linear_retarder(at(0), pi / 2) * Stokes<double>{{1, 0, 1, 0}}, 1, 0, 0, -1);
    // Two are a half-wave plate, which mirrors the plane of vibration at its axis.
    expect_stokes(plate * plate * Stokes<double>{{1, 1, 0, 0}}, 1, -1, 0, 0);
    expect_stokes(linear_retarder(at(22.5), pi) * Stokes<double>{{1, 1, 0, 0}}, 1, 0, 1, 0);
    // A quarter-wave plate at -45 degrees before a horizontal polariser: what passes is S3 > 0.
    const Mueller<double> analyser = linear_polariser(at(0)) * linear_retarder(at(-45), pi / 2);
    EXPECT_NEAR((analyser * Stokes<double>{{1, 0, 0, 1}})[0], 1, 1e-15);
    EXPECT_NEAR((analyser * Stokes<double>{{1, 0, 0, -1}})[0], 0, 1e-15);
}

// The matrices against the field: a polariser keeps the component along its axis; a retarder holds
// the slow one back. With exp(-i omega t) waiting is a factor exp(+i retardance).
TEST(Retarder, MatricesMoveStokesVectorsAsTheElementsMoveTheField) {
    const Field fields[][2] = {{1.0, 0.0}, {0.6, {0.3, 0.5}}, {{0.2, -0.7}, 0.9}, {1.0, {0, -1}}};
    for (const auto& field : fields) {
        const Stokes<double> before = seen(field[0], field[1]);
        for (double degrees = -80; degrees < 180; degrees += 35) {
            const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
            const Field along = c * field[0] + s * field[1];
            const Field across = c * field[1] - s * field[0];
            for (const double retardance : {0.4, pi / 2, 2.5, 4.0}) {
                const Field late = across * std::polar(1.0, retardance);
                const Stokes<double> expected = seen(c * along - s * late, s * along + c * late);
                const Stokes<double> got = linear_retarder(at(degrees), retardance) * before;
                for (int i = 0; i < 4; ++i) EXPECT_NEAR(got[i], expected[i], 1e-14) << i;
            }
            const Stokes<double> expected = seen(c * along, s * along);
            const Stokes<double> got = linear_polariser(at(degrees)) * before;
            for (int i = 0; i < 4; ++i) EXPECT_NEAR(got[i], expected[i], 1e-14) << i;
        }
    }
}

TEST(Retarder, ElementsAreRealisable) {
    for (double degrees = 0; degrees < 180; degrees += 20) {
        EXPECT_GT(smallest_coherency_eigenvalue(linear_polariser(at(degrees))), -1e-14);
        EXPECT_GT(smallest_coherency_eigenvalue(linear_retarder(at(degrees), 1.0)), -1e-14);
    }
    EXPECT_GT(smallest_coherency_eigenvalue(circular_polariser<double>(true)), -1e-14);
    EXPECT_GT(smallest_coherency_eigenvalue(circular_polariser<double>(false)), -1e-14);
}

// What a quarter-wave plate, a linear polariser and a second plate make of any light.
TEST(CircularPolariser, IsALinearOneBetweenQuarterWavePlates) {
    for (const bool right : {true, false}) {
        const double turn = right ? 45 : -45;
        const Mueller<double> sandwich = linear_retarder(at(turn), pi / 2) *
                                         linear_polariser(at(0)) *
                                         linear_retarder(at(-turn), pi / 2);
        const Mueller<double> got = circular_polariser<double>(right);
        for (int i = 0; i < 4; ++i) {
            for (int j = 0; j < 4; ++j) EXPECT_NEAR(got.m[i][j], sandwich.m[i][j], 1e-15);
        }
        expect_stokes(got * Stokes<double>{{1, 0, 0, right ? 1.0 : -1.0}}, 1, 0, 0, right ? 1 : -1);
        expect_stokes(got * Stokes<double>{{1, 0, 0, right ? -1.0 : 1.0}}, 0, 0, 0, 0);
    }
}

TEST(ElementAxis, CountsFromTheProjectedAxisAsSeenFromTheFront) {
    // A right-handed world, the viewer on +z: x to the right, y up, the source behind.
    const Vec3<double> k(0, 0, 1), right(1, 0, 0), up(0, 1, 0), front(0, 0, 1);
    const auto degrees_of = [](const Rotation<double>& r) {
        return std::atan2(r.sin2, r.cos2) / 2 / degree;
    };
    EXPECT_NEAR(degrees_of(element_axis(k, right, right, front, 30 * degree, 1.0)), 30, 1e-12);
    EXPECT_NEAR(degrees_of(element_axis(k, up, right, front, 30 * degree, 1.0)), -60, 1e-12);
    // Length and the part along the ray do not matter.
    EXPECT_NEAR(degrees_of(element_axis(k, right, Vec3<double>(0, 3, 9), front, 30 * degree, 1.0)),
                -60, 1e-12);
    // From behind, through the same element: k turned about the vertical, x to the right again.
    EXPECT_NEAR(degrees_of(element_axis(-k, -right, right, front, 30 * degree, 1.0)), -30, 1e-12);
    // Parallel to the ray there is no projection; the result is an axis all the same.
    const auto any = element_axis(k, right, k, front, 0.0, 1.0);
    EXPECT_NEAR(std::hypot(any.cos2, any.sin2), 1, 1e-12);
}

// Light going back through an element is changed by the reversed matrix, whatever its direction
// and the handedness of the world.
TEST(ElementAxis, ReversedLightMeetsTheSameElement) {
    numeric::Uniform u(17);
    for (int trial = 0; trial < 200; ++trial) {
        const auto random = [&] {
            return Vec3<double>(u.between(-1, 1), u.between(-1, 1), u.between(-1, 1));
        };
        const Vec3<double> k = glm::normalize(random());
        const Vec3<double> x = any_perpendicular(k), zero = random(), front = random();
        const double angle = u.between(-3, 3), h = trial % 2 ? 1 : -1;
        const auto there = element_axis(k, x, zero, front, angle, h);
        const auto back = element_axis(-k, x, zero, front, angle, h);
        for (const bool retards : {false, true}) {
            const auto matrix = [&](const Rotation<double>& axis) {
                return retards ? linear_retarder(axis, 0.8) : linear_polariser(axis);
            };
            const Mueller<double> expected = reversed(matrix(there)), got = matrix(back);
            for (int i = 0; i < 4; ++i) {
                for (int j = 0; j < 4; ++j) EXPECT_NEAR(got.m[i][j], expected.m[i][j], 1e-12);
            }
        }
    }
}

}  // namespace
}  // namespace drude
