// Interfaces and plates of clear media against Maxwell's boundary conditions, textbook values, and
// series summed term by term.
#include "materials/dielectric.h"

#include <gtest/gtest.h>

#include "materials/field.h"
#include "materials/numeric.h"
#include "materials/packet.h"

namespace drude {
namespace {

void expect_near(const Reflection<double>& got, const Reflection<double>& expected,
                 double tolerance) {
    EXPECT_NEAR(got.Rs, expected.Rs, tolerance);
    EXPECT_NEAR(got.Rp, expected.Rp, tolerance);
    EXPECT_NEAR(got.C, expected.C, tolerance);
    EXPECT_NEAR(got.S, expected.S, tolerance);
}

// Fields on both sides of z = 0 for light of unit amplitude along the incoming ray's s or p, in the
// plane of x and z. With s = y, p = k x s and H = n k x E the tangential parts of E and H must
// agree: two equations for what is reflected and what is transmitted. The wave behind may fade:
// then its k is complex.
struct Amplitude {
    Field r, t;
};
struct Interface {
    double eta, sine, cosine;
    Field q;  // normal component of the wave vector behind

    Interface(double eta_, double cosine_)
        : eta(eta_), sine(std::sqrt((1 - cosine_) * (1 + cosine_))), cosine(cosine_) {
        const double q2 = eta * eta - sine * sine;
        // exp(-i omega t) and a wave that fades along +z.
        q = q2 >= 0 ? Field(std::sqrt(q2)) : Field(0, std::sqrt(-q2));
    }

