// The lobes themselves: norms, widths, masking, and what they conserve, all by quadrature.
#include "materials/microfacet.h"

#include <gtest/gtest.h>

#include <ceres/jet.h>

#include "materials/numeric.h"

namespace drude {
namespace {

using numeric::integrate;
using numeric::integrate_plane;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double ln2 = 0.69314718055994530942;

const std::vector<Lobe> lobes = {Lobe::blinn_phong, Lobe::gaussian, Lobe::beckmann,
                                 Lobe::trowbridge_reitz};
const std::vector<double> betas = {1e-5, 1e-4, 0.01, 0.03, 0.1, 0.3, 1, 1.2};

std::vector<Masking> maskings(Lobe lobe) {
    if (lobe == Lobe::beckmann || lobe == Lobe::trowbridge_reitz) {
        return {Masking::v_groove, Masking::smith};
    }
    return {Masking::v_groove};
}

std::string name(Lobe lobe, Masking masking, double beta) {
    return fmt::format("{} {} beta {}", lobe_name(lobe), masking_name(masking), beta);
}

// The integral of weight(tan) D(m) m.z over the hemisphere, in the polar coordinates of the slope:
// m.z d omega = t / (1 + t^2)^2 dt d phi.
template <class T, class Weight>
double lobe_integral(Lobe lobe, double beta, const Weight& weight) {
    const Microfacets<T> microfacets(lobe, Masking::v_groove, beta);
    constexpr int directions = 8;
    return integrate(0, 1, 128, [&](double v) {
        const double t = numeric::unit_to_line(v, beta), z = 1 / std::sqrt(1 + t * t);
        double d = 0;
        for (int j = 0; j < directions; ++j) {
            const double phi = 2 * pi * (j + 0.3) / directions;
            const Vec3<double> m(t * z * std::cos(phi), t * z * std::sin(phi), z);
            d += static_cast<double>(microfacets.D(Vec3<T>(m)));
        }
        return weight(t) * numeric::unit_to_line_slope(v, beta) * t * z * z * z * z * d * 2 * pi /
               directions;
    });
}

double D0(Lobe lobe, double beta) {
    return LobeDensity<double>(lobe, beta)(0.0);
}

TEST(Lobe, NormalisedInDouble) {
    for (const Lobe lobe : lobes) {
        for (const double beta : betas) {
            EXPECT_NEAR(lobe_integral<double>(lobe, beta, [](double) { return 1.0; }), 1, 1e-9)
                << lobe_name(lobe) << " " << beta;
        }
    }
}

TEST(Lobe, NormalisedInFloat) {
    for (const Lobe lobe : lobes) {
        for (const double beta : betas) {
            EXPECT_NEAR(lobe_integral<float>(lobe, beta, [](double) { return 1.0; }), 1, 1e-5)
                << lobe_name(lobe) << " " << beta;
        }
    }
}

TEST(Lobe, BetaIsTheHalfHeightAngle) {
    for (const Lobe lobe : {Lobe::blinn_phong, Lobe::gaussian, Lobe::trowbridge_reitz}) {
        for (const double beta : betas) {
            const LobeDensity<double> density(lobe, beta);
            const double tan2 = std::tan(beta) * std::tan(beta);
            EXPECT_NEAR(density(tan2) / density(0.0), 0.5, 1e-12) << lobe_name(lobe) << beta;
            const LobeDensity<float> in_float(lobe, static_cast<float>(beta));
            EXPECT_NEAR(in_float(static_cast<float>(tan2)) / in_float(0.0f), 0.5, 1e-6);
        }
    }
}

TEST(Lobe, BetaOfBeckmannIsTheRmsSlope) {
    for (const double beta : betas) {
        const double mean_square =
            lobe_integral<double>(Lobe::beckmann, beta, [](double t) { return t * t; });
        EXPECT_NEAR(mean_square / (beta * beta), 1, 1e-9) << beta;
    }
}

TEST(Lobe, NarrowLobesHaveTheirLimits) {
    for (const double beta : {1e-5, 1e-4, 1e-3}) {
        const double b2 = beta * beta, loose = 3 * b2 + 1e-12;
        EXPECT_NEAR(D0(Lobe::blinn_phong, beta) * b2 * pi / ln2, 1, loose);
        EXPECT_NEAR(D0(Lobe::gaussian, beta) * b2 * pi / ln2, 1, loose);
        EXPECT_NEAR(D0(Lobe::beckmann, beta) * b2 * pi, 1, loose);
        EXPECT_NEAR(D0(Lobe::trowbridge_reitz, beta) * b2 * pi / (std::sqrt(2.0) - 1), 1, loose);
    }
    // The study's own number: pbrt-v2's exponent 10000 (conventions.md).
    EXPECT_NEAR(blinn_phong_exponent(0.011774), 10000, 1);
    EXPECT_NEAR(blinn_phong_exponent(0.5), -ln2 / std::log(std::cos(0.5)), 1e-12);
}

// The closed form of conventions.md, by the error function of a complex argument.
TEST(Lobe, GaussianNormIsTheClosedForm) {
    for (const double beta : {0.01, 0.03, 0.1, 0.3, 0.6, 1.0, 1.2}) {
        const double g = std::sqrt(ln2) / beta;
        const std::complex<double> i(0, 1);
        const double norm = pi * (std::sqrt(pi) / (2 * g) * std::exp(-1 / (g * g)) *
                                  (numeric::erf(g * pi / 2 - i / g) + numeric::erf(i / g)))
                                     .imag();
        EXPECT_NEAR(D0(Lobe::gaussian, beta) * norm, 1, 1e-12) << beta;
    }
}

TEST(Lobe, ShapesAreThoseOfTheConventions) {
    for (const double beta : {0.01, 0.3, 1.2}) {
        for (const double alpha : {0.0, 0.3 * beta, beta, 1.25 * beta}) {
            const double c = std::cos(alpha), t = std::tan(alpha), b2 = beta * beta;
            const double e = -ln2 / std::log(std::cos(beta)), g = std::sqrt(ln2) / beta;
            const double c2 =
                std::pow(std::sin(beta), 2) / (std::sqrt(2.0) - std::pow(std::cos(beta), 2));
            const double expected[] = {std::pow(c, e), std::exp(-std::pow(g * alpha, 2)),
                                       std::exp(-t * t / b2) / std::pow(c, 4),
                                       std::pow(c2 / (c * c * (c2 - 1) + 1), 2)};
            for (size_t i = 0; i < lobes.size(); ++i) {
                const LobeDensity<double> density(lobes[i], beta);
                EXPECT_NEAR(density(t * t) / density(0.0), expected[i], 1e-10 * expected[i])
                    << lobe_name(lobes[i]) << " " << beta << " " << alpha;
            }
        }
    }
}

TEST(Lobe, FiniteFromTheNormalToTheHorizon) {
    for (const Lobe lobe : lobes) {
        for (const double beta : betas) {
            const LobeDensity<double> density(lobe, beta);
            const LobeDensity<float> in_float(lobe, static_cast<float>(beta));
            for (const double tan2 : {0.0, 1e-30, 1.0, 1e10, 1e30, infinity}) {
                EXPECT_TRUE(density(tan2) >= 0 && std::isfinite(density(tan2)))
                    << lobe_name(lobe) << " " << beta << " " << tan2;
                const float f = in_float(static_cast<float>(tan2));
                EXPECT_TRUE(f >= 0 && std::isfinite(f)) << lobe_name(lobe) << " " << tan2;
            }
            // The widest Blinn-Phong lobe falls as tan^-0.68 only.
            EXPECT_NEAR(density(infinity), density(1e100), 1e-30 * density(0.0));
        }
    }
}

// The fitter differentiates by beta.
TEST(Lobe, DerivativesByBeta) {
    using Jet = ceres::Jet<double, 1>;
    for (const Lobe lobe : lobes) {
        for (const double tan2 : {0.0, 0.01, 0.1, 1.0}) {
            const double beta = 0.3, h = 1e-5;
            const Jet d = LobeDensity<Jet>(lobe, Jet(beta, 0))(Jet(tan2));
            const double slope = (LobeDensity<double>(lobe, beta + h)(tan2) -
                                  LobeDensity<double>(lobe, beta - h)(tan2)) /
                                 (2 * h);
            EXPECT_NEAR(d.v[0], slope, 1e-6 * D0(lobe, beta) / beta) << lobe_name(lobe) << tan2;
        }
    }
}

TEST(Lobe, TrowbridgeReitzAlphaAndBackAgain) {
    for (const double beta : betas) {
        EXPECT_NEAR(trowbridge_reitz_beta(trowbridge_reitz_alpha(beta)) / beta, 1, 1e-12);
    }
    for (const double alpha : {1e-4, 0.01, 0.3, 0.8, 0.84}) {
        const double beta = trowbridge_reitz_beta(alpha);
        ASSERT_GT(beta, 0);
        EXPECT_NEAR(trowbridge_reitz_alpha(beta) / alpha, 1, 1e-12);
        const auto by_beta = LobeDensity<double>(Lobe::trowbridge_reitz, beta);
        const auto by_alpha = LobeDensity<double>::from_alpha(alpha);
        EXPECT_NEAR(by_beta(0.2) / by_alpha(0.2), 1, 1e-11);
    }
    for (const double alpha : {0.841, 1.0, 2.0, 4.0}) EXPECT_LT(trowbridge_reitz_beta(alpha), 0);
}

TEST(Microfacets, RefuseWhatTheyCannotModel) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double beta : {-0.1, 1.3, nan, infinity}) {
        EXPECT_THROW(Microfacets<double>(Lobe::gaussian, Masking::v_groove, beta), Error) << beta;
    }
    for (const double alpha : {-0.1, 4.1, nan}) {
        EXPECT_THROW(Microfacets<float>::from_alpha(alpha, Masking::smith), Error) << alpha;
    }
    for (const Lobe lobe : {Lobe::gaussian, Lobe::blinn_phong}) {
        EXPECT_THROW(Microfacets<double>(lobe, Masking::smith, 0.1), Error);
    }
    EXPECT_TRUE(Microfacets<float>(Lobe::beckmann, Masking::smith, 0).is_mirror());
    EXPECT_TRUE(Microfacets<float>(Lobe::beckmann, Masking::smith, 0.99e-5).is_mirror());
    EXPECT_FALSE(Microfacets<float>(Lobe::beckmann, Masking::smith, 1e-5).is_mirror());
}

