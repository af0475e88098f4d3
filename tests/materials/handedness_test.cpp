// Every sign derived a second time, from Maxwell's equations and from what an observer would see.
//
// The oracle knows no Fresnel formula, no s or p and no Mueller matrix: it solves for the reflected
// field by the continuity of E and H at the boundary (time factor exp(-i omega t)), and takes
// Stokes parameters from the motion of the real field vector in time, as seen looking towards the
// source. It lives in right-handed coordinates, as Maxwell's cross products do. A left-handed world
// is the same physics with one coordinate mirrored.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <glm/vec2.hpp>

#include "materials/numeric.h"
#include "materials/torrance_sparrow.h"

namespace drude {
namespace {

using V = Vec3<double>;
using C = std::complex<double>;
using Field = Eigen::Vector3cd;

Eigen::Vector3d eigen(const V& v) {
    return {v.x, v.y, v.z};
}

// Cross and dot product without conjugation.
Field cross(const Field& a, const Field& b) {
    return {a(1) * b(2) - a(2) * b(1), a(2) * b(0) - a(0) * b(2), a(0) * b(1) - a(1) * b(0)};
}
C dot(const Field& a, const Field& b) {
    return a(0) * b(0) + a(1) * b(1) + a(2) * b(2);
}

// Light of field `e_in` that travels along k_in onto a smooth surface of normal m and index N. The
// six unknowns are the reflected field and the field inside. Each is transverse to its wave vector,
// and E and H = k x E (over omega mu) are continuous along the surface: six equations. Inside, the
// field decays away from the surface for exp(-i omega t).
Field reflected_field(const V& k_in, const V& m, C N, const Field& e_in) {
    const V k_out = k_in - 2 * glm::dot(k_in, m) * m;
    const V tangential = k_in - glm::dot(k_in, m) * m;
    C q = std::sqrt(N * N - glm::dot(tangential, tangential));
    if (q.imag() < 0) q = -q;
    const Field in = eigen(k_in).cast<C>(), out = eigen(k_out).cast<C>();
    const Field inside = eigen(tangential).cast<C>() - q * eigen(m).cast<C>();
    V t1 = std::abs(m.x) < 0.5 ? V(1, 0, 0) : V(0, 1, 0);
    t1 = glm::normalize(t1 - glm::dot(t1, m) * m);
    const V t2 = glm::cross(m, t1);
    Eigen::MatrixXcd system = Eigen::MatrixXcd::Zero(6, 6);
    Eigen::VectorXcd right = Eigen::VectorXcd::Zero(6);
    for (int column = 0; column < 3; ++column) {
        const Field unit = Field::Unit(column);
        int row = 0;
        for (const V& t : {t1, t2}) {
            const Field along = eigen(t).cast<C>();
            system(row, column) = dot(along, unit);
            system(row, 3 + column) = -dot(along, unit);
            ++row;
            system(row, column) = dot(along, cross(out, unit));
            system(row, 3 + column) = -dot(along, cross(inside, unit));
            ++row;
        }
        system(4, column) = dot(out, unit);
        system(5, 3 + column) = dot(inside, unit);
    }
    int row = 0;
    for (const V& t : {t1, t2}) {
        const Field along = eigen(t).cast<C>();
        right(row++) = -dot(along, e_in);
        right(row++) = -dot(along, cross(in, e_in));
    }
    const Eigen::VectorXcd solution = system.fullPivLu().solve(right);
    return solution.head<3>();
}

// Stokes parameters of light travelling along k, seen by an observer who looks towards the source
// with `right` to the right: time averages over one turn of the real field. Intensities behind
// analysers at 0, 90, 45 (from right towards up) and 135 degrees; clockwise motion counts positive.
Stokes<double> observed_stokes(const Field& e, const V& k, const V& right) {
    const V gaze = -k;
    const V up = glm::cross(right, gaze);  // right, up, gaze away from the observer's face
    Stokes<double> s{{0, 0, 0, 0}};
    constexpr int moments = 16;
    for (int n = 0; n < moments; ++n) {
        const auto at = [&](double phase) {
            const Eigen::Vector3d real = (e * std::exp(C(0, -phase))).real();
            return glm::vec<2, double>(real.dot(eigen(right)), real.dot(eigen(up)));
        };
        const double phase = 2 * pi * n / moments;
        const glm::vec<2, double> now = at(phase), quarter_later = at(phase + pi / 2);
        const double plus = (now.x + now.y) / std::sqrt(2.0),
                     minus = (now.y - now.x) / std::sqrt(2.0);
        // d/dt of a harmonic field is the field a quarter period later, times omega.
        const double counter_clockwise = now.x * quarter_later.y - now.y * quarter_later.x;
        s[0] += (now.x * now.x + now.y * now.y) * 2 / moments;
        s[1] += (now.x * now.x - now.y * now.y) * 2 / moments;
        s[2] += (plus * plus - minus * minus) * 2 / moments;
        s[3] += -counter_clockwise * 2 / moments;
    }
    return s;
}

V perpendicular(const V& k, double azimuth) {
    const V any = std::abs(k.x) < 0.5 ? V(1, 0, 0) : V(0, 1, 0);
    const V a = glm::normalize(any - glm::dot(any, k) * k);
    return std::cos(azimuth) * a + std::sin(azimuth) * glm::cross(k, a);
}

V random_above(numeric::Uniform& u) {
    const double z = u.between(0.02, 1), phi = u.between(0, 2 * pi), r = std::sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
}

// The observer himself: known states of light.
TEST(Observer, SeesKnownStates) {
    const V k(0, 0, 1), right(1, 0, 0);
    const auto expect = [&](const Field& e, double s1, double s2, double s3) {
        const auto s = observed_stokes(e, k, right);
        EXPECT_NEAR(s[0], 1, 1e-14);
        EXPECT_NEAR(s[1], s1, 1e-14);
        EXPECT_NEAR(s[2], s2, 1e-14);
        EXPECT_NEAR(s[3], s3, 1e-14);
    };
    const double d = std::sqrt(0.5);
    expect({1, 0, 0}, 1, 0, 0);
    expect({0, 1, 0}, -1, 0, 0);
    // Light comes out of the page, x to the right, y up: k = z is towards the observer.
    expect({d, d, 0}, 0, 1, 0);
    // x = cos(wt), y = cos(wt + 90 deg) = -sin(wt): clockwise. exp(-iwt): y = -i x.
    expect({d, C(0, -d), 0}, 0, 0, 1);
    expect({d, C(0, d), 0}, 0, 0, -1);
}

// The oracle's amplitudes at normal incidence are the textbook's.
TEST(Oracle, NormalIncidence) {
    const C N(1.04, 2.59), r = (1.0 - N) / (1.0 + N);
    const Field e = reflected_field({0, 0, -1}, {0, 0, 1}, N, Field(1, C(0, 2), 0));
    EXPECT_NEAR(std::abs(e(0) - r), 0, 1e-14);
    EXPECT_NEAR(std::abs(e(1) - r * C(0, 2)), 0, 1e-14);
    EXPECT_NEAR(std::abs(e(2)), 0, 1e-14);
}

// One random reflection, in the oracle's right-handed coordinates.
struct Reflecting {
    V i, o, m, x_i, x_o;
    C N;

