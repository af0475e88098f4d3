// Polariser and retarder: answers from the textbook, and from the motion of the field itself.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "materials/optical_elements.h"

namespace drude {
namespace {

constexpr double pi = std::numbers::pi;

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

using Field = std::complex<double>;

// Stokes parameters from the real field E(t) = Re(E exp(-i omega t)) over one period, x to the
// right and y up, seen looking towards the source. Its tip sweeps area counter-clockwise at the
// rate (x dy/dt - y dx/dt)/2; S3 counts the opposite turn.
Stokes<double> seen(Field x, Field y) {
    constexpr int steps = 64;
    Stokes<double> sum = {{0, 0, 0, 0}};
    for (int i = 0; i < steps; ++i) {
        const Field turn = std::polar(1.0, -2 * pi * i / steps);
        const Field later = turn * Field(0, -1);  // d/d(omega t) of exp(-i omega t)
        const double ex = (x * turn).real(), ey = (y * turn).real();
        const double dx = (x * later).real(), dy = (y * later).real();
        sum[0] += (ex * ex + ey * ey) * 2 / steps;
        sum[1] += (ex * ex - ey * ey) * 2 / steps;
        sum[2] += 4 * ex * ey / steps;
        sum[3] -= (ex * dy - ey * dx) * 2 / steps;
    }
    return sum;
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
}

}  // namespace
}  // namespace drude