TEST(Microfacets, AMirrorReflectsEverything) {
    const Microfacets<float> mirror;
    const Vec3<float> o(0.6f, 0, 0.8f);
    const auto s = mirror.sample(o, 0.3f, 0.4f, 0.5f);
    EXPECT_EQ(s.i, Vec3<float>(-0.6f, 0, 0.8f));
    EXPECT_EQ(s.weight, 1.0f);
    EXPECT_EQ(s.pdf, 0.0f);
    EXPECT_EQ(mirror.evaluate(o, s.i).value, 0.0f);
}

// ---- masking
// -------------------------------------------------------------------------------------

struct Rough {
    Microfacets<double> microfacets;
    std::string name;
    double scale;
};

std::vector<Rough> surfaces(const std::vector<double>& widths) {
    std::vector<Rough> all;
    for (const Lobe lobe : lobes) {
        for (const Masking masking : maskings(lobe)) {
            for (const double beta : widths) {
                all.push_back({{lobe, masking, beta}, name(lobe, masking, beta), beta});
            }
        }
    }
    all.push_back({Microfacets<double>::from_alpha(2.5, Masking::smith), "alpha 2.5", 2.5});
    return all;
}

Vec3<double> normal_of_slope(double p, double q) {
    return glm::normalize(Vec3<double>(-p, -q, 1));
}

