// The polarised Torrance-Sparrow conductor and the Mueller algebra it stands on: reciprocity,
// physical realisability, frames.
#include "materials/torrance_sparrow.h"

#include <gtest/gtest.h>

#include "materials/numeric.h"

namespace drude {
namespace {

using M = Mueller<double>;
using V = Vec3<double>;

V random_above(numeric::Uniform& u, double lowest = 0.02) {
    const double z = u.between(lowest, 1), phi = u.between(0, 2 * pi), r = std::sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
}

V random_across(numeric::Uniform& u, const V& k) {
    const double phi = u.between(0, 2 * pi);
    const V a = any_perpendicular(k), b = glm::cross(k, a);
    return std::cos(phi) * a + std::sin(phi) * b;
}

void expect_near(const M& a, const M& b, double tolerance, const std::string& text = "") {
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            EXPECT_NEAR(a.m[i][j], b.m[i][j], tolerance) << text << " element " << i << j;
        }
    }
}

M scaled(M a, double factor) {
    for (auto& row : a.m) {
        for (double& element : row) element *= factor;
    }
    return a;
}

// A random surface with up to two films; the films live as long as it does.
struct RandomSurface {
    ThinFilm<double> films[2];
    Surface<double> surface;

    explicit RandomSurface(numeric::Uniform& u) {
        for (ThinFilm<double>& film : films) {
            film = {{u.between(1.1, 3), u.next() < 0.5 ? 0 : u.between(0, 2)}, u.between(0, 500)};
        }
        surface.substrate = {u.between(0.02, 10), u.between(0, 15)};
        surface.films = films;
        surface.film_count = static_cast<int>(3 * u.next());
        surface.wavelength = u.between(380, 780);
    }
    RandomSurface(const RandomSurface&) = delete;
    RandomSurface& operator=(const RandomSurface&) = delete;
};

std::vector<Microfacets<double>> some_microfacets() {
    std::vector<Microfacets<double>> all;
    for (const double beta : {0.3, 1.0}) {
        for (const Lobe lobe :
             {Lobe::blinn_phong, Lobe::gaussian, Lobe::beckmann, Lobe::trowbridge_reitz}) {
            all.emplace_back(lobe, Masking::v_groove, beta);
        }
        all.emplace_back(Lobe::beckmann, Masking::smith, beta);
        all.emplace_back(Lobe::trowbridge_reitz, Masking::smith, beta);
    }
    return all;
}

void expect_realisable(const M& m, double tolerance) {
    EXPECT_GE(m.m[0][0], 0);
    for (const auto& row : m.m) {
        for (const double element : row) {
            EXPECT_LE(std::abs(element), m.m[0][0] * (1 + tolerance));
        }
    }
    EXPECT_GE(smallest_coherency_eigenvalue(m), -tolerance);
}

// The check itself, on devices known to be possible or not.
TEST(Realisable, KnowsWhatIsAndWhatIsNot) {
    EXPECT_NEAR(smallest_coherency_eigenvalue(M::identity()), 0, 1e-14);
    EXPECT_GT(smallest_coherency_eigenvalue(M::diagonal(1, 0, 0, 0)), 0.1);
    // Turns every state into its opposite, as a mirror of the Poincare sphere: impossible.
    EXPECT_LT(smallest_coherency_eigenvalue(M::diagonal(1, -1, -1, -1)), -0.1);
    EXPECT_LT(smallest_coherency_eigenvalue(M::diagonal(1, 1, 1, -1)), -0.1);
    EXPECT_NEAR(smallest_coherency_eigenvalue(M::diagonal(1, 1, -1, -1)), 0, 1e-14);
    // A Mueller matrix of one Jones matrix has rank 1: pushed anywhere it leaves the set.
    M m = mueller(reflect(ComplexIndex<double>{1.04, 2.59}, 0.5));
    EXPECT_NEAR(smallest_coherency_eigenvalue(m), 0, 1e-14);
    m.m[2][2] *= 1.01;
    EXPECT_LT(smallest_coherency_eigenvalue(m), -1e-4);
    m = mueller(reflect(ComplexIndex<double>{1.04, 2.59}, 0.5));
    m.m[3][2] *= -1;
    EXPECT_LT(smallest_coherency_eigenvalue(m), -1e-2);
}

