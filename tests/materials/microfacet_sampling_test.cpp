// Samplers of the lobes against their own densities: chi-square over the slopes of the half vector,
// which resolves a lobe of any width, and Monte Carlo means against quadrature.
#include <gtest/gtest.h>

#include "materials/microfacet.h"
#include "materials/numeric.h"

namespace drude {
namespace {

struct Case {
    Lobe lobe;
    Masking masking;
    double beta, degrees;

    std::string str() const {
        return fmt::format("{} {} beta {} at {} degrees", lobe_name(lobe), masking_name(masking),
                           beta, degrees);
    }
};

std::vector<Case> cases(const std::vector<double>& betas, const std::vector<double>& degrees) {
    std::vector<Case> all;
    for (const Lobe lobe :
         {Lobe::blinn_phong, Lobe::gaussian, Lobe::beckmann, Lobe::trowbridge_reitz}) {
        for (const Masking masking : {Masking::v_groove, Masking::smith}) {
            if (masking == Masking::smith && lobe != Lobe::beckmann &&
                lobe != Lobe::trowbridge_reitz) {
                continue;
            }
            for (const double beta : betas) {
                for (const double angle : degrees) all.push_back({lobe, masking, beta, angle});
            }
        }
    }
    return all;
}

// The view from o: slopes p along its azimuth, q across. Their cells are equal in
// p/sqrt(p^2+beta^2).
class View {
  public:
    static constexpr int cells = 20;

    View(const Vec3<double>& o, double beta) : o_(o), beta_(beta) {
        const double sine = std::hypot(o.x, o.y);
        along_ = sine > 1e-4 ? Vec3<double>(o.x / sine, o.y / sine, 0) : Vec3<double>(1, 0, 0);
        across_ = {-along_.y, along_.x, 0};
        tan_ = sine > 1e-4 ? sine / o.z : 0;
    }

    // Index of the cell of the facet normal h.
    int cell(const Vec3<double>& h) const {
        const auto index = [&](double slope) {
            const double a = slope / std::hypot(slope, beta_);
            return std::clamp(static_cast<int>((a + 1) / 2 * cells), 0, cells - 1);
        };
        return index(-glm::dot(h, along_) / h.z) * cells + index(-glm::dot(h, across_) / h.z);
    }

    // For each cell the probability that sample() reflects into it, from a density per solid angle
    // of i; the last number is the rest, light lost below the horizon. In slopes the directions
    // above the horizon fill the disc (p + tan)^2 + q^2 < sec^2.
    template <class Pdf>
    std::vector<double> probabilities(const Pdf& pdf_of_i) const {
        std::vector<double> result(cells * cells);
        double rest = 1;
        for (int row = 0; row < cells; ++row) {
            for (int column = cells / 2; column < cells; ++column) {
                const double mass = mass_between(edge(row), edge(row + 1), edge(column),
                                                 edge(column + 1), pdf_of_i);
                // Both sides of o's azimuth are alike.
                result[row * cells + column] = result[(row + 1) * cells - 1 - column] = mass;
                rest -= 2 * mass;
            }
        }
        result.push_back(std::max(0.0, rest));
        return result;
    }

    double tan() const { return tan_; }
    const Vec3<double>& o() const { return o_; }

    // A density per solid angle of i as one per p and q: d omega_i = 4 (o.m) d omega_m.
    template <class Pdf>
    double density(double p, double q, const Pdf& pdf_of_i) const {
        const Vec3<double> m = glm::normalize(-p * along_ - q * across_ + Vec3<double>(0, 0, 1));
        const double om = glm::dot(o_, m);
        if (!(om > 0)) return 0;
        return pdf_of_i(Vec3<double>(2 * om * m - o_)) * 4 * om * m.z * m.z * m.z;
    }

  private:
    // The slope at the lower edge of cell k, infinite at both ends.
    double edge(int k) const {
        const double a = -1 + 2.0 * k / cells;
        return k == 0 || k == cells ? a * std::numeric_limits<double>::infinity()
                                    : beta_ * a / std::sqrt((1 - a) * (1 + a));
    }