// G1 makes what o sees of the facets exactly o's own view of the flat surface (Heitz 2014, eq. 14).
// For o in the xz plane everything has its kinks at p = +-cot of o's angle.
TEST(Microfacets, VisibleNormalsAreNormalised) {
    for (const Rough& surface : surfaces(betas)) {
        for (const double degrees : {0.0, 1.0, 20.0, 45.0, 70.0, 85.0, 89.0, 89.9}) {
            const double theta = degrees * pi / 180;
            const Vec3<double> o(std::sin(theta), 0, std::cos(theta));
            const double kink = o.x > 0 ? o.z / o.x : infinity;
            const double total =
                integrate_plane(surface.scale, {-infinity, -kink, 0, kink, infinity}, 12,
                                numeric::no_limit, [&](double p, double q) {
                                    const Vec3<double> m = normal_of_slope(p, q);
                                    return surface.microfacets.pdf_visible(o, m) * m.z * m.z * m.z;
                                });
            EXPECT_NEAR(total, 1, 1e-8) << surface.name << " at " << degrees;
        }
    }
}

// The other wall of a groove is the facet's mirror image at the normal; together they fill it.
TEST(Microfacets, GrooveIsFilledByItsTwoWalls) {
    const Microfacets<double> groove(Lobe::beckmann, Masking::v_groove, 0.5);
    numeric::Uniform u(6);
    for (int n = 0; n < 10000; ++n) {
        const Vec3<double> m = normal_of_slope(u.between(-3, 3), u.between(-3, 3));
        const Vec3<double> twin(-m.x, -m.y, m.z);
        const double z = u.next(), phi = u.between(0, 2 * pi), r = std::sqrt(1 - z * z);
        const Vec3<double> o(r * std::cos(phi), r * std::sin(phi), z);
        const double seen = groove.G1(o, m) * std::max(0.0, glm::dot(o, m)) +
                            groove.G1(o, twin) * std::max(0.0, glm::dot(o, twin));
        EXPECT_NEAR(seen, 2 * m.z * o.z, 1e-13);
    }
}