    explicit Reflecting(numeric::Uniform& u) {
        i = random_above(u);
        o = random_above(u);
        m = glm::normalize(i + o);
        x_i = perpendicular(-i, u.between(0, 2 * pi));
        x_o = perpendicular(o, u.between(0, 2 * pi));
        N = C(u.between(0.02, 10), u.between(0, 15));
    }
};

// The state of light with the complex components a along x and b along y = k x x.
Field field(const V& k, const V& x, C a, C b) {
    return a * eigen(x).cast<C>() + b * eigen(glm::cross(k, x)).cast<C>();
}

const std::vector<std::pair<C, C>> states = {
    {1, 0}, {0, 1}, {1, 1}, {1, -1}, {1, C(0, 1)}, {1, C(0, -1)}, {C(0.3, 0.8), C(-0.5, 0.1)}};

// The Mueller matrix against the oracle, with the world's coordinates as they are (handedness +1)
// or mirrored along one axis (-1): the numbers that an observer reads stay the same.
void mueller_is_what_an_observer_sees(const V& mirror, double handedness) {
    numeric::Uniform u(30);
    const Microfacets<double> microfacets(Lobe::beckmann, Masking::smith, 0.5);
    for (int n = 0; n < 300; ++n) {
        const Reflecting r(u);
        Surface<double> surface;
        surface.substrate = {r.N.real(), r.N.imag()};
        const Mueller<double> facet =
            mirror_mueller(surface, mirror * r.m, mirror * r.i, mirror * r.x_i, mirror * r.o,
                           mirror * r.x_o, handedness);
        for (const auto& [a, b] : states) {
            const Field in = field(-r.i, r.x_i, a, b);
            const auto seen_in = observed_stokes(in, -r.i, r.x_i);
            const auto seen_out = observed_stokes(reflected_field(-r.i, r.m, r.N, in), r.o, r.x_o);
            const auto expected = facet * seen_in;
            for (int j = 0; j < 4; ++j) {
                EXPECT_NEAR(seen_out[j], expected[j], 1e-11) << "S" << j << " of case " << n;
            }
        }
        // A rough surface lies along the mirrored z axis only if z is not what was mirrored.
        if (mirror.z < 0) continue;
        const Mueller<double> rough =
            evaluate_conductor(microfacets, surface, mirror * r.i, mirror * r.x_i, mirror * r.o,
                               mirror * r.x_o, handedness);
        const double value = microfacets.evaluate(r.o, r.i).value;
        for (int row = 0; row < 4; ++row) {
            for (int column = 0; column < 4; ++column) {
                EXPECT_NEAR(rough.m[row][column], value * facet.m[row][column],
                            1e-12 * (1 + value));
            }
        }
    }
}

TEST(Handedness, RightHandedWorld) {
    mueller_is_what_an_observer_sees({1, 1, 1}, 1);
}
TEST(Handedness, LeftHandedWorldMirroredInX) {
    mueller_is_what_an_observer_sees({-1, 1, 1}, -1);
}
TEST(Handedness, LeftHandedWorldMirroredInY) {
    mueller_is_what_an_observer_sees({1, -1, 1}, -1);
}
TEST(Handedness, LeftHandedWorldMirroredInZ) {
    mueller_is_what_an_observer_sees({1, 1, -1}, -1);
}
TEST(Handedness, TwoMirrorsMakeARightHandedWorld) {
    mueller_is_what_an_observer_sees({-1, -1, 1}, 1);
}

// With the wrong handedness it must not agree, or the tests above would see nothing.
TEST(Handedness, TheWrongOneIsNoticed) {
    numeric::Uniform u(31);
    double difference = 0;
    for (int n = 0; n < 20; ++n) {
        const Reflecting r(u);
        Surface<double> surface;
        surface.substrate = {r.N.real(), r.N.imag()};
        const auto right = mirror_mueller(surface, r.m, r.i, r.x_i, r.o, r.x_o, 1.0);
        const auto wrong = mirror_mueller(surface, r.m, r.i, r.x_i, r.o, r.x_o, -1.0);
        for (int j = 0; j < 4; ++j) {
            difference = std::max(difference, std::abs(right.m[2][j] - wrong.m[2][j]));
        }
    }
    EXPECT_GT(difference, 0.1);
}

// Rs, Rp, C and S themselves, in the s-p frame: light along s and along p = k x s.
TEST(Handedness, FourNumbersOfAReflection) {
    numeric::Uniform u(32);
    for (int n = 0; n < 300; ++n) {
        const double theta = u.between(0.01, 1.55);
        const V m(0, 0, 1), k(std::sin(theta), 0, -std::cos(theta)), s(0, 1, 0);
        const V k_out(k.x, 0, -k.z);
        const C N(u.between(0.02, 10), u.between(0, 15));
        const auto r = reflect(ComplexIndex<double>{N.real(), N.imag()}, std::cos(theta));
        const Field es = reflected_field(k, m, N, field(k, s, 1, 0));
        const Field ep = reflected_field(k, m, N, field(k, s, 0, 1));
        const C rs = dot(eigen(s).cast<C>(), es);
        const C rp = dot(eigen(glm::cross(k_out, s)).cast<C>(), ep);
        EXPECT_NEAR(r.Rs, std::norm(rs), 1e-12);
        EXPECT_NEAR(r.Rp, std::norm(rp), 1e-12);
        const C rho = std::conj(rp / rs);
        EXPECT_NEAR(r.C, std::norm(rs) * rho.real(), 1e-12);
        EXPECT_NEAR(r.S, std::norm(rs) * rho.imag(), 1e-12);
        EXPECT_NEAR(std::tan(psi(r)), std::abs(rho), 1e-9 * (1 + std::abs(rho)));
        EXPECT_NEAR(std::remainder(delta(r) - std::arg(rho), 2 * pi), 0, 1e-9 / std::abs(rho));
    }
}

// In words: unpolarised light leaves a metal polarised along s; light at +45 degrees, from s
// towards p = k x s, leaves it clockwise (S3 > 0), because S > 0.
TEST(Handedness, KnownSigns) {
    const double theta = pi / 4;
    const V i(-std::sin(theta), 0, std::cos(theta)), o(std::sin(theta), 0, std::cos(theta));
    const V s(0, 1, 0), m(0, 0, 1);
    const C N(1.04, 2.59);
    Surface<double> copper;
    copper.substrate = {N.real(), N.imag()};
    const auto matrix = mirror_mueller(copper, m, i, s, o, s, 1.0);
    const auto unpolarised = matrix * Stokes<double>{{1, 0, 0, 0}};
    EXPECT_GT(unpolarised[1], 0.05);
    EXPECT_NEAR(unpolarised[2], 0, 1e-15);
    const auto diagonal = matrix * Stokes<double>{{1, 0, 1, 0}};
    EXPECT_GT(diagonal[3], 0.1);
    const Field in = field(-i, s, std::sqrt(0.5), std::sqrt(0.5));
    const auto seen = observed_stokes(reflected_field(-i, m, N, in), o, s);
    for (int j = 0; j < 4; ++j) EXPECT_NEAR(seen[j], diagonal[j], 1e-12);
}

// The trap of conventions.md, without a renderer: a point up-right of the centre of a copper sphere
// under an unpolarised sky. The camera looks along +z with y up; x is right in the left-handed
// world of pbrt (handedness -1) and left in the right-handed one (+1).
TEST(Handedness, UpRightOfASphereS2IsNegative) {
    Surface<double> copper;
    copper.substrate = {1.04, 2.59};
    for (const double h : {-1.0, 1.0}) {
        const double right = -h;
        const V ray(0, 0, 1), camera_y(0, 1, 0);
        const V normal = glm::normalize(V(right * 0.5, 0.5, -0.9)), o = -ray;
        const V i = 2 * glm::dot(o, normal) * normal - o;
        const V x = glm::normalize(glm::cross(ray, camera_y));
        const auto matrix = mirror_mueller(copper, normal, i, any_perpendicular(i), o, x, h);
        const auto seen = matrix * Stokes<double>{{1, 0, 0, 0}};
        EXPECT_LT(seen[2], -0.01) << "handedness " << h;
        EXPECT_NEAR(seen[1], 0, 1e-12);
        EXPECT_NEAR(seen[3], 0, 1e-12);
        double aolp = 0.5 * std::atan2(seen[2], seen[1]) * 180 / pi;
        if (aolp < 0) aolp += 180;
        EXPECT_NEAR(aolp, 135, 1e-9);
    }
}

// ---- films
// ---------------------------------------------------------------------------------------

// One stack by Abeles's characteristic matrices (Born & Wolf, section 1.6), in amplitudes: the
// tangential field and its slope carried up from the substrate. For p the field is H, whose
// amplitude has the sign of E_p along p = k x s.
Reflection<double> stack_by_matrices(const std::vector<ThinFilm<double>>& films, C substrate,
                                     double cos_theta, double wavelength) {
    const double u = 1 - cos_theta * cos_theta;
    const auto normal = [&](C N) {
        const C q = std::sqrt(N * N - u);
        return q.imag() < 0 ? -q : q;
    };
    C amplitude[2];
    for (int p = 0; p < 2; ++p) {
        const auto admittance = [&](C N) { return p ? normal(N) / (N * N) : normal(N); };
        C value = 1, slope = admittance(substrate);
        for (auto film = films.rbegin(); film != films.rend(); ++film) {
            const C N(film->index.n, film->index.k), y = admittance(N);
            const C phase = 2 * pi * film->thickness / wavelength * normal(N);
            const C c = std::cos(phase), s = std::sin(phase), i(0, 1);
            // Downwards the wave is exp(i q z); going up by d undoes it.
            const C above = c * value - i * s / y * slope;
            slope = c * slope - i * y * s * value;
            value = above;
        }
        amplitude[p] = (cos_theta * value - slope) / (cos_theta * value + slope);
    }
    const C cross_term = amplitude[0] * std::conj(amplitude[1]);
    return {std::norm(amplitude[0]), std::norm(amplitude[1]), cross_term.real(), cross_term.imag()};
}

TEST(Handedness, FilmsKeepTheSigns) {
    numeric::Uniform u(33);
    for (int n = 0; n < 2000; ++n) {
        std::vector<ThinFilm<double>> films(static_cast<size_t>(4 * u.next()));
        for (auto& film : films) {
            film = {{u.between(1.05, 3), n % 2 ? u.between(0, 2) : 0.0}, u.between(0, 400)};
        }
        const C N(u.between(0.05, 5), u.between(0, 8));
        const double cos_theta = u.between(0.02, 1), wavelength = u.between(380, 780);
        const auto a = reflect(films.data(), static_cast<int>(films.size()),
                               ComplexIndex<double>{N.real(), N.imag()}, cos_theta, wavelength);
        const auto b = stack_by_matrices(films, N, cos_theta, wavelength);
        EXPECT_NEAR(a.Rs, b.Rs, 1e-9);
        EXPECT_NEAR(a.Rp, b.Rp, 1e-9);
        EXPECT_NEAR(a.C, b.C, 1e-9);
        EXPECT_NEAR(a.S, b.S, 1e-9);
    }
}

}  // namespace
}  // namespace drude