    template <class Pdf>
    double mass_between(double p0, double p1, double q0, double q1, const Pdf& pdf_of_i) const {
        using numeric::line_to_unit, numeric::unit_to_line, numeric::unit_to_line_slope;
        // Seen from close to grazing the disc begins and ends within a cell.
        const double edge_of_disc = tan_ + std::hypot(1.0, tan_);
        p0 = std::max(p0, -edge_of_disc);
        const int panels = p1 < 1 / edge_of_disc ? (tan_ > 5 ? 2 : 1) : 8;
        p1 = std::min(p1, 1 / edge_of_disc);
        if (!(p0 < p1)) return 0;
        return numeric::integrate(
            line_to_unit(p0, beta_), line_to_unit(p1, beta_), panels, [&](double v) {
                const double p = unit_to_line(v, beta_), width = std::hypot(beta_, p);
                const double limit = std::sqrt(std::max(0.0, 1 - 2 * p * tan_ - p * p));
                const double low = std::max(q0, -limit), high = std::min(q1, limit);
                if (!(low < high)) return 0.0;
                return unit_to_line_slope(v, beta_) *
                       numeric::integrate(line_to_unit(low, width), line_to_unit(high, width), 1,
                                          [&](double w) {
                                              return unit_to_line_slope(w, width) *
                                                     density(p, unit_to_line(w, width), pdf_of_i);
                                          });
            });
    }