TEST(Microfacets, MaskingIsSymmetricAndBelowBothShares) {
    numeric::Uniform u(7);
    for (const Rough& surface : surfaces({1e-5, 0.03, 0.3, 1.2})) {
        for (int n = 0; n < 2000; ++n) {
            Vec3<double> w[2];
            for (auto& v : w) {
                const double z = u.next() + 1e-6, phi = u.between(0, 2 * pi);
                v = glm::normalize(Vec3<double>(std::cos(phi), std::sin(phi), z / (1.001 - z / 2)));
            }
            const Vec3<double> m = glm::normalize(w[0] + w[1]);
            const double g = surface.microfacets.G2(w[0], w[1], m);
            EXPECT_EQ(g, surface.microfacets.G2(w[1], w[0], m));
            for (const auto& v : w) {
                EXPECT_LE(g, surface.microfacets.G1(v, m) * (1 + 1e-14));
            }
            EXPECT_GE(g, 0);
        }
    }
}

// What both directions see: of a groove the less open wall decides; with Smith's correlated heights
// 1/G2 = 1/G1(o) + 1/G1(i) - 1 (Heitz 2014, eq. 99 over eq. 43).
TEST(Microfacets, JointMaskingFromTheSingleOnes) {
    numeric::Uniform u(11);
    for (const Rough& surface : surfaces({0.03, 0.3, 1.2})) {
        const bool groove = surface.microfacets.masking() == Masking::v_groove;
        for (int n = 0; n < 500; ++n) {
            const auto random = [&] {
                const double z = u.between(0.01, 1), phi = u.between(0, 2 * pi);
                const double r = std::sqrt(1 - z * z);
                return Vec3<double>(r * std::cos(phi), r * std::sin(phi), z);
            };
            const Vec3<double> o = random(), i = random(), m = glm::normalize(o + i);
            const double a = surface.microfacets.G1(o, m), b = surface.microfacets.G1(i, m);
            EXPECT_NEAR(surface.microfacets.G2(o, i, m),
                        groove ? std::min(a, b) : 1 / (1 / a + 1 / b - 1), 1e-13)
                << surface.name;
        }
    }
}

