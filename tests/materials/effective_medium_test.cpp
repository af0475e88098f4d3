#include "materials/effective_medium.h"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <complex>

namespace drude {
namespace {

const ComplexIndex<double> media[] = {{1, 0},    {1.45, 0},   {1.77, 0},    {1.77, 1e-9},
                                      {4, 0.03}, {0.05, 3.1}, {0.96, 6.69}, {2.9, 0.6}};

std::complex<double> epsilon(const ComplexIndex<double>& index) {
    const std::complex<double> root(index.n, index.k);
    return root * root;
}

TEST(Bruggeman, SolvesItsEquationOnThePassiveSide) {
    for (const auto& a : media) {
        for (const auto& b : media) {
            for (const double f : {0.0, 0.01, 0.1, 0.3, 1.0 / 3, 0.5, 0.7, 0.9, 1.0}) {
                const auto mixed = bruggeman(a, b, f);
                const auto e = epsilon(mixed), ea = epsilon(a), eb = epsilon(b);
                EXPECT_GE(mixed.k, 0);
                EXPECT_GT(mixed.n, 0);
                const auto rest =
                    (1 - f) * (ea - e) * (eb + 2.0 * e) + f * (eb - e) * (ea + 2.0 * e);
                EXPECT_LT(std::abs(rest), 1e-12 * (1 + std::norm(ea) + std::norm(eb)))
                    << a.n << "," << a.k << " " << b.n << "," << b.k << " " << f;
                const auto exchanged = bruggeman(b, a, 1 - f);
                EXPECT_NEAR(exchanged.n, mixed.n, 1e-6 * (1 + mixed.n));
                EXPECT_NEAR(exchanged.k, mixed.k, 1e-6 * (1 + mixed.k));
            }
        }
    }
}

TEST(Bruggeman, EndsAreTheMaterialsThemselves) {
    for (const auto& a : media) {
        for (const auto& b : media) {
            EXPECT_NEAR(bruggeman(a, b, 0.0).n, a.n, 1e-7 * (1 + a.n + a.k + b.k));
            EXPECT_NEAR(bruggeman(a, b, 0.0).k, a.k, 1e-7 * (1 + a.n + a.k + b.k));
            EXPECT_NEAR(bruggeman(a, b, 1.0).n, b.n, 1e-7 * (1 + b.n + a.k + b.k));
            EXPECT_NEAR(bruggeman(a, b, 1.0).k, b.k, 1e-7 * (1 + b.n + a.k + b.k));
        }
    }
}

// Sapphire of 1.770 at 550 nm with voids (numpy).
TEST(Bruggeman, PorousAluminaIsWhatAnIndependentImplementationFinds) {
    const double expected[][2] = {{0, 1.770}, {0.1, 1.692}, {0.2, 1.612}, {0.3, 1.531}};
    for (const auto& [porosity, n] : expected) {
        const auto mixed =
            bruggeman(ComplexIndex<double>{1.770, 0}, ComplexIndex<double>{1, 0}, porosity);
        EXPECT_NEAR(mixed.n, n, 0.0011);
        EXPECT_EQ(mixed.k, 0);
    }
}

TEST(Bruggeman, DerivativesAreThoseOfDifferences) {
    using Jet = ceres::Jet<double, 1>;
    for (const auto& a : media) {
        for (const double f : {0.05, 0.4}) {
            const auto jet = bruggeman(ComplexIndex<Jet>{Jet(a.n), Jet(a.k)},
                                       ComplexIndex<Jet>{Jet(1.0), Jet(0.0)}, Jet(f, 0));
            const ComplexIndex<double> air{1, 0};
            const double h = 1e-6;
            const auto up = bruggeman(a, air, f + h), down = bruggeman(a, air, f - h);
            EXPECT_NEAR(jet.n.v[0], (up.n - down.n) / (2 * h), 1e-5 * (1 + std::abs(jet.n.v[0])));
            EXPECT_NEAR(jet.k.v[0], (up.k - down.k) / (2 * h), 1e-5 * (1 + std::abs(jet.k.v[0])));
        }
    }
}

}  // namespace
}  // namespace drude
