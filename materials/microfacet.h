// Microfacet lobes: density of facet normals, masking, visible-normal sampling.
//
// Local coordinates: the surface normal is z, m a facet's unit normal, o and i unit directions
// away from the surface; all z > 0. D is normalised: the integral of D(m) m.z over the hemisphere
// is 1. It is computed from tan^2 of m's angle (m.x and m.y), never from m.z, which in float rounds
// to 1 for the narrow lobes of polished metals.
//
// beta: Blinn-Phong (Blinn 1977), Gaussian (Torrance & Sparrow 1967) and Trowbridge-Reitz (1975):
// the half-height angle in radians, D(beta) = D(0)/2. Beckmann (Beckmann & Spizzichino 1963): the
// two-dimensional RMS slope. A value means nothing without its lobe.
//
// Masking: `v_groove` is the cavity of Torrance & Sparrow 1967 (in the form of Cook & Torrance
// 1982); `smith` is Smith's with correlated heights (Heitz 2014, JCGT 3(2), eq. 99), for Beckmann
// and Trowbridge-Reitz, whose slope statistics it needs.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "base/error.h"
#include "materials/lobe.h"
#include "materials/scalar.h"

namespace drude {

template <class T>
using Vec3 = glm::vec<3, T>;

// Lobes narrower than this are mirrors: two arc seconds, below what a float direction resolves.
inline constexpr double mirror_below_beta = 1e-5;
// The widest that is modelled; single scattering loses most of the light long before.
inline constexpr double largest_beta = 1.2;

// ---- beta and the shapes' own parameters
// ---------------------------------------------------------

// Blinn-Phong's exponent of cos: -ln 2 / ln cos(beta), without the cancellation in cos.
template <class T>
T blinn_phong_exponent(const T& beta) {
    using std::log1p;
    using std::sin;
    const T s = sin(beta);
    return T(-2.0 * 0.69314718055994530942) / log1p(-s * s);
}

// c of Trowbridge & Reitz, pbrt's alpha: c^2 = sin^2(beta) / (sqrt 2 - cos^2(beta)). Stays below
// 0.8409 for any beta below 90 degrees.
template <class T>
T trowbridge_reitz_alpha(const T& beta) {
    using std::sin;
    using std::sqrt;
    const T s2 = sin(beta) * sin(beta);
    return sqrt(s2 / (T(1.41421356237309504880 - 1.0) + s2));
}

// The inverse; negative where no beta has this alpha (above 0.8409).
inline double trowbridge_reitz_beta(double alpha) {
    const double c2 = alpha * alpha;
    const double s2 = (std::sqrt(2.0) - 1) * c2 / (1 - c2);
    return s2 >= 0 && s2 < 1 ? std::asin(std::sqrt(s2)) : -1;
}

// ---- density
// -------------------------------------------------------------------------------------

// D of one lobe; T may be double, float or ceres::Jet.
template <class T>
class LobeDensity {
  public:
    LobeDensity() = default;

    LobeDensity(Lobe lobe, const T& beta) : lobe_(lobe) {
        using std::sqrt;
        switch (lobe) {
            case Lobe::blinn_phong:
                width_ = blinn_phong_exponent(beta);
                scale_ = (width_ + T(2.0)) / T(2.0 * pi);
                break;
            case Lobe::gaussian:
                width_ = T(std::sqrt(0.69314718055994530942)) / beta;
                scale_ = T(1.0) / gaussian_norm(width_);
                break;
            case Lobe::beckmann:
                width_ = beta * beta;
                scale_ = T(1.0) / (T(pi) * width_);
                break;
            case Lobe::trowbridge_reitz:
                set_trowbridge_reitz(trowbridge_reitz_alpha(beta));
                break;
        }
    }

    static LobeDensity from_alpha(const T& alpha) {
        LobeDensity density;
        density.lobe_ = Lobe::trowbridge_reitz;
        density.set_trowbridge_reitz(alpha);
        return density;
    }

    Lobe lobe() const { return lobe_; }
    // Blinn-Phong: the exponent; Gaussian: g = sqrt(ln 2)/beta; Beckmann: beta^2;
    // Trowbridge-Reitz: c^2.
    const T& width() const { return width_; }