// Smith's closed forms against his integral: Lambda(theta) = (1/cot) int_cot^inf (p - cot) P(p) dp,
// P the distribution of slopes along o (Heitz 2014, eq. 69).
TEST(Microfacets, SmithsLambdaIsHisIntegral) {
    for (const Lobe lobe : {Lobe::beckmann, Lobe::trowbridge_reitz}) {
        for (const double beta : {0.03, 0.3, 1.2}) {
            const Microfacets<double> microfacets(lobe, Masking::smith, beta);
            for (const double degrees : {30.0, 60.0, 80.0, 89.0}) {
                const double theta = degrees * pi / 180, cot = 1 / std::tan(theta);
                const Vec3<double> o(std::sin(theta), 0, std::cos(theta));
                const double lambda =
                    integrate_plane(beta, {cot, infinity}, 24, numeric::no_limit,
                                    [&](double p, double q) {
                                        const Vec3<double> m = normal_of_slope(p, q);
                                        return (p - cot) * microfacets.D(m) * std::pow(m.z, 4);
                                    }) /
                    cot;
                EXPECT_NEAR(microfacets.G1(o, {0, 0, 1}), 1 / (1 + lambda), 1e-9)
                    << lobe_name(lobe) << " " << beta << " " << degrees;
            }
        }
    }
}

// Light that is reflected once is never more than light that came: the integral of the BRDF times
// cos over the directions i above the surface, in slopes a disc (p + tan)^2 + q^2 < sec^2.
TEST(Microfacets, ReflectNoMoreThanArrives) {
    for (const Rough& surface : surfaces(betas)) {
        for (const double degrees : {0.0, 30.0, 60.0, 80.0, 89.0, 89.9}) {
            const double theta = degrees * pi / 180, tan = std::tan(theta),
                         sec = 1 / std::cos(theta);
            const Vec3<double> o(std::sin(theta), 0, std::cos(theta));
            const double kink = tan > 0 ? 1 / tan : infinity;
            // (1 - sin)/cos without cancellation; the far end may be far.
            std::vector<double> breaks = {-tan - sec, -kink, 0, kink, 1 / (tan + sec)};
            std::sort(breaks.begin(), breaks.end());
            breaks.erase(
                std::remove_if(breaks.begin(), breaks.end(),
                               [&](double p) { return p < -tan - sec || p > 1 / (tan + sec); }),
                breaks.end());
            const double albedo = integrate_plane(
                surface.scale, breaks, 8,
                [&](double p) { return std::sqrt(std::max(0.0, 1 - 2 * p * tan - p * p)); },
                [&](double p, double q) {
                    const Vec3<double> m = normal_of_slope(p, q);
                    const double om = glm::dot(o, m);
                    const Vec3<double> i = 2 * om * m - o;
                    return surface.microfacets.evaluate(o, i).value * 4 * om * m.z * m.z * m.z;
                });
            EXPECT_LE(albedo, 1 + 1e-7) << surface.name << " at " << degrees;
            EXPECT_GT(albedo, 0) << surface.name << " at " << degrees;
            if (degrees == 0 && surface.scale <= 0.01) {
                // A Trowbridge-Reitz lobe's tail reaches the horizon however narrow it is.
                EXPECT_NEAR(albedo, 1, 1e-3) << surface.name;
            }
        }
    }
}

}  // namespace
}  // namespace drude
