// The optics against published numbers, against themselves in other scalars, and against physics.
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>

#include "materials/film_stack.h"
#include "materials/mueller.h"
#include "materials/packet.h"

namespace drude {
namespace {

double delta_360(const Reflection<double>& r) {
    const double d = delta(r) / degree;
    return d < 0 ? d + 360 : d;
}

struct Golden {
    double n, k, theta, Rs, Rp, psi, delta, A, B, C, S;
};

// Two independent derivations agree on these.
constexpr Golden golden_bare[] = {
    {1.04, 2.59, 30, .66213206, .57161736, 42.896342, 169.099304, .61687471, .04525735, -.60411167,
     .11634118},
    {1.04, 2.59, 60, .79297036, .44505131, 36.839209, 126.836625, .61901084, .17395952, -.35616259,
     .47545842},
    {1.04, 2.59, 80, .92341549, .52435976, 37.000107, 53.553486, .72388762, .19952787, .41338282,
     .55974687},
    {0.05, 3.09, 30, .98392419, .97826681, 44.917402, 169.464399, .98109550, .00282869, -.96455168,
     .17938907},
    {0.05, 3.09, 60, .99091460, .96836599, 44.670295, 129.902529, .97964029, .01127430, -.62838145,
     .75146839},
    {0.96, 6.69, 60, .95999120, .85350177, 43.316810, 155.376768, .90674649, .05324472, -.82287117,
     .37714351},
    {0.96, 6.69, 80, .98595171, .74928689, 41.080571, 101.537310, .86761930, .11833241, -.17190753,
     .84214517},
    {0.183, 3.43, 75, .98584519, .89306628, 43.584818, 89.400725, .93945574, .04638946, .00981390,
     .93825838},
};

TEST(Optics, GoldenNumbersOfBareSurfaces) {
    for (const Golden& g : golden_bare) {
        const Reflection<double> r =
            reflect(ComplexIndex<double>{g.n, g.k}, std::cos(g.theta * degree));
        EXPECT_NEAR(r.Rs, g.Rs, 1e-6);
        EXPECT_NEAR(r.Rp, g.Rp, 1e-6);
        EXPECT_NEAR(psi(r) / degree, g.psi, 1e-6);
        EXPECT_NEAR(delta_360(r), g.delta, 1e-6);
        EXPECT_NEAR(r.A(), g.A, 1e-6);
        EXPECT_NEAR(r.B(), g.B, 1e-6);
        EXPECT_NEAR(r.C, g.C, 1e-6);
        EXPECT_NEAR(r.S, g.S, 1e-6);
    }
}

struct GoldenFilm {
    ThinFilm<double> film;
    ComplexIndex<double> substrate;
    double theta, psi, delta, Rs, Rp;  // Rs, Rp 0 where only the angles are known
};

constexpr GoldenFilm golden_films[] = {
    {{{1.77, 0}, 100}, {0.96, 6.69}, 60, 44.924760, 231.155169, .85518400, .85070371},
    {{{1.692, 0}, 3000}, {0.96, 6.69}, 60, 43.320741, 189.628412, .95948584, .85328700},
    {{{3.1, 0.2}, 5}, {1.04, 2.59}, 70, 34.987227, 82.048113, 0, 0},
};

TEST(Optics, GoldenNumbersOfFilms) {
    for (const GoldenFilm& g : golden_films) {
        const Reflection<double> r =
            reflect(&g.film, 1, g.substrate, std::cos(g.theta * degree), 550.0);
        EXPECT_NEAR(psi(r) / degree, g.psi, 1e-6);
        EXPECT_NEAR(delta_360(r), g.delta, 1e-6);
        if (g.Rs == 0) continue;
        EXPECT_NEAR(r.Rs, g.Rs, 1e-6);
        EXPECT_NEAR(r.Rp, g.Rp, 1e-6);
    }
}

TEST(Optics, TwoHalvesOfAFilmAreTheFilm) {
    const ComplexIndex<double> substrate{0.96, 6.69};
    for (const GoldenFilm& g : golden_films) {
        const ThinFilm<double> thirds[] = {{g.film.index, g.film.thickness / 3},
                                           {g.film.index, 0},
                                           {g.film.index, 2 * g.film.thickness / 3}};
        const Reflection<double> whole = reflect(&g.film, 1, substrate, 0.5, 550.0);
        const Reflection<double> parts = reflect(thirds, 3, substrate, 0.5, 550.0);
        EXPECT_NEAR(whole.Rs, parts.Rs, 1e-12);
        EXPECT_NEAR(whole.C, parts.C, 1e-12);
        EXPECT_NEAR(whole.S, parts.S, 1e-12);
    }
}

TEST(Optics, LimitsAtNormalAndGrazingIncidence) {
    const ComplexIndex<double> copper{1.04, 2.59};
    const Reflection<double> normal = reflect(copper, 1.0);
    const double expected = (0.04 * 0.04 + 2.59 * 2.59) / (2.04 * 2.04 + 2.59 * 2.59);
    EXPECT_NEAR(normal.Rs, expected, 1e-15);
    EXPECT_NEAR(normal.Rp, expected, 1e-15);
    EXPECT_NEAR(delta_360(normal), 180, 1e-12);
    const Reflection<double> grazing = reflect(copper, 0.0);
    EXPECT_EQ(grazing.Rs, 1);
    EXPECT_EQ(grazing.Rp, 1);
    EXPECT_EQ(delta(grazing), 0);
}

TEST(Optics, BrewstersAngleReflectsNoP) {
    const double theta = std::atan(1.5);
    EXPECT_NEAR(reflect(ComplexIndex<double>{1.5, 0}, std::cos(theta)).Rp, 0, 1e-30);
}

struct Random {
    std::mt19937_64 bits{20240607};
    double operator()(double low, double high) {
        return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1p-53;
    }
};

struct Case {
    ComplexIndex<double> index;
    double theta_deg;
};

// The stated domain; k is 0 for a tenth and log-uniform below 0.05 for another, so that the
// lossless corner is as well covered as the metals.
Case random_case(Random* random) {
    Case c{{(*random)(0.02, 10), (*random)(0, 15)}, (*random)(0, 89.9)};
    const double kind = (*random)(0, 10);
    if (kind < 1) c.index.k = 0;
    if (kind >= 1 && kind < 2) c.index.k = std::pow(10, (*random)(-6, -1.3));
    return c;
}

// Within 1e-3 of where the refracted wave turns evanescent, or of vanishing contrast, floats keep
// no relative accuracy; there only physics is asked for.
bool is_singular(const Case& c) {
    if (c.index.k > 1e-2) return false;
    const bool critical =
        c.index.n < 1 && std::abs(std::sin(c.theta_deg * degree) - c.index.n) < 1e-3;
    return critical || std::abs(c.index.n - 1) < 0.02;
}

Reflection<double> in_double(const Reflection<float>& r) {
    return {r.Rs, r.Rp, r.C, r.S};
}

double largest_difference(const Reflection<double>& a, const Reflection<double>& b) {
    double worst = 0;
    const double pairs[][2] = {{a.Rs, b.Rs}, {a.Rp, b.Rp},   {a.C, b.C},
                               {a.S, b.S},   {a.A(), b.A()}, {a.B(), b.B()}};
    for (const auto& pair : pairs) worst = std::max(worst, std::abs(pair[0] - pair[1]));
    return worst;
}

void expect_physical(const Reflection<double>& r, double slack, const Case& c) {
    const double values[] = {r.Rs, r.Rp, r.C, r.S};
    for (const double value : values) ASSERT_TRUE(std::isfinite(value));
    EXPECT_LE(r.Rs, 1 + slack) << c.index.n << " " << c.index.k << " " << c.theta_deg;
    EXPECT_LE(r.Rp, 1 + slack) << c.index.n << " " << c.index.k << " " << c.theta_deg;
    EXPECT_GE(r.Rs, -slack);
    EXPECT_GE(r.Rp, -slack);
}

// The packet instantiation, every lane its own case.
template <class Evaluate>
void reflect_packet(const Case* cases, Reflection<double>* results, Evaluate evaluate) {
    Packet<8> n, k, cosine;
    for (int lane = 0; lane < 8; ++lane) {
        n.set(lane, static_cast<float>(cases[lane].index.n));
        k.set(lane, static_cast<float>(cases[lane].index.k));
        cosine.set(lane, static_cast<float>(std::cos(cases[lane].theta_deg * degree)));
    }
    const Reflection<Packet<8>> r = evaluate(ComplexIndex<Packet<8>>{n, k}, cosine);
    for (int lane = 0; lane < 8; ++lane) {
        results[lane] = {r.Rs[lane], r.Rp[lane], r.C[lane], r.S[lane]};
    }
}

// What floats were given, so that only the arithmetic is compared and not the rounding of input.
Case rounded(const Case& c, double* cosine) {
    *cosine = static_cast<float>(std::cos(c.theta_deg * degree));
    return {{static_cast<float>(c.index.n), static_cast<float>(c.index.k)}, c.theta_deg};
}

TEST(Optics, FloatsAndPacketsStayWithinTheirBoundsOfDouble) {
    Random random;
    double worst_metal = 0, worst_lossless = 0;
    for (int i = 0; i < 250000; ++i) {
        Case cases[8];
        for (Case& c : cases) c = random_case(&random);
        Reflection<double> packet[8];
        reflect_packet(cases, packet, [](const auto& index, const auto& cosine) {
            return reflect(index, cosine);
        });
        for (int lane = 0; lane < 8; ++lane) {
            double cosine = 0;
            const Case c = rounded(cases[lane], &cosine);
            const Reflection<double> exact = reflect(c.index, cosine);
            const ComplexIndex<float> index{static_cast<float>(c.index.n),
                                            static_cast<float>(c.index.k)};
            const Reflection<double> single = in_double(reflect(index, static_cast<float>(cosine)));
            expect_physical(packet[lane], 1e-6, c);
            expect_physical(single, 1e-6, c);
            if (HasFatalFailure()) return;
            if (is_singular(c)) continue;
            const double difference = std::max(largest_difference(packet[lane], exact),
                                               largest_difference(single, exact));
            double& worst = c.index.k >= 0.05 ? worst_metal : worst_lossless;
            if (difference > worst) worst = difference;
            ASSERT_LT(difference, c.index.k >= 0.05 ? 1e-6 : 2e-5)
                << c.index.n << " + " << c.index.k << "i at " << c.theta_deg;
        }
    }
    RecordProperty("worst_metal", std::to_string(worst_metal));
    RecordProperty("worst_lossless", std::to_string(worst_lossless));
}

TEST(Optics, FilmsInPacketsStayWithinTheirBound) {
    Random random;
    for (int i = 0; i < 50000; ++i) {
        Case cases[8];
        for (Case& c : cases) {
            c = {{random(0.02, 10), random(0.05, 15)}, random(0, 89.9)};
        }
        const float film_n = static_cast<float>(random(1.2, 3)),
                    film_k = static_cast<float>(random(0, 1) < 0.5 ? 0 : random(0, 0.5));
        const float thickness = static_cast<float>(random(0, 6000));
        const float wavelength = static_cast<float>(random(380, 780));
        Reflection<double> packet[8];
        reflect_packet(cases, packet, [&](const auto& index, const auto& cosine) {
            using P = Packet<8>;
            const ThinFilm<P> film{{P(film_n), P(film_k)}, P(thickness)};
            return reflect(&film, 1, index, cosine, P(wavelength));
        });
        const ThinFilm<double> film{{film_n, film_k}, thickness};
        for (int lane = 0; lane < 8; ++lane) {
            double cosine = 0;
            const Case c = rounded(cases[lane], &cosine);
            const Reflection<double> exact =
                reflect(&film, 1, c.index, cosine, static_cast<double>(wavelength));
            expect_physical(packet[lane], 1e-5, c);
            if (HasFatalFailure()) return;
            ASSERT_LT(largest_difference(packet[lane], exact), 5e-4)
                << c.index.n << " + " << c.index.k << "i at " << c.theta_deg << " under "
                << thickness << " nm of " << film_n << " + " << film_k << "i";
        }
    }
}

TEST(Optics, EveryMatrixIsRealisable) {
    Random random;
    for (int i = 0; i < 20000; ++i) {
        const Case c = random_case(&random);
        const double cosine = std::cos(c.theta_deg * degree);
        const ThinFilm<double> film{{random(1, 3), random(0, 1)}, random(0, 6000)};
        const Reflection<double> bare = reflect(c.index, cosine);
        const Reflection<double> coated = reflect(&film, 1, c.index, cosine, 550.0);
        if (bare.Rs + bare.Rp > 1e-6) {
            EXPECT_GT(smallest_coherency_eigenvalue(mueller(bare)), -1e-9);
        }
        if (coated.Rs + coated.Rp > 1e-6) {
            EXPECT_GT(smallest_coherency_eigenvalue(mueller(coated)), -1e-9);
        }
        // A mixture of two coherent surfaces in turned frames depolarises, and is a device still.
        const double turn = random(0, 2 * pi);
        const Rotation<double> rotation{std::cos(turn), std::sin(turn)};
        const Mueller<double> turned = mueller(rotation) * mueller(coated) * mueller(bare);
        if (turned.m[0][0] > 1e-6) {
            EXPECT_GT(smallest_coherency_eigenvalue(turned), -1e-9);
        }
    }
}

// The eigenvalues of diag(1, a, b, c) are (1 +- a +- b +- c)/4 with one sign of the product (Cloude
// 1986), for a trace of M00.
TEST(Mueller, SmallestCoherencyEigenvalueOfKnownMatrices) {
    EXPECT_NEAR(smallest_coherency_eigenvalue(Mueller<double>::identity()), 0, 1e-15);
    EXPECT_NEAR(smallest_coherency_eigenvalue(Mueller<double>::diagonal(1, 0, 0, 0)), 0.25, 1e-15);
    // Mirroring all three components is no physical operation.
    EXPECT_NEAR(smallest_coherency_eigenvalue(Mueller<double>::diagonal(1, -1, -1, -1)), -0.5,
                1e-15);
    EXPECT_NEAR(smallest_coherency_eigenvalue(Mueller<double>::diagonal(2, 1, 0.5, 0.25)),
                0.25 * (1 - 0.5 - 0.25 + 0.125), 1e-15);
    Mueller<double> scaled = mueller(reflect(ComplexIndex<double>{1.04, 2.59}, 0.5));
    const double before = smallest_coherency_eigenvalue(scaled);
    scaled.m[2][3] *= 1.01;
    EXPECT_LT(smallest_coherency_eigenvalue(scaled), -1e-4);
    EXPECT_NEAR(before, 0, 1e-15);
}

TEST(Mueller, ReversedMatrixIsRealisableToo) {
    const Mueller<double> m = mueller(reflect(ComplexIndex<double>{1.04, 2.59}, 0.5)) *
                              mueller(Rotation<double>{0.6, 0.8}) *
                              mueller(reflect(ComplexIndex<double>{0.05, 3.09}, 0.3));
    EXPECT_GT(smallest_coherency_eigenvalue(m), -1e-12);
    EXPECT_GT(smallest_coherency_eigenvalue(reversed(m)), -1e-12);
}

// dPsi = sinPsi cosPsi Re g, dDelta = -Im g with g = L N/q, L = -2s/(s^2 - q^2) for d/dn, and i g
// for d/dk: an independent form of what ceres::Jet carries through reflect().
TEST(Optics, JetDerivativesMatchTheAnalyticJacobian) {
    using Jet = ceres::Jet<double, 2>;
    Random random;
    for (int i = 0; i < 2000; ++i) {
        const std::complex<double> N(random(0.05, 5), random(0.1, 8));
        const double theta = random(20, 85) * degree;
        const Reflection<Jet> r =
            reflect(ComplexIndex<Jet>{Jet(N.real(), 0), Jet(N.imag(), 1)}, Jet(std::cos(theta)));
        const double sine = std::sin(theta), s = sine * std::tan(theta);
        const std::complex<double> q = std::sqrt(N * N - sine * sine);
        const std::complex<double> g = -2 * s / (s * s - q * q) * N / q;
        const std::complex<double> by[2] = {g, g * std::complex<double>(0, 1)};
        const Jet psi_jet = psi(r), delta_jet = delta(r);
        const double scale = 0.5 * std::sin(2 * psi_jet.a);
        for (int j = 0; j < 2; ++j) {
            EXPECT_NEAR(psi_jet.v[j], scale * by[j].real(), 1e-9 * (1 + std::abs(by[j])));
            EXPECT_NEAR(delta_jet.v[j], -by[j].imag(), 1e-9 * (1 + std::abs(by[j])));
        }
    }
}

}  // namespace
}  // namespace drude