TEST(TorranceSparrow, EveryProductIsRealisable) {
    numeric::Uniform u(20);
    const auto all = some_microfacets();
    for (int n = 0; n < 1500; ++n) {
        M product = M::identity();
        for (int bounce = 0; bounce < 4; ++bounce) {
            const RandomSurface random(u);
            const auto& microfacets = all[u.below(all.size())];
            const V i = random_above(u), o = random_above(u);
            const M m = evaluate_conductor(microfacets, random.surface, i, random_across(u, i), o,
                                           random_across(u, o), u.next() < 0.5 ? 1.0 : -1.0);
            expect_realisable(m, 1e-12);
            product = m * product;
            if (product.m[0][0] > 0) product = scaled(product, 1 / product.m[0][0]);
            expect_realisable(product, 1e-12);
        }
    }
}

// The float path, with what its rounding may do.
TEST(TorranceSparrow, RealisableInFloat) {
    numeric::Uniform u(21);
    const Microfacets<float> microfacets(Lobe::beckmann, Masking::smith, 0.3);
    for (int n = 0; n < 5000; ++n) {
        Surface<float> surface;
        surface.substrate = {static_cast<float>(u.between(0.02, 10)),
                             static_cast<float>(n % 4 ? u.between(0, 15) : 0)};
        const Vec3<float> i(random_above(u)), o(random_above(u));
        const Vec3<float> x_i(random_across(u, V(i))), x_o(random_across(u, V(o)));
        const auto m = evaluate_conductor(microfacets, surface, i, x_i, o, x_o, 1.0f);
        if (!(m.m[0][0] > 1e-30f)) continue;  // far down the tail floats lose their digits
        M wide;
        for (int r = 0; r < 4; ++r) {
            for (int c = 0; c < 4; ++c) wide.m[r][c] = static_cast<double>(m.m[r][c]);
        }
        expect_realisable(wide, 2e-6);
    }
}

// BRDF(o <- i) and BRDF(i <- o) with the same x axes: O M^T O.
TEST(TorranceSparrow, Reciprocity) {
    numeric::Uniform u(22);
    const auto all = some_microfacets();
    double largest = 0;
    for (int n = 0; n < 4000; ++n) {
        const RandomSurface random(u);
        const auto& microfacets = all[u.below(all.size())];
        const V i = random_above(u), o = random_above(u);
        const V x_i = random_across(u, i), x_o = random_across(u, o);
        const double h = n % 2 ? 1 : -1;
        const M there =
            scaled(evaluate_conductor(microfacets, random.surface, i, x_i, o, x_o, h), 1 / i.z);
        const M back =
            scaled(evaluate_conductor(microfacets, random.surface, o, x_o, i, x_i, h), 1 / o.z);
        M expected;
        const double O[4] = {1, 1, -1, 1};
        for (int a = 0; a < 4; ++a) {
            for (int b = 0; b < 4; ++b) expected.m[a][b] = O[a] * back.m[b][a] * O[b];
        }
        expect_near(there, expected, 1e-12 * (1 + there.m[0][0]));
        expect_near(there, reversed(back), 1e-12 * (1 + there.m[0][0]));
        // Mere transposition is another matrix: the test sees the sign.
        largest =
            std::max(largest, std::abs(there.m[2][1] - back.m[1][2]) / (there.m[0][0] + 1e-9));
    }
    EXPECT_GT(largest, 0.1);
}

// The mean over the reflected hemisphere of M_00, sampled, is below 1 and that of a metal of Rs =
// Rp = 1 is the lobe's albedo.
TEST(TorranceSparrow, ScalesWithTheFresnelReflectance) {
    const Microfacets<double> microfacets(Lobe::trowbridge_reitz, Masking::smith, 0.3);
    Surface<double> mirror;
    mirror.substrate = {1e-9, 10};
    numeric::Uniform u(23);
    for (int n = 0; n < 200; ++n) {
        const V i = random_above(u), o = random_above(u);
        const auto e = microfacets.evaluate(o, i);
        const M m = evaluate_conductor(microfacets, mirror, i, random_across(u, i), o,
                                       random_across(u, o), 1.0);
        EXPECT_NEAR(m.m[0][0], e.value, 1e-8 * e.value);
        EXPECT_NEAR(e.value, microfacets.D(e.m) * microfacets.G2(o, i, e.m) / (4 * o.z), 1e-12);
    }
}

