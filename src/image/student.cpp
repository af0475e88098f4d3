#include "image/student.h"

#include <math.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace drude {

namespace {

// std::lgamma writes a global sign; this one may run in many threads.
double log_gamma(double x) {
    int sign = 0;
    return lgamma_r(x, &sign);
}

// The continued fraction of DLMF 8.17.22, quickly convergent for x < (a + 1)/(a + b + 2).
double beta_fraction(double a, double b, double x) {
    constexpr double tiny = 1e-300;
    constexpr int most_terms = 20000;
    const auto not_zero = [](double value) { return std::abs(value) < tiny ? tiny : value; };
    double c = 1.0;
    double d = 1.0 / not_zero(1.0 - (a + b) * x / (a + 1.0));
    double fraction = d;
    for (int m = 1; m <= most_terms; ++m) {
        const double k = m;
        const double even = k * (b - k) * x / ((a + 2.0 * k - 1.0) * (a + 2.0 * k));
        d = 1.0 / not_zero(1.0 + even * d);
        c = not_zero(1.0 + even / c);
        fraction *= d * c;
        const double odd = -(a + k) * (a + b + k) * x / ((a + 2.0 * k) * (a + 2.0 * k + 1.0));
        d = 1.0 / not_zero(1.0 + odd * d);
        c = not_zero(1.0 + odd / c);
        const double step = d * c;
        fraction *= step;
        if (std::abs(step - 1.0) < 1e-15) break;
    }
    return fraction;
}

// I_x(a, b) with y = 1 - x given by itself, so that neither end loses digits.
double incomplete_beta_with(double a, double b, double x, double y) {
    if (x <= 0.0) return 0.0;
    if (y <= 0.0) return 1.0;
    const double front = std::exp(log_gamma(a + b) - log_gamma(a) - log_gamma(b) + a * std::log(x) +
                                  b * std::log(y));
    if (x < (a + 1.0) / (a + b + 2.0)) return front * beta_fraction(a, b, x) / a;
    return 1.0 - front * beta_fraction(b, a, y) / b;
}

}  // namespace

double incomplete_beta(double a, double b, double x) {
    if (!(a > 0.0) || !(b > 0.0) || !(x >= 0.0) || !(x <= 1.0)) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    return incomplete_beta_with(a, b, x, 1.0 - x);
}

double student_two_sided(double t, double degrees) {
    if (std::isnan(t) || !(degrees > 0.0)) return std::numeric_limits<double>::quiet_NaN();
    t = std::abs(t);
    if (std::isinf(t)) return 0.0;
    if (degrees > 1e5) return std::erfc(t / std::numbers::sqrt2);
    const double sum = degrees + t * t;
    return incomplete_beta_with(degrees / 2.0, 0.5, degrees / sum, t * t / sum);
}

double student_quantile(double p, double degrees) {
    if (!(p > 0.0) || !(p <= 1.0) || !(degrees > 0.0)) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    double low = 0.0, high = 1.0;
    while (student_two_sided(high, degrees) > p && high < 1e300) high *= 2.0;
    // The probability falls monotonically, so halving ends at the double nearest to the root.
    for (int i = 0; i < 200; ++i) {
        const double middle = low + (high - low) / 2.0;
        if (middle <= low || middle >= high) break;
        (student_two_sided(middle, degrees) > p ? low : high) = middle;
    }
    return low + (high - low) / 2.0;
}

double sidak_family(double p, double tests) {
    if (p >= 1.0) return 1.0;
    return -std::expm1(tests * std::log1p(-p));
}

double sidak_each(double alpha, double tests) {
    return -std::expm1(std::log1p(-alpha) / tests);
}

}  // namespace drude
