// The rough interface between clear media: sampler against density by chi-square on both sides,
// densities and values against each other, energy, reciprocity, Snell's law.
#include "materials/rough_dielectric.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "materials/numeric.h"

namespace drude {
namespace {

using Vec = Vec3<double>;

struct Case {
    Lobe lobe;
    Masking masking;
    double beta, eta, degrees;

    std::string str() const {
        return fmt::format("{} {} beta {} eta {} at {} degrees", lobe_name(lobe),
                           masking_name(masking), beta, eta, degrees);
    }
    template <class T>
    RoughDielectric<T> surface() const {
        return RoughDielectric<T>(Microfacets<T>(lobe, masking, beta));
    }
    template <class T>
    Vec3<T> view() const {
        const double theta = degrees * degree;
        return glm::normalize(Vec3<T>(Vec(std::sin(theta), 0, std::cos(theta))));
    }
};

std::vector<Case> cases() {
    std::vector<Case> all;
    for (const double eta : {1.5, 1 / 1.5, 2.4, 1.03, 1 / 1.03}) {
        for (const double degrees : {0.0, 35.0, 60.0, 85.0}) {
            for (const double beta : {2e-3, 0.1, 0.5}) {
                all.push_back({Lobe::trowbridge_reitz, Masking::smith, beta, eta, degrees});
            }
            all.push_back({Lobe::beckmann, Masking::smith, 0.3, eta, degrees});
            all.push_back({Lobe::trowbridge_reitz, Masking::v_groove, 0.3, eta, degrees});
        }
    }
    return all;
}

// The two directions that a facet of normal m connects o with, by the law of reflection and by
// Snell's: written with angles, not with the vectors of the class under test. Length 0: none.
Vec mirrored(const Vec& o, const Vec& m) {
    return 2 * glm::dot(o, m) * m - o;
}
Vec refracted(const Vec& o, const Vec& m, double eta) {
    const double theta = std::acos(std::clamp(glm::dot(o, m), -1.0, 1.0));
    const double sine = std::sin(theta) / eta;
    if (!(sine < 1)) return Vec(0.0);
    const Vec across = o - glm::dot(o, m) * m;
    const double size = glm::length(across);
    const double behind = std::asin(sine);
    return -std::cos(behind) * m - (size > 0 ? sine / size : 0.0) * across;
}

// Slopes of facets on a grid whose cells are equal in p/sqrt(p^2 + beta^2).
constexpr int cells = 14;
double edge(int k, double beta) {
    const double a = -1 + 2.0 * k / cells;
    return k == 0 || k == cells ? a * std::numeric_limits<double>::infinity()
                                : beta * a / std::sqrt((1 - a) * (1 + a));
}
int cell_of(const Vec& m, double beta) {
    const auto index = [&](double slope) {
        const double a = slope / std::hypot(slope, beta);
        return std::clamp(static_cast<int>((a + 1) / 2 * cells), 0, cells - 1);
    };
    return index(-m.x / m.z) * cells + index(-m.y / m.z);
}
Vec facet(double p, double q) {
    return glm::normalize(Vec(-p, -q, 1));
}

// pdf(i) d omega_i as a density of the facet's slopes, the area of the directions per slope by
// finite differences: nothing here knows a Jacobian.
double density_in_slopes(const RoughDielectric<double>& surface, const Vec& o, double eta,
                         bool transmitted, double p, double q) {
    const auto direction = [&](double a, double b) {
        const Vec m = facet(a, b);
        return transmitted ? refracted(o, m, eta) : mirrored(o, m);
    };
    const Vec m = facet(p, q);
    if (!(glm::dot(o, m) > 0)) return 0;
    const Vec i = direction(p, q);
    if (!(transmitted ? i.z < 0 : i.z > 0)) return 0;
    const double step = 1e-5 * (1 + std::hypot(p, q));
    const auto slope = [&](double dp, double dq) -> Vec {
        const Vec ahead = direction(p + dp, q + dq), behind = direction(p - dp, q - dq);
        // Beside the critical angle one neighbour has no direction.
        if (!(glm::length(ahead) > 0)) return (i - behind) / step;
        if (!(glm::length(behind) > 0)) return (ahead - i) / step;
        return (ahead - behind) / (2 * step);
    };
    const double area = glm::length(glm::cross(slope(step, 0), slope(0, step)));
    return surface.evaluate(o, i, eta).pdf * area;
}

// Probabilities of the cells: reflections, then transmissions, then what is lost.
std::vector<double> expected(const Case& c) {
    const auto surface = c.surface<double>();
    const Vec o = c.view<double>();
    std::vector<double> result;
    double rest = 1;
    for (const bool transmitted : {false, true}) {
        for (int row = 0; row < cells; ++row) {
            // o is in the plane of x and z: both sides of it are alike.
            double half[cells / 2];
            for (int column = 0; column < cells / 2; ++column) {
                using numeric::line_to_unit, numeric::unit_to_line, numeric::unit_to_line_slope;
                const int panels = c.degrees > 50 || c.beta > 0.2 ? 2 : 1;
                const double mass = numeric::integrate(
                    line_to_unit(edge(row, c.beta), c.beta),
                    line_to_unit(edge(row + 1, c.beta), c.beta), panels, [&](double v) {
                        const double p = unit_to_line(v, c.beta), width = std::hypot(c.beta, p);
                        return unit_to_line_slope(v, c.beta) *
                               numeric::integrate(line_to_unit(edge(column, c.beta), width),
                                                  line_to_unit(edge(column + 1, c.beta), width),
                                                  panels, [&](double w) {
                                                      return unit_to_line_slope(w, width) *
                                                             density_in_slopes(
                                                                 surface, o, c.eta, transmitted, p,
                                                                 unit_to_line(w, width));
                                                  });
                    });
                half[column] = mass;
                rest -= 2 * mass;
            }
            result.insert(result.end(), half, half + cells / 2);
            for (int column = cells / 2 - 1; column >= 0; --column) result.push_back(half[column]);
        }
    }
    EXPECT_GT(rest, -2e-3) << c.str();
    result.push_back(std::max(0.0, rest));
    return result;
}

template <class T>
std::vector<double> counts(const Case& c, int samples, uint64_t seed) {
    const auto surface = c.surface<T>();
    const Vec3<T> o = c.view<T>();
    const T eta = static_cast<T>(c.eta);
    numeric::Uniform u(seed);
    std::vector<double> result(2 * cells * cells + 1, 0.0);
    for (int n = 0; n < samples; ++n) {
        const T u1 = u.next<T>(), u2 = u.next<T>(), u3 = u.next<T>(), u4 = u.next<T>();
        const auto s = surface.sample(o, eta, u1, u2, u3, u4);
        if (s.weight > 0) {
            result[cell_of(Vec(s.m), c.beta) + (s.is_transmitted ? cells * cells : 0)] += 1;
        } else {
            result.back() += 1;
        }
    }
    return result;
}

TEST(RoughDielectric, ChiSquareOfBothSides) {
    constexpr int samples = 50000;
    const std::vector<Case> all = cases();
    const double significance = numeric::sidak(0.01, static_cast<int>(2 * all.size()));
    uint64_t seed = 100;
    for (const Case& c : all) {
        std::vector<double> expectation = expected(c);
        for (double& e : expectation) e *= samples;
        EXPECT_GT(numeric::chi_square_p_value(counts<double>(c, samples, ++seed), expectation),
                  significance)
            << c.str();
        EXPECT_GT(numeric::chi_square_p_value(counts<float>(c, samples, ++seed), expectation),
                  significance)
            << c.str() << " in float";
    }
}

TEST(RoughDielectric, ChiSquareNoticesAnotherIndex) {
    Case c{Lobe::trowbridge_reitz, Masking::smith, 0.1, 1.5, 35};
    const auto observed = counts<double>(c, 50000, 7);
    c.eta = 1.6;
    std::vector<double> wrong = expected(c);
    for (double& e : wrong) e *= 50000;
    EXPECT_LT(numeric::chi_square_p_value(observed, wrong), 1e-6);
}

// Every sample is one that evaluate() knows, worth what it says, and obeys Snell's law.
TEST(RoughDielectric, SamplesAgreeWithEvaluation) {
    numeric::Uniform u(11);
    int through = 0, back = 0;
    for (const Case& c : cases()) {
        const auto surface = c.surface<double>();
        const Vec o = c.view<double>();
        for (int n = 0; n < 500; ++n) {
            const double u1 = u.next(), u2 = u.next(), u3 = u.next(), u4 = u.next();
            const auto s = surface.sample(o, c.eta, u1, u2, u3, u4);
            if (!(s.weight > 0)) continue;
            ++(s.is_transmitted ? through : back);
            const Vec i = s.is_transmitted ? refracted(o, s.m, c.eta) : mirrored(o, s.m);
            ASSERT_LT(glm::length(i - s.i), 1e-7) << c.str();
            const auto e = surface.evaluate(o, s.i, c.eta);
            ASSERT_EQ(e.is_transmitted, s.is_transmitted) << c.str();
            EXPECT_LT(glm::length(e.m - s.m), 1e-7) << c.str();
            EXPECT_NEAR(e.pdf / s.pdf, 1, 1e-5) << c.str();
            EXPECT_NEAR(e.value / e.pdf / s.weight, 1, 1e-9) << c.str();
        }
    }
    EXPECT_GT(through, 10000);
    EXPECT_GT(back, 5000);
}

// Of light of unit radiance L/n^2 from everywhere at most as much comes back, and where facets
// hide little from each other, nearly all: the sum of both sides over all directions.
TEST(RoughDielectric, LosesNoMoreThanItsFacetsHide) {
    numeric::Uniform u(12);
    for (const Case& c : cases()) {
        const auto surface = c.surface<double>();
        const Vec o = c.view<double>();
        double total = 0;
        constexpr int samples = 4000;
        for (int n = 0; n < samples; ++n) {
            const double u1 = u.next(), u2 = u.next(), u3 = u.next(), u4 = u.next();
            const auto s = surface.sample(o, c.eta, u1, u2, u3, u4);
            if (!(s.weight > 0)) continue;
            const auto divided = divide_at_interface(c.eta, glm::dot(o, s.m));
            const double share =
                s.is_transmitted ? divided.transmitted.A() * c.eta * c.eta : divided.reflected.A();
            const double worth = s.weight * share;
            EXPECT_LE(worth, 1 + 1e-9) << c.str();
            total += worth;
        }
        EXPECT_LE(total / samples, 1 + 1e-9) << c.str();
        if (c.beta < 0.01 && c.degrees < 80) {
            EXPECT_GT(total / samples, 0.99) << c.str();
        }
    }
}

// f(o, i) / n_o^2 = f(i, o) / n_i^2, each seen from its own side.
TEST(RoughDielectric, IsReciprocal) {
    numeric::Uniform u(13);
    const auto flipped = [](const Vec& v) { return Vec(v.x, v.y, -v.z); };
    int checked = 0;
    for (const Case& c : cases()) {
        const auto surface = c.surface<double>();
        for (int n = 0; n < 200; ++n) {
            const double z = u.between(0.05, 1), z_i = u.between(-1, 1), turn = u.between(0, 6.28);
            const Vec o(std::sqrt(1 - z * z), 0, z);
            const double r = std::sqrt(1 - z_i * z_i);
            const Vec i(r * std::cos(turn), r * std::sin(turn), z_i);
            const auto there = surface.evaluate(o, i, c.eta);
            const auto back = i.z > 0 ? surface.evaluate(i, o, c.eta)
                                      : surface.evaluate(flipped(i), flipped(o), 1 / c.eta);
            const double scale = i.z > 0 ? 1 : c.eta * c.eta;
            const double a = there.value / std::abs(i.z), b = back.value / std::abs(o.z) / scale;
            EXPECT_NEAR(a, b, 1e-9 * (a + b)) << c.str();
            checked += a > 0;
        }
    }
    EXPECT_GT(checked, 1000);
}

TEST(RoughDielectric, SmoothOnesFollowSnell) {
    const RoughDielectric<double> smooth;
    const Vec o = glm::normalize(Vec(0.3, -0.4, 0.6));
    EXPECT_TRUE(smooth.is_smooth(1.5));
    EXPECT_EQ(smooth.evaluate(o, Vec(-o.x, -o.y, o.z), 1.5).value, 0);
    const double R = interface_reflectance(1.5, o.z);
    const auto back = smooth.sample(o, 1.5, 0.1, 0.2, 0.3, 0.99 * R);
    EXPECT_FALSE(back.is_transmitted);
    EXPECT_NEAR(back.weight * R, 1, 1e-12);
    EXPECT_LT(glm::length(back.i - Vec(-o.x, -o.y, o.z)), 1e-15);
    const auto through = smooth.sample(o, 1.5, 0.1, 0.2, 0.3, 1.01 * R);
    EXPECT_TRUE(through.is_transmitted);
    EXPECT_EQ(through.pdf, 0);
    EXPECT_NEAR(through.weight * (1 - R) * 1.5 * 1.5, 1, 1e-12);
    EXPECT_LT(glm::length(through.i - refracted(o, Vec(0, 0, 1), 1.5)), 1e-14);
    // Beyond the critical angle there is only reflection.
    const Vec flat = glm::normalize(Vec(0.9, 0, 0.3));
    EXPECT_FALSE(smooth.sample(flat, 1 / 1.5, 0.1, 0.2, 0.3, 0.999999).is_transmitted);
    // Where the index is matched even a rough one does not bend light.
    const RoughDielectric<float> rough(Microfacets<float>::from_alpha(0.3, Masking::smith));
    const auto straight = rough.sample(Vec3<float>(o), 1.0f, 0.5f, 0.2f, 0.3f, 0.5f);
    EXPECT_TRUE(straight.is_transmitted);
    EXPECT_LT(glm::length(straight.i + Vec3<float>(o)), 1e-6f);
    EXPECT_NEAR(straight.weight, 1, 1e-6);
}

}  // namespace
}  // namespace drude