TEST(TorranceSparrow, NothingFromBelow) {
    const Microfacets<double> microfacets(Lobe::beckmann, Masking::smith, 0.3);
    Surface<double> surface;
    surface.substrate = {1.04, 2.59};
    const V up(0.6, 0, 0.8), down(0.6, 0, -0.8), x(0, 1, 0);
    EXPECT_EQ(evaluate_conductor(microfacets, surface, up, x, down, x, 1.0).m[0][0], 0);
    EXPECT_EQ(evaluate_conductor(microfacets, surface, down, x, up, x, 1.0).m[0][0], 0);
    EXPECT_EQ(evaluate_conductor(microfacets, surface, V(1, 0, 0), x, up, x, 1.0).m[0][0], 0);
}

// ---- frames
// --------------------------------------------------------------------------------------

// The rotator of the textbooks (Hecht, section 8.13; Collett 1993, eq. 4-39), theta from x to x'.
M rotator(double theta) {
    const double c = std::cos(2 * theta), s = std::sin(2 * theta);
    return {{{1, 0, 0, 0}, {0, c, s, 0}, {0, -s, c, 0}, {0, 0, 0, 1}}};
}

TEST(Frames, RotatingTheAxesMultipliesByRotators) {
    numeric::Uniform u(24);
    const auto all = some_microfacets();
    for (int n = 0; n < 500; ++n) {
        const RandomSurface random(u);
        const auto& microfacets = all[static_cast<size_t>(n) % all.size()];
        const V i = random_above(u), o = random_above(u);
        const V x_i = random_across(u, i), x_o = random_across(u, o);
        const double h = n % 2 ? 1 : -1;
        const M before = evaluate_conductor(microfacets, random.surface, i, x_i, o, x_o, h);
        for (const double degrees : {0.0, 30.0, 45.0, 90.0, 180.0, -20.0}) {
            const double a = degrees * pi / 180, b = u.between(0, 2 * pi);
            const V y_i = h * glm::cross(-i, x_i), y_o = h * glm::cross(o, x_o);
            const V turned_i = std::cos(a) * x_i + std::sin(a) * y_i;
            const V turned_o = std::cos(b) * x_o + std::sin(b) * y_o;
            // Components in the turned frame are turned back before the old matrix applies.
            const M expected = rotator(b) * before * rotator(-a);
            const M turned =
                evaluate_conductor(microfacets, random.surface, i, turned_i, o, turned_o, h);
            expect_near(turned, expected, 1e-12 * (1 + before.m[0][0]));
        }
    }
}

TEST(Frames, RotationsAsStokesVectorsSeeThem) {
    const double c = std::cos(0.4), s = std::sin(0.4);
    const auto r = rotation_from_dots(3 * c, 3 * s);  // normalised inside
    EXPECT_NEAR(r.cos2, std::cos(0.8), 1e-15);
    EXPECT_NEAR(r.sin2, std::sin(0.8), 1e-15);
    expect_near(mueller(r), rotator(0.4), 1e-15);
    expect_near(mueller(inverse(r)), rotator(-0.4), 1e-15);
    // Light along x' = 0.4 rad from x has S1 = 1 in the frame of x'.
    const Stokes<double> light{{1, std::cos(0.8), std::sin(0.8), 0}}, turned = rotate(r, light);
    EXPECT_NEAR(turned[1], 1, 1e-15);
    EXPECT_NEAR(turned[2], 0, 1e-15);
    const auto nothing = rotation_from_dots(0.0, 0.0);
    EXPECT_EQ(nothing.cos2, 1);
    EXPECT_EQ(nothing.sin2, 0);
}