    Vec3<double> o_, along_, across_;
    double beta_, tan_;
};

template <class T>
Vec3<T> direction(double degrees, double azimuth) {
    const double theta = degrees * pi / 180;
    return glm::normalize(
        Vec3<T>(Vec3<double>(std::sin(theta) * std::cos(azimuth),
                             std::sin(theta) * std::sin(azimuth), std::cos(theta))));
}

// Counts of `samples` reflections in the cells of `view`.
template <class T>
std::vector<double> counts(const Microfacets<T>& microfacets, const Vec3<T>& o, const View& view,
                           int samples, uint64_t seed) {
    numeric::Uniform u(seed);
    std::vector<double> result(View::cells * View::cells + 1, 0.0);
    for (int n = 0; n < samples; ++n) {
        const T u1 = u.next<T>(), u2 = u.next<T>(), u3 = u.next<T>();
        const auto s = microfacets.sample(o, u1, u2, u3);
        if (s.i.z > 0) {
            const auto h = glm::normalize(Vec3<double>(o) + Vec3<double>(s.i));
            result[view.cell(h)] += 1;
        } else {
            result.back() += 1;
        }
    }
    return result;
}

template <class Pdf>
std::vector<double> expected_counts(const View& view, int samples, const Pdf& pdf) {
    std::vector<double> expected = view.probabilities(pdf);
    for (double& e : expected) e *= samples;
    return expected;
}

constexpr int samples = 100000;
constexpr double azimuth = 0.7;

// The density is always the double one, integrated over each cell; float samplers must meet it too.
// Closer to grazing a float direction no longer resolves a facet of the narrowest lobe.
const std::vector<Case> common_cases = cases({1e-3, 0.03, 0.3, 1.2}, {0, 30, 60, 85, 89.9});
const std::vector<Case> narrowest_in_double = cases({1e-5}, {0, 30, 60, 85, 89.9});
const std::vector<Case> narrowest_in_float = cases({1e-5}, {0, 30, 60});

template <class T>
void chi_square_of_all(const std::vector<Case>& all, uint64_t seed) {
    const double significance =
        numeric::sidak(0.01, static_cast<int>(2 * common_cases.size() + narrowest_in_double.size() +
                                              narrowest_in_float.size()));
    for (const Case& c : all) {
        const Microfacets<double> exact(c.lobe, c.masking, c.beta);
        const Microfacets<T> tested(c.lobe, c.masking, c.beta);
        const Vec3<T> o = direction<T>(c.degrees, azimuth);
        const Vec3<double> o_exact = glm::normalize(Vec3<double>(o));
        const View view(o_exact, c.beta);
        const auto expected = expected_counts(
            view, samples, [&](const Vec3<double>& i) { return exact.evaluate(o_exact, i).pdf; });
        const auto observed = counts(tested, o, view, samples, ++seed);
        EXPECT_GT(numeric::chi_square_p_value(observed, expected), significance) << c.str();
    }
}

TEST(MicrofacetSampling, ChiSquareInDouble) {
    chi_square_of_all<double>(common_cases, 1000);
    chi_square_of_all<double>(narrowest_in_double, 2000);
}

TEST(MicrofacetSampling, ChiSquareInFloat) {
    chi_square_of_all<float>(common_cases, 3000);
    chi_square_of_all<float>(narrowest_in_float, 4000);
}

// The test must notice what it is there for.
TEST(MicrofacetSampling, ChiSquareRejectsWrongDensities) {
    for (const Case& c : cases({1e-3, 0.3}, {60})) {
        const Microfacets<double> right(c.lobe, c.masking, c.beta);
        const Microfacets<double> wider(c.lobe, c.masking, c.beta * 1.05);
        const Vec3<double> o = direction<double>(c.degrees, azimuth);
        const View view(o, c.beta);
        const auto observed = counts(right, o, view, samples, 5);
        const auto p_value = [&](const auto& pdf) {
            return numeric::chi_square_p_value(observed, expected_counts(view, samples, pdf));
        };
        EXPECT_LT(p_value([&](const Vec3<double>& i) { return wider.evaluate(o, i).pdf; }), 1e-6)
            << c.str();
        // Sampling D cos instead of the visible normals; the same thing where nothing is hidden.
        if (c.beta > 0.1) {
            EXPECT_LT(p_value([&](const Vec3<double>& i) {
                          const Vec3<double> m = glm::normalize(o + i);
                          return right.D(m) * m.z / (4 * glm::dot(o, m));
                      }),
                      1e-6)
                << c.str();
        }
    }
}

TEST(MicrofacetSampling, SmithsOwnLobeIsNotTheGroove) {
    const Vec3<double> o = direction<double>(70, azimuth);
    const Microfacets<double> smith(Lobe::beckmann, Masking::smith, 0.5);
    const Microfacets<double> groove(Lobe::beckmann, Masking::v_groove, 0.5);
    const View view(o, 0.5);
    EXPECT_LT(numeric::chi_square_p_value(counts(smith, o, view, samples, 6),
                                          expected_counts(view, samples,
                                                          [&](const Vec3<double>& i) {
                                                              return groove.evaluate(o, i).pdf;
                                                          })),
              1e-6);
}

// The statistics that all of this rests on.
TEST(ChiSquare, KnownProbabilities) {
    EXPECT_NEAR(numeric::gamma_q(0.5, 0.5 * 3.841458820694124), 0.05, 1e-12);
    EXPECT_NEAR(numeric::gamma_q(5, 0.5 * 23.209251158954356), 0.01, 1e-12);
    EXPECT_NEAR(numeric::gamma_q(1, 2.5), std::exp(-2.5), 1e-14);
    EXPECT_NEAR(numeric::gamma_q(50, 0.5 * 77.92946516501726), 0.95, 1e-9);
    EXPECT_NEAR(numeric::sidak(0.01, 1), 0.01, 1e-15);
    EXPECT_NEAR(1 - std::pow(1 - numeric::sidak(0.01, 250), 250), 0.01, 1e-12);
}

// Of uniform counts 5 % are rejected at the 5 % level.
TEST(ChiSquare, IsCalibrated) {
    numeric::Uniform u(8);
    int rejected = 0;
    constexpr int trials = 2000, boxes = 50, draws = 2000;
    for (int t = 0; t < trials; ++t) {
        std::vector<double> observed(boxes, 0.0);
        const std::vector<double> expected(boxes, static_cast<double>(draws) / boxes);
        for (int n = 0; n < draws; ++n) observed[static_cast<size_t>(u.next() * boxes)] += 1;
        rejected += numeric::chi_square_p_value(observed, expected) < 0.05;
    }
    EXPECT_NEAR(static_cast<double>(rejected) / trials, 0.05, 4 * std::sqrt(0.05 * 0.95 / trials));
}

// ---- weights
// -------------------------------------------------------------------------------------

template <class T>
void weights_are_value_over_pdf(double least_beta, double tolerance) {
    numeric::Uniform u(9);
    for (const Case& c : cases({least_beta, 0.01, 0.1, 0.5, 1.2}, {0})) {
        const Microfacets<T> microfacets(c.lobe, c.masking, c.beta);
        for (int n = 0; n < 3000; ++n) {
            const Vec3<T> o = direction<T>(u.between(0, 89), u.between(0, 2 * pi));
            const auto s = microfacets.sample(o, u.next<T>(), u.next<T>(), u.next<T>());
            ASSERT_TRUE(std::isfinite(s.weight) && std::isfinite(s.pdf)) << c.str();
            EXPECT_GE(s.weight, 0);
            EXPECT_LE(s.weight, 1 + 4 * std::numeric_limits<T>::epsilon()) << c.str();
            if (!(s.weight > 0)) continue;
            EXPECT_NEAR(glm::dot(s.i, s.i), 1, 16 * std::numeric_limits<T>::epsilon());
            EXPECT_NEAR(s.pdf * 4 * glm::dot(o, s.m), microfacets.pdf_visible(o, s.m),
                        1e-5 * static_cast<double>(microfacets.pdf_visible(o, s.m)));
            const auto e = microfacets.evaluate(o, s.i);
            if (!(e.pdf > 0)) continue;  // far in a tail that underflows
            // evaluate() has to find the facet again; its rounding tells most in the weight's kinks
            // and in the tails of the narrowest lobe.
            EXPECT_NEAR(e.value / e.pdf, s.weight, tolerance) << c.str();
            const T tail = -std::log(microfacets.D(s.m) / microfacets.D({0, 0, 1}));
            if (tail < 15) {
                EXPECT_NEAR(e.pdf / s.pdf, 1, 100 * tolerance / std::min(1.0, c.beta / 0.01))
                    << c.str();
            }
        }
    }
}
TEST(MicrofacetSampling, WeightsAreValueOverPdfInDouble) {
    weights_are_value_over_pdf<double>(1e-5, 1e-10);
}
TEST(MicrofacetSampling, WeightsAreValueOverPdfInFloat) {
    weights_are_value_over_pdf<float>(1e-3, 2e-4);
}

// Every corner of the unit cube of random numbers, from the normal to where floats underflow.
template <class T>
void nothing_breaks_at_the_edges() {
    const T last = 1 - std::numeric_limits<T>::epsilon() / 2;
    const T numbers[] = {0, std::numeric_limits<T>::min(), T(1e-7), T(0.25), T(0.5), last};
    for (const Case& c : cases({1e-5, 1e-3, 0.3, 1.2}, {0})) {
        const Microfacets<T> microfacets(c.lobe, c.masking, c.beta);
        for (const T z : {T(1), T(0.5), T(1e-3), T(1e-8), T(1e-20), T(1e-30), T(1e-37)}) {
            const Vec3<T> o = z == 1 ? Vec3<T>(0, 0, 1) : Vec3<T>(std::sqrt(1 - z * z), 0, z);
            for (const T u1 : numbers) {
                for (const T u2 : numbers) {
                    for (const T u3 : numbers) {
                        const auto s = microfacets.sample(o, u1, u2, u3);
                        const auto text = [&] {
                            return fmt::format("{}: o.z {} u {} {} {}", c.str(), z, u1, u2, u3);
                        };
                        ASSERT_TRUE(s.weight >= 0 && s.weight <= 1 + T(1e-5)) << text();
                        ASSERT_FALSE(std::isnan(s.pdf) || s.pdf < 0) << text();
                        ASSERT_NEAR(glm::length(s.m), 1, 1e-5) << text();
                        if (!(s.i.z > 0)) continue;
                        const auto e = microfacets.evaluate(o, s.i);
                        ASSERT_FALSE(std::isnan(e.value) || e.value < 0) << text();
                        ASSERT_FALSE(std::isnan(e.pdf) || e.pdf < 0) << text();
                    }
                }
            }
        }
    }
}
TEST(MicrofacetSampling, NothingBreaksAtTheEdgesInDouble) {
    nothing_breaks_at_the_edges<double>();
}
TEST(MicrofacetSampling, NothingBreaksAtTheEdgesInFloat) {
    nothing_breaks_at_the_edges<float>();
}

// The Gaussian lobe's table of angles, against its distribution function: also close to both ends,
// where the density falls to 0.
TEST(MicrofacetSampling, GaussianAnglesInvertTheDistribution) {
    for (const double beta : {1e-3, 0.1, 0.5, 1.2}) {
        const double g = std::sqrt(std::log(2.0)) / beta;
        const microfacet_detail::GaussianAngles angles(g);
        const auto mass = [&](double a, double b) {
            return numeric::integrate(
                a, b, 40, [&](double x) { return std::exp(-g * g * x * x) * std::sin(2 * x); });
        };
        const double end = std::min(pi / 2, 7 / g), total = mass(0, end);
        for (const double u : {1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 0.1, 0.5, 0.9}) {
            EXPECT_NEAR(mass(0, std::atan(angles.tangent(u))) / total / u, 1, 1e-8)
                << beta << " " << u;
            const double a = std::atan(angles.tangent(1 - u));
            EXPECT_NEAR(mass(a, end) / total / u, 1, 1e-5) << beta << " from above " << u;
        }
    }
}

TEST(MicrofacetSampling, VisibleSlopesInvertTheDistribution) {
    numeric::Uniform u(10);
    for (int n = 0; n < 20000; ++n) {
        const double theta = u.between(0, pi / 2), c = std::cos(theta), s = std::sin(theta);
        const auto mass = [&](double x) {
            return c * (1 + std::erf(x)) / 2 + s * std::exp(-x * x) / (2 * std::sqrt(pi));
        };
        const double total = mass(c / s), v = u.next() * total;
        const double x = microfacet_detail::solve_visible_slope(c, s, v);
        EXPECT_LE(x, c / s * (1 + 1e-12));
        EXPECT_NEAR(mass(x), v, 1e-13 + 1e-11 * total) << theta << " " << v;
    }
}

// ---- albedo
// --------------------------------------------------------------------------------------

// The mean weight is the directional albedo: the same number by quadrature of the BRDF times cos.
TEST(MicrofacetSampling, MeanWeightIsTheAlbedo) {
    uint64_t seed = 500;
    for (const Case& c : cases({1e-4, 0.03, 0.3, 1.0}, {0, 45, 75, 88})) {
        const Microfacets<double> microfacets(c.lobe, c.masking, c.beta);
        const Vec3<double> o = direction<double>(c.degrees, azimuth);
        const View view(o, c.beta);
        const double sec = std::hypot(1.0, view.tan());
        const double albedo = numeric::integrate_plane(
            c.beta, {-view.tan() - sec, 0, 1 / (view.tan() + sec)}, 8,
            [&](double p) { return std::sqrt(std::max(0.0, 1 - 2 * p * view.tan() - p * p)); },
            [&](double p, double q) {
                return view.density(
                    p, q, [&](const Vec3<double>& i) { return microfacets.evaluate(o, i).value; });
            });
        numeric::Uniform u(++seed);
        double sum = 0, squares = 0;
        for (int n = 0; n < samples; ++n) {
            const double u1 = u.next(), u2 = u.next(), u3 = u.next();
            const double w = microfacets.sample(o, u1, u2, u3).weight;
            sum += w;
            squares += w * w;
        }
        const double mean = sum / samples;
        const double deviation =
            std::sqrt(std::max(0.0, squares / samples - mean * mean) / samples);
        EXPECT_NEAR(mean, albedo, 4.5 * deviation + 2e-5) << c.str();
        EXPECT_LE(albedo, 1 + 1e-6) << c.str();
    }
}

}  // namespace
}  // namespace drude