    // D where tan^2 of the facet's angle is `tan2` >= 0; infinity, i.e. 90 degrees, gives D's limit
    // there (0 for Blinn-Phong and Beckmann).
    T operator()(const T& tan2) const {
        using std::atan;
        using std::exp;
        using std::log1p;
        using std::sqrt;
        switch (lobe_) {
            case Lobe::blinn_phong:
                return scale_ * exp(T(-0.5) * width_ * log1p(tan2));
            case Lobe::gaussian: {
                // A Jet's square root has no derivative at 0, where D has one.
                if (!(tan2 > T(0.0))) return scale_;
                const T x = width_ * atan(sqrt(tan2));
                return scale_ * exp(-x * x);
            }
            case Lobe::beckmann: {
                if (!(tan2 < T(1e18))) return T(0.0);  // 0, and not 0 times infinity
                const T sec2 = T(1.0) + tan2;
                return scale_ * exp(-tan2 / width_) * sec2 * sec2;
            }
            case Lobe::trowbridge_reitz:
                break;
        }
        // c^2 / (cos^2 (c^2 - 1) + 1) with cos^2 = 1/(1 + tan^2) multiplied out, in a form that
        // holds for an infinite tangent.
        const T f = width_ * (T(1.0) + (T(1.0) - width_) / (width_ + tan2));
        return scale_ * f * f;
    }

  private:
    void set_trowbridge_reitz(const T& alpha) {
        width_ = alpha * alpha;
        scale_ = T(1.0) / (T(pi) * width_);
    }

    // 2 pi times the integral of exp(-(g a)^2) cos a sin a over [0, pi/2], by composite 5-point
    // Gauss-Legendre; the tail beyond g a = 7 is below 1e-21 of the whole.
    static T gaussian_norm(const T& g) {
        using std::exp;
        using std::sin;
        const T top = select(T(7.0) / g < T(pi / 2), T(7.0) / g, T(pi / 2));
        T total(0.0);
        constexpr int panels = 64;
        constexpr double node[3] = {0, 0.53846931010568309, 0.90617984593866399};
        constexpr double weight[3] = {0.56888888888888889, 0.47862867049936647,
                                      0.23692688505618909};
        for (int p = 0; p < panels; ++p) {
            for (int j = -2; j <= 2; ++j) {
                const int k = j < 0 ? -j : j;
                const double x = (p + 0.5 + (j < 0 ? -0.5 : 0.5) * node[k]) / panels;
                const T a = top * T(x);
                const T ga = g * a;
                total = total + T(0.5 * weight[k] / panels) * exp(-ga * ga) * sin(T(2.0) * a);
            }
        }
        return T(pi) * top * total;
    }

    Lobe lobe_ = Lobe::trowbridge_reitz;
    T width_{}, scale_{};
};

// ---- the distribution
// ----------------------------------------------------------------------------

namespace microfacet_detail {

// Solves c (1 + erf x)/2 + s exp(-x^2)/(2 sqrt pi) = v for x < c/s: the distribution of visible
// Gaussian slopes seen from the direction of cosine c and sine s (Heitz & d'Eon 2014; s = 0 is the
// plain Gaussian of variance 1/2). Newton's steps kept inside a shrinking bracket.
double solve_visible_slope(double c, double s, double v);

// The inverse of the Gaussian lobe's distribution of angles.
class GaussianAngles {
  public:
    GaussianAngles() = default;
    explicit GaussianAngles(double g);
    // tan of the angle below which a fraction u of D cos lies; u in [0, 1).
    double tangent(double u) const;

  private:
    double density(double x) const;
    double g_ = 1, step_ = 1;
    std::vector<double> cumulative_;
};

}  // namespace microfacet_detail

// A lobe with its masking: what a rough surface of perfect little mirrors does to directions.
// T is float or double.
template <class T>
class Microfacets {
  public:
    // A mirror.
    Microfacets() = default;

    // beta in [0, largest_beta]; below mirror_below_beta a mirror. Throws Error (user) outside,
    // and for Smith masking with a lobe that has none.
    Microfacets(Lobe lobe, Masking masking, double beta) : masking_(masking) {
        if (!(beta >= 0 && beta <= largest_beta)) {
            user_error("beta = {} is outside [0, {}] rad", beta, largest_beta);
        }
        check_masking(lobe, masking);
        if (beta < mirror_below_beta) return;
        set(LobeDensity<double>(lobe, beta), LobeDensity<T>(lobe, static_cast<T>(beta)));
    }

    // Trowbridge-Reitz by pbrt's alpha in [0, 4]; below mirror_below_beta a mirror.
    static Microfacets from_alpha(double alpha, Masking masking) {
        if (!(alpha >= 0 && alpha <= 4)) user_error("alpha = {} is outside [0, 4]", alpha);
        Microfacets result;
        result.masking_ = masking;
        if (alpha >= mirror_below_beta) {
            result.set(LobeDensity<double>::from_alpha(alpha),
                       LobeDensity<T>::from_alpha(static_cast<T>(alpha)));
        }
        return result;
    }

    bool is_mirror() const { return mirror_; }
    Masking masking() const { return masking_; }

    // D(m) in 1/sr.
    T D(const Vec3<T>& m) const { return density_(tan2(m)); }