TEST(Frames, SpecialisedProductsAreTheDenseOnes) {
    numeric::Uniform u(25);
    for (int n = 0; n < 200; ++n) {
        const RandomSurface random(u);
        const auto reflection = random.surface(u.next());
        const double angle = u.between(0, 7);
        const Rotation<double> rotation{std::cos(angle), std::sin(angle)};
        const Stokes<double> v{{1, u.between(-1, 1), u.between(-1, 1), u.between(-1, 1)}};
        const auto a = apply(reflection, v), b = mueller(reflection) * v;
        const auto c = rotate(rotation, v), d = mueller(rotation) * v;
        for (int i = 0; i < 4; ++i) {
            EXPECT_NEAR(a[i], b[i], 1e-15);
            EXPECT_NEAR(c[i], d[i], 1e-15);
        }
        expect_near(reversed(mueller(reflection)), mueller(reflection), 0);
        expect_near(reversed(reversed(mueller(rotation) * mueller(reflection))),
                    mueller(rotation) * mueller(reflection), 0);
    }
}

TEST(Frames, AnyPerpendicularIs) {
    numeric::Uniform u(26);
    for (int n = 0; n < 2000; ++n) {
        V k = random_above(u, 0);
        if (n % 2) k = -k;
        if (n % 5 == 0) k = {0, 0, n % 2 ? 1 : -1};
        if (n % 7 == 0) k = {1, 0, n % 2 ? 0.0 : -0.0};
        const V a = any_perpendicular(k);
        EXPECT_NEAR(glm::dot(a, k), 0, 1e-15);
        EXPECT_NEAR(glm::dot(a, a), 1, 1e-14);
    }
}

// Straight back: R diag(1, 1, -1, -1) in any common x axis, whatever azimuth the s axis took.
TEST(Frames, StraightBackIsAMirrorOfTheSphere) {
    numeric::Uniform u(27);
    Surface<double> surface;
    surface.substrate = {1.04, 2.59};
    const double R = (0.04 * 0.04 + 2.59 * 2.59) / (2.04 * 2.04 + 2.59 * 2.59);
    for (int n = 0; n < 200; ++n) {
        const V m = random_above(u), x = random_across(u, m);
        expect_near(mirror_mueller(surface, m, m, x, m, x, n % 2 ? 1.0 : -1.0),
                    M::diagonal(R, R, -R, -R), 1e-12);
    }
}

// As i approaches o the matrix approaches that, through the threshold of s_axis() too.
template <class T>
void approaches_straight_back(T tolerance) {
    numeric::Uniform u(28);
    Surface<T> surface;
    surface.substrate = {T(1.04), T(2.59)};
    const T R = reflect(surface.substrate, T(1)).Rs;
    for (int n = 0; n < 200; ++n) {
        const V m = random_above(u, 0.3), x = random_across(u, m), across = random_across(u, m);
        for (double offset = 1e-3; offset > 1e-9; offset /= 1.7) {
            const Vec3<T> i(glm::normalize(m + offset * across));
            const Vec3<T> o(glm::normalize(m - offset * across));
            const auto matrix = mirror_mueller(surface, Vec3<T>(m), i, Vec3<T>(x), o, Vec3<T>(x),
                                               n % 2 ? T(1) : T(-1));
            const T expected[4] = {R, R, -R, -R};
            for (int a = 0; a < 4; ++a) {
                for (int b = 0; b < 4; ++b) {
                    EXPECT_NEAR(matrix.m[a][b], a == b ? expected[a] : T(0),
                                tolerance + 3 * offset * offset)
                        << offset;
                }
            }
        }
    }
}
TEST(Frames, ContinuousTowardsStraightBackInDouble) {
    approaches_straight_back<double>(1e-11);
}
TEST(Frames, ContinuousTowardsStraightBackInFloat) {
    approaches_straight_back<float>(3e-6f);
}

// What the mirror does at the facet is what the lobe does at the half vector.
TEST(Frames, MirrorAndLobeAgree) {
    numeric::Uniform u(29);
    const Microfacets<double> microfacets(Lobe::beckmann, Masking::smith, 0.4);
    for (int n = 0; n < 200; ++n) {
        const RandomSurface random(u);
        const V i = random_above(u), o = random_above(u);
        const V x_i = random_across(u, i), x_o = random_across(u, o);
        const auto e = microfacets.evaluate(o, i);
        expect_near(evaluate_conductor(microfacets, random.surface, i, x_i, o, x_o, -1.0),
                    scaled(mirror_mueller(random.surface, e.m, i, x_i, o, x_o, -1.0), e.value),
                    1e-12 * (1 + e.value));
    }
}

}  // namespace
}  // namespace drude
