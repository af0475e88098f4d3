// Quadrature, chi-square statistics and uniform numbers for the tests of this room.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "materials/quadrature.h"
#include "materials/scalar.h"

namespace drude::numeric {

// ---- quadrature
// ----------------------------------------------------------------------------------

// The integral of f over [a, b] in equal panels of 16 nodes.
template <class F>
double integrate(double a, double b, int panels, const F& f) {
    static const QuadratureRule rule = gauss_legendre(16);
    double total = 0;
    for (int p = 0; p < panels; ++p) {
        const double half = (b - a) / (2 * panels), middle = a + (2 * p + 1) * half;
        for (size_t j = 0; j < rule.x.size(); ++j) {
            total += half * rule.weight[j] * f(middle + half * rule.x[j]);
        }
    }
    return total;
}

// p = scale v / (1 - |v|) takes (-1, 1) to the whole line with resolution where |p| is some scale.
inline double line_to_unit(double p, double scale) {
    return std::isinf(p) ? (p > 0 ? 1.0 : -1.0) : p / (scale + std::abs(p));
}
inline double unit_to_line(double v, double scale) {
    return scale * v / (1 - std::abs(v));
}
inline double unit_to_line_slope(double v, double scale) {
    return scale / ((1 - std::abs(v)) * (1 - std::abs(v)));
}

// The integral of f(p, q) dp dq, f even in q, over breaks.front() < p < breaks.back() (both may be
// infinite) and |q| < q_limit(p) (may be infinite). `breaks` are ascending and hold every p where f
// has a kink. f varies on the scale `scale` about the origin.
template <class Limit, class F>
double integrate_plane(double scale, const std::vector<double>& breaks, int panels,
                       const Limit& q_limit, const F& f) {
    double total = 0;
    for (size_t i = 0; i + 1 < breaks.size(); ++i) {
        if (!(breaks[i] < breaks[i + 1])) continue;
        total += integrate(
            line_to_unit(breaks[i], scale), line_to_unit(breaks[i + 1], scale), panels,
            [&](double v) {
                const double p = unit_to_line(v, scale), width = std::hypot(scale, p);
                const double top = line_to_unit(q_limit(p), width);
                return 2 * unit_to_line_slope(v, scale) * integrate(0, top, panels, [&](double w) {
                           return unit_to_line_slope(w, width) * f(p, unit_to_line(w, width));
                       });
            });
    }
    return total;
}

inline double no_limit(double) {
    return std::numeric_limits<double>::infinity();
}

// ---- special functions
// ---------------------------------------------------------------------------

// The regularised incomplete gamma function Q(a, x): the power series of P below x = a + 1 (DLMF
// 8.11.4), the continued fraction 8.9.2 above it by Lentz's method.
inline double gamma_q(double a, double x) {
    if (!(a > 0) || !(x >= 0)) throw std::invalid_argument("gamma_q");
    if (x == 0) return 1;
    const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
    if (x < a + 1) {
        double term = 1 / a, sum = term;
        for (double k = a + 1; term > sum * 1e-16; ++k) sum += term *= x / k;
        return 1 - front * sum;
    }
    double b = x + 1 - a, c = 1e300, d = 1 / b, fraction = d;
    for (int k = 1; k < 10000; ++k) {
        const double numerator = -k * (k - a);
        b += 2;
        d = 1 / (numerator * d + b);
        c = b + numerator / c;
        fraction *= c * d;
        if (std::abs(c * d - 1) < 1e-15) break;
    }
    return front * fraction;
}

// erf of a complex number, to about 1e-15 of its size (Abramowitz & Stegun 1964, 7.1.29).
inline std::complex<double> erf(const std::complex<double>& z) {
    const double x = z.real(), y = z.imag(), e = std::exp(-x * x);
    const double cos2 = std::cos(2 * x * y), sin2 = std::sin(2 * x * y);
    std::complex<double> result(std::erf(x));
    result += x == 0 ? std::complex<double>(0, y / pi)
                     : e / (2 * pi * x) * std::complex<double>(1 - cos2, sin2);
    for (int n = 1; n < 40; ++n) {
        const double ch = std::cosh(n * y), sh = std::sinh(n * y);
        result += 2 / pi * e * std::exp(-0.25 * n * n) / (n * n + 4 * x * x) *
                  std::complex<double>(2 * x - 2 * x * ch * cos2 + n * sh * sin2,
                                       2 * x * ch * sin2 + n * sh * cos2);
    }
    return result;
}

// ---- chi-square
// ----------------------------------------------------------------------------------

// Pearson's test of counts against expected counts (same total). Cells that expect fewer than 8 are
// pooled, and the pool, where it expects fewer than 8 too, joins the poorest cell that remains.
// Returns the probability of a worse fit by chance.
inline double chi_square_p_value(const std::vector<double>& observed,
                                 const std::vector<double>& expected) {
    constexpr double least = 8;
    double pool_observed = 0, pool_expected = 0;
    std::vector<std::pair<double, double>> cells;  // expected, observed
    for (size_t i = 0; i < observed.size(); ++i) {
        if (expected[i] < least) {
            pool_expected += expected[i];
            pool_observed += observed[i];
        } else {
            cells.emplace_back(expected[i], observed[i]);
        }
    }
    if (cells.size() < 4) throw std::invalid_argument("too few cells for a chi-square test");
    if (pool_expected >= least) {
        cells.emplace_back(pool_expected, pool_observed);
    } else {
        auto& poorest = *std::min_element(cells.begin(), cells.end());
        poorest.first += pool_expected;
        poorest.second += pool_observed;
    }
    double statistic = 0;
    for (const auto& [e, o] : cells) statistic += (o - e) * (o - e) / e;
    return gamma_q(0.5 * static_cast<double>(cells.size() - 1), 0.5 * statistic);
}

// The significance of each of `tests` independent tests that together err with probability alpha
// (Sidak 1967).
inline double sidak(double alpha, int tests) {
    return -std::expm1(std::log1p(-alpha) / tests);
}

// ---- uniform numbers
// -----------------------------------------------------------------------------

// The same numbers with every standard library: std::uniform_real_distribution promises none.
class Uniform {
  public:
    explicit Uniform(uint64_t seed) : engine_(seed) {}
    // In [0, 1), on T's own grid.
    template <class T = double>
    T next() {
        constexpr int digits = std::numeric_limits<T>::digits;
        return static_cast<T>(engine_() >> (64 - digits)) / static_cast<T>(uint64_t{1} << digits);
    }
    double between(double a, double b) { return a + (b - a) * next(); }
    // A whole number below n.
    size_t below(size_t n) { return static_cast<size_t>(next() * static_cast<double>(n)); }

  private:
    std::mt19937_64 engine_;
};

}  // namespace drude::numeric