    // The fraction of facets of normal m that the direction w sees, in [0, 1].
    T G1(const Vec3<T>& w, const Vec3<T>& m) const {
        const T wm = glm::dot(w, m);
        if (!(wm > 0) || !(w.z > 0)) return T(0);
        if (masking_ == Masking::v_groove) return std::min(T(1), 2 * m.z * w.z / wm);
        return 1 / (1 + smith_lambda(w));
    }

    // The fraction that both see.
    T G2(const Vec3<T>& o, const Vec3<T>& i, const Vec3<T>& m) const {
        const T om = glm::dot(o, m), im = glm::dot(i, m);
        if (!(om > 0) || !(im > 0) || !(o.z > 0) || !(i.z > 0)) return T(0);
        if (masking_ == Masking::v_groove) {
            return std::min(T(1), 2 * m.z * std::min(o.z / om, i.z / im));
        }
        return 1 / (1 + (smith_lambda(o) + smith_lambda(i)));
    }

    // The fraction of facets of normal m that o sees from above and i, i.z < 0, from below: Smith's
    // 1/(1 + Lambda(o) + Lambda(i)) as in pbrt-v4, and the product of both sides' G1 for v-grooves,
    // as Walter et al. 2007 (eq. 23) have it. (Facets of random heights seen from opposite sides
    // would be seen by a Beta function of the Lambdas, which is smaller: Heitz et al. 2016.)
    T G2_through(const Vec3<T>& o, const Vec3<T>& i, const Vec3<T>& m) const {
        const Vec3<T> below = -i;
        if (!(glm::dot(o, m) > 0) || !(glm::dot(below, m) > 0) || !(o.z > 0) || !(below.z > 0)) {
            return T(0);
        }
        if (masking_ == Masking::v_groove) return G1(o, m) * G1(below, m);
        return 1 / (1 + (smith_lambda(o) + smith_lambda(below)));
    }

    // The density of m, per solid angle of m, with which sample_visible() chooses it.
    T pdf_visible(const Vec3<T>& o, const Vec3<T>& m) const {
        const T om = glm::dot(o, m);
        if (!(om > 0)) return T(0);
        return G1(o, m) * om * D(m) / o.z;
    }

    // A facet normal that o sees, from uniform numbers in [0, 1).
    Vec3<T> sample_visible(const Vec3<T>& o, T u1, T u2, T u3) const {
        if (masking_ == Masking::v_groove) return sample_groove(o, u1, u2, u3);
        return density_.lobe() == Lobe::beckmann ? sample_smith_beckmann(o, u1, u2)
                                                 : sample_smith_trowbridge_reitz(o, u1, u2);
    }

    // What reflection between o and i is worth, without the facets' own reflectance.
    struct Evaluation {
        Vec3<T> m{0, 0, 1};  // the half vector
        T value = 0;         // BRDF times cos i: D G2 / (4 o.z)
        T pdf = 0;           // of choosing i by sample(), per solid angle of i
    };
    Evaluation evaluate(const Vec3<T>& o, const Vec3<T>& i) const {
        Evaluation e;
        if (mirror_ || !(o.z > 0) || !(i.z > 0)) return e;
        const Vec3<T> sum = o + i;
        const T size2 = glm::dot(sum, sum);
        // Opposite directions along the horizon have no half vector.
        if (!(size2 > std::numeric_limits<T>::min())) return e;
        e.m = sum / std::sqrt(size2);
        const T d = D(e.m);
        e.value = d * G2(o, i, e.m) / (4 * o.z);
        e.pdf = d * G1(o, e.m) / (4 * o.z);
        return e;
    }

    struct Sample {
        Vec3<T> i{0, 0, 1}, m{0, 0, 1};
        T weight = 0;  // value / pdf; 0: the light is lost between the facets
        T pdf = 0;
    };
    // A mirror reflects all, with the pdf 0 that evaluate() gives too.
    Sample sample(const Vec3<T>& o, T u1, T u2, T u3) const {
        Sample s;
        if (!(o.z > 0)) return s;
        if (mirror_) {
            s.i = {-o.x, -o.y, o.z};
            s.weight = 1;
            return s;
        }
        s.m = sample_visible(o, u1, u2, u3);
        const T om = glm::dot(o, s.m);
        if (!(om > 0)) return s;
        s.i = 2 * om * s.m - o;
        if (!(s.i.z > 0)) return s;
        const T g1 = G1(o, s.m);
        if (!(g1 > 0)) return s;  // so close to grazing that it underflows
        s.weight = G2(o, s.i, s.m) / g1;
        s.pdf = D(s.m) * g1 / (4 * o.z);
        return s;
    }

  private:
    static void check_masking(Lobe lobe, Masking masking) {
        if (masking == Masking::smith && lobe != Lobe::beckmann && lobe != Lobe::trowbridge_reitz) {
            user_error("smith masking is known for beckmann and trowbridge-reitz only, not for {}",
                       lobe_name(lobe));
        }
    }