    static Amplitude solve(Field e_in, Field h_in, Field e_r, Field h_r, Field e_t, Field h_t) {
        // e_in + r e_r = t e_t, h_in + r h_r = t h_t.
        const Field determinant = -e_r * h_t + e_t * h_r;
        return {(e_in * h_t - e_t * h_in) / determinant, (-e_r * h_in + h_r * e_in) / determinant};
    }
    // E = y; H_x = -n k_z.
    Amplitude s() const { return solve(1, -cosine, 1, cosine, 1, -q); }
    // E_x of p is -k_z; H_y = -n.
    Amplitude p() const { return solve(-cosine, -1, cosine, -1, -q / eta, -eta); }
};

TEST(Dielectric, MatricesMoveStokesVectorsAsTheInterfaceMovesTheField) {
    numeric::Uniform u(1);
    const Field fields[][2] = {{1.0, 0.0}, {0.6, {0.3, 0.5}}, {{0.2, -0.7}, 0.9}, {1.0, {0, -1}}};
    int total_reflections = 0;
    for (int trial = 0; trial < 500; ++trial) {
        const double eta = u.between(0.4, 2.6), cosine = u.between(0.02, 1);
        const Interface interface(eta, cosine);
        total_reflections += interface.q.real() == 0;
        const Amplitude s = interface.s(), p = interface.p();
        const DividedLight<double> divided = divide_at_interface(eta, cosine);
        for (const auto& field : fields) {
            const Stokes<double> before = seen(field[0], field[1]);
            const Stokes<double> back = seen(s.r * field[0], p.r * field[1]);
            const Stokes<double> through = seen(s.t * field[0], p.t * field[1]);
            const double flux = interface.q.real() / cosine;
            const Stokes<double> got_back = apply(divided.reflected, before);
            const Stokes<double> got_through = apply(divided.transmitted, before);
            for (int i = 0; i < 4; ++i) {
                EXPECT_NEAR(got_back[i], back[i], 1e-11) << eta << " " << cosine << " S" << i;
                EXPECT_NEAR(got_through[i], flux * through[i], 1e-11)
                    << eta << " " << cosine << " S" << i;
            }
        }
    }
    EXPECT_GT(total_reflections, 50);
}

TEST(Dielectric, GoldenNumbersOfGlass) {
    const DividedLight<double> straight = divide_at_interface(1.5, 1.0);
    expect_near(straight.reflected, {0.04, 0.04, -0.04, 0}, 1e-15);
    expect_near(straight.transmitted, {0.96, 0.96, 0.96, 0}, 1e-15);
    expect_near(divide_at_interface(1 / 1.5, 1.0).reflected, {0.04, 0.04, -0.04, 0}, 1e-15);
    // Brewster's angle, tan t = n: nothing of p comes back, (1 - n^2)^2 / (1 + n^2)^2 of s.
    const DividedLight<double> brewster = divide_at_interface(1.5, std::cos(std::atan(1.5)));
    expect_near(brewster.reflected, {25.0 / 169, 0, 0, 0}, 1e-15);
    expect_near(brewster.transmitted, {144.0 / 169, 1, 12.0 / 13, 0}, 1e-15);
    // 60 degrees, by the amplitudes as the books print them.
    const DividedLight<double> oblique = divide_at_interface(1.5168, 0.5);
    const double q = std::sqrt(1.5168 * 1.5168 - 0.75), rs = (0.5 - q) / (0.5 + q),
                 rp = (1.5168 * 1.5168 * 0.5 - q) / (1.5168 * 1.5168 * 0.5 + q);
    expect_near(oblique.reflected, {rs * rs, rp * rp, rs * rp, 0}, 1e-15);
    // Grazing, from either side: everything comes back.
    for (const double eta : {1.5, 1 / 1.5}) {
        const DividedLight<double> grazing = divide_at_interface(eta, 0.0);
        expect_near(grazing.reflected, {1, 1, 1, 0}, 1e-15);
        expect_near(grazing.transmitted, {0, 0, 0, 0}, 1e-15);
    }
    const DividedLight<double> nothing = divide_at_interface(1.0, 0.3);
    expect_near(nothing.reflected, {0, 0, 0, 0}, 1e-30);
    expect_near(nothing.transmitted, {1, 1, 1, 0}, 1e-15);
}

// Fresnel's rhomb: two total reflections at 54 degrees 37 minutes in glass of n = 1.51 turn light
// at 45 degrees to the plane of incidence into circular light (Born & Wolf, section 1.5.4).
TEST(Dielectric, FresnelRhombMakesCircularLight) {
    for (const double minutes : {54 * 60 + 37.0, 48 * 60 + 37.0}) {
        const double theta = minutes / 60 * degree;
        const Reflection<double> r = divide_at_interface(1 / 1.51, std::cos(theta)).reflected;
        EXPECT_NEAR(delta(r), 45 * degree, 3e-4);
        const double sine = std::sin(theta), n2 = 1 / (1.51 * 1.51);
        EXPECT_NEAR(std::tan(delta(r) / 2),
                    std::cos(theta) * std::sqrt(sine * sine - n2) / (sine * sine), 1e-14);
        const Stokes<double> out = apply(r, apply(r, Stokes<double>{{1, 0, 1, 0}}));
        EXPECT_NEAR(out[0], 1, 1e-12);
        EXPECT_NEAR(out[2], 0, 1e-3);
        EXPECT_NEAR(out[3], 1, 1e-6);
    }
}

TEST(Dielectric, WhatIsNotReflectedIsTransmitted) {
    numeric::Uniform u(2);
    for (int trial = 0; trial < 5000; ++trial) {
        const double eta = trial % 2 ? u.between(1, 3) : 1 / u.between(1, 3);
        const double cosine = trial % 3 ? u.next() : std::pow(10, u.between(-9, 0));
        for (const auto& d : {divide_at_interface(eta, cosine), divide_at_plate(eta, cosine)}) {
            EXPECT_NEAR(d.reflected.Rs + d.transmitted.Rs, 1, 1e-12) << eta << " " << cosine;
            EXPECT_NEAR(d.reflected.Rp + d.transmitted.Rp, 1, 1e-12) << eta << " " << cosine;
            for (const auto& r : {d.reflected, d.transmitted}) {
                EXPECT_GE(smallest_coherency_eigenvalue(mueller(r)), -1e-12);
            }
        }
        const auto f = divide_at_interface(static_cast<float>(eta), static_cast<float>(cosine));
        EXPECT_NEAR(f.reflected.Rs + f.transmitted.Rs, 1, 1e-6);
        EXPECT_NEAR(f.reflected.Rp + f.transmitted.Rp, 1, 1e-6);
    }
}

TEST(Dielectric, LightTakesTheSameShareBothWays) {
    numeric::Uniform u(3);
    for (int trial = 0; trial < 1000; ++trial) {
        const double eta = u.between(1, 3), cosine = u.between(0.001, 1);
        const double behind = std::sqrt(1 - (1 - cosine * cosine) / (eta * eta));
        const auto there = divide_at_interface(eta, cosine);
        const auto back = divide_at_interface(1 / eta, behind);
        expect_near(there.transmitted, back.transmitted, 1e-11);
        EXPECT_NEAR(there.reflected.Rs, back.reflected.Rs, 1e-11);
        // O M^T O in the same x axes is what reversed light finds; radiance L / n^2.
        for (const auto& r : {there.transmitted, there.reflected, back.reflected}) {
            const Mueller<double> m = mueller(r), reverse = reversed(m);
            for (int i = 0; i < 4; ++i) {
                for (int j = 0; j < 4; ++j) EXPECT_EQ(m.m[i][j], reverse.m[i][j]);
            }
        }
    }
}

TEST(Dielectric, PlateIsTheSumOfItsInnerReflections) {
    numeric::Uniform u(4);
    for (int trial = 0; trial < 200; ++trial) {
        const double eta = u.between(1.05, 2.5), cosine = u.between(0.05, 1);
        const double inside = std::sqrt(1 - (1 - cosine * cosine) / (eta * eta));
        const auto outer = divide_at_interface(eta, cosine);
        const auto inner = divide_at_interface(1 / eta, inside);
        const Mueller<double> enter = mueller(outer.transmitted),
                              leave = mueller(inner.transmitted), bounce = mueller(inner.reflected);
        Mueller<double> back = mueller(outer.reflected), through{}, in_plate = enter;
        for (int j = 0; j < 400; ++j) {
            Mueller<double>& sum = j % 2 ? back : through;
            const Mueller<double> out = leave * in_plate;
            for (int a = 0; a < 4; ++a) {
                for (int b = 0; b < 4; ++b) sum.m[a][b] += out.m[a][b];
            }
            in_plate = bounce * in_plate;
        }
        const auto plate = divide_at_plate(eta, cosine);
        const Mueller<double> got_back = mueller(plate.reflected),
                              got_through = mueller(plate.transmitted);
        for (int a = 0; a < 4; ++a) {
            for (int b = 0; b < 4; ++b) {
                EXPECT_NEAR(got_back.m[a][b], back.m[a][b], 1e-12);
                EXPECT_NEAR(got_through.m[a][b], through.m[a][b], 1e-12);
            }
        }
    }
    // A plate of air in glass beyond the critical angle only reflects, with its phase.
    expect_near(divide_at_plate(1 / 1.5, 0.5).reflected,
                divide_at_interface(1 / 1.5, 0.5).reflected, 1e-14);
}

template <class T>
void expect_close(const T& got, double expected, double tolerance, double eta, double cosine) {
    EXPECT_NEAR(static_cast<double>(got), expected, tolerance) << eta << " " << cosine;
}

TEST(Dielectric, FloatAndPacketsAgreeWithDouble) {
    numeric::Uniform u(5);
    for (int trial = 0; trial < 2000; ++trial) {
        Packet<8> etas;
        const auto cosine = static_cast<float>(u.next());
        for (int lane = 0; lane < 8; ++lane) {
            etas.set(lane,
                     static_cast<float>(lane % 2 ? u.between(1.02, 3) : 1 / u.between(1.02, 3)));
        }
        const auto packet = divide_at_interface(etas, Packet<8>(cosine));
        const auto plates = divide_at_plate(etas, Packet<8>(cosine));
        for (int lane = 0; lane < 8; ++lane) {
            const double eta = etas[lane], c = cosine;
            const double q2 = eta * eta - 1 + c * c;
            // The square root magnifies rounding without bound at the critical angle.
            const double tolerance = std::abs(q2) < 1e-3 ? 2e-2 : 2e-6 / std::sqrt(std::abs(q2));
            const auto exact = divide_at_interface(eta, c), plate = divide_at_plate(eta, c);
            const auto compare = [&](const Reflection<Packet<8>>& got,
                                     const Reflection<double>& expected) {
                expect_close(got.Rs[lane], expected.Rs, tolerance, eta, c);
                expect_close(got.Rp[lane], expected.Rp, tolerance, eta, c);
                expect_close(got.C[lane], expected.C, tolerance, eta, c);
                expect_close(got.S[lane], expected.S, tolerance, eta, c);
            };
            compare(packet.reflected, exact.reflected);
            compare(packet.transmitted, exact.transmitted);
            compare(plates.reflected, plate.reflected);
            compare(plates.transmitted, plate.transmitted);
        }
    }
}

}  // namespace
}  // namespace drude