    void set(const LobeDensity<double>& exact, const LobeDensity<T>& density) {
        mirror_ = false;
        density_ = density;
        if (density.lobe() == Lobe::gaussian) {
            angles_ = microfacet_detail::GaussianAngles(exact.width());
        }
    }

    static T tan2(const Vec3<T>& m) { return (m.x * m.x + m.y * m.y) / (m.z * m.z); }

    T smith_lambda(const Vec3<T>& w) const {
        const T tan2_w = tan2(w);
        if (density_.lobe() == Lobe::trowbridge_reitz) {
            return (std::sqrt(1 + density_.width() * tan2_w) - 1) / 2;
        }
        const T a2 = 1 / (density_.width() * tan2_w);
        if (!(a2 < T(64))) return T(0);
        const T a = std::sqrt(a2);
        return std::max(T(0), (std::exp(-a2) / (a * T(1.77245385090551602730)) - std::erfc(a)) / 2);
    }

    // tan of a facet's angle with density D cos.
    T sample_tangent(T u) const {
        const T v = 1 - u;  // in (0, 1]
        switch (density_.lobe()) {
            case Lobe::blinn_phong:
                return std::sqrt(std::expm1(-2 * std::log(v) / (density_.width() + 2)));
            case Lobe::gaussian:
                return static_cast<T>(angles_.tangent(static_cast<double>(u)));
            case Lobe::beckmann:
                return std::sqrt(-density_.width() * std::log(v));
            case Lobe::trowbridge_reitz:
                break;
        }
        return std::sqrt(density_.width() * u / v);
    }

    // A facet by D cos, exchanged for the other wall of its groove in proportion to how much of
    // each o sees (Heitz & d'Eon 2014, EGSR, algorithm 3).
    Vec3<T> sample_groove(const Vec3<T>& o, T u1, T u2, T u3) const {
        const T t = sample_tangent(u1), phi = T(2 * pi) * u2;
        const T z = 1 / std::sqrt(1 + t * t);
        const Vec3<T> m(t * z * std::cos(phi), t * z * std::sin(phi), z);
        const T seen = std::max(T(0), glm::dot(o, m));
        const T twin = std::max(T(0), 2 * o.z * m.z - glm::dot(o, m));
        return u3 * (seen + twin) < seen ? m : Vec3<T>(-m.x, -m.y, m.z);
    }

    // Dupuy & Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps", Listing 3.
    Vec3<T> sample_smith_trowbridge_reitz(const Vec3<T>& o, T u1, T u2) const {
        const T alpha = std::sqrt(density_.width());
        const Vec3<T> w = glm::normalize(Vec3<T>(alpha * o.x, alpha * o.y, o.z));
        const T phi = T(2 * pi) * u1;
        // A point of the cap has z = h_z - w.z and r^2 = 1 - z^2; both are multiplied out, because
        // in float their differences would blur the lobe's long tail.
        const T h_z = (1 - u2) * (1 + w.z);
        const T r = std::sqrt(u2 * (1 + w.z) * std::max(T(0), 1 - w.z + h_z));
        return glm::normalize(
            Vec3<T>(alpha * (r * std::cos(phi) + w.x), alpha * (r * std::sin(phi) + w.y), h_z));
    }

    // Heitz & d'Eon 2014, section 5: stretch to unit roughness, sample the slope along o, then
    // the independent one across it, rotate and stretch back.
    Vec3<T> sample_smith_beckmann(const Vec3<T>& o, T u1, T u2) const {
        const T beta = std::sqrt(density_.width());
        const Vec3<T> w = glm::normalize(Vec3<T>(beta * o.x, beta * o.y, o.z));
        const auto c = static_cast<double>(w.z);
        const double s = std::hypot(static_cast<double>(w.x), static_cast<double>(w.y));
        double along_x = 1, along_y = 0;
        if (s > 0) {
            along_x = static_cast<double>(w.x) / s;
            along_y = static_cast<double>(w.y) / s;
        }
        double total = c;
        if (s > 0) {
            const double a = c / s;
            total = c * (1 + std::erf(a)) / 2 + s * std::exp(-a * a) / 3.54490770181103205460;
        }
        const double x =
            microfacet_detail::solve_visible_slope(c, s, static_cast<double>(u1) * total);
        const double y = microfacet_detail::solve_visible_slope(1, 0, static_cast<double>(u2));
        const T slope_x = static_cast<T>(along_x * x - along_y * y) * beta;
        const T slope_y = static_cast<T>(along_y * x + along_x * y) * beta;
        return glm::normalize(Vec3<T>(-slope_x, -slope_y, T(1)));
    }

    bool mirror_ = true;
    Masking masking_ = Masking::smith;
    LobeDensity<T> density_;
    microfacet_detail::GaussianAngles angles_;
};

}  // namespace drude
