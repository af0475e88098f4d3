#include "fitter/inversion.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace drude {

namespace {

using Complex64 = std::complex<double>;

// Inverse-variance weighted mean with its standard deviation, and the plain scatter.
struct Mean {
    double value = 0, sigma = 0, spread = 0;
};

Mean weighted_mean(const std::vector<double>& values, const std::vector<double>& sigmas) {
    double weights = 0, sum = 0, plain = 0;
    for (size_t i = 0; i < values.size(); ++i) {
        const double weight = 1 / (sigmas[i] * sigmas[i]);
        weights += weight;
        sum += weight * values[i];
        plain += values[i];
    }
    Mean mean;
    mean.value = sum / weights;
    mean.sigma = 1 / std::sqrt(weights);
    if (values.size() > 1) {
        const double centre = plain / static_cast<double>(values.size());
        double squares = 0;
        for (const double value : values) squares += (value - centre) * (value - centre);
        mean.spread = std::sqrt(squares / static_cast<double>(values.size() - 1));
    }
    return mean;
}

}  // namespace

InvertedIndex invert_psi_delta(const AnglePoint& point) {
    const double tan_psi = std::tan(point.psi);
    const Complex64 r = std::polar(tan_psi, -point.delta);
    const double tan_theta = point.sin_theta / point.cos_theta;
    const Complex64 one(1, 0), i(0, 1);
    const Complex64 ratio = (one - r) / (one + r);
    const double sin2 = point.sin_theta * point.sin_theta;
    Complex64 index = std::sqrt(sin2 * (one + tan_theta * tan_theta * ratio * ratio));
    if (-index.imag() > index.real()) index = -index;
    // dN/dr, then dr = r (2/sin 2Psi dPsi - i dDelta); the map is analytic in r.
    const Complex64 slope =
        sin2 * tan_theta * tan_theta * ratio / index * (-2.0 / ((one + r) * (one + r)));
    const double sec2 = 1 + tan_psi * tan_psi;
    const Complex64 by_psi = slope * std::polar(sec2, -point.delta);
    const Complex64 by_delta = slope * (-i) * r;
    InvertedIndex result;
    result.n = index.real();
    result.k = index.imag();
    const Complex64 from_psi = by_psi * point.sigma_psi, from_delta = by_delta * point.sigma_delta;
    result.sigma_n = std::hypot(from_psi.real(), from_delta.real());
    result.sigma_k = std::hypot(from_psi.imag(), from_delta.imag());
    result.covariance = from_psi.real() * from_psi.imag() + from_delta.real() * from_delta.imag();
    return result;
}

AveragedIndex invert_and_average(const WavelengthData& data) {
    std::vector<double> n, k, sigma_n, sigma_k;
    double correlation = 0;
    for (const AnglePoint& point : data.points) {
        const InvertedIndex inverted = invert_psi_delta(point);
        // At Psi = 0 and 90 only one polarisation is reflected and Delta says nothing.
        const bool usable = std::sin(2 * point.psi) > 1e-9 && std::isfinite(inverted.n) &&
                            std::isfinite(inverted.k) && std::isfinite(inverted.sigma_n) &&
                            std::isfinite(inverted.sigma_k) && inverted.sigma_n > 0 &&
                            inverted.sigma_k > 0;
        if (!usable) continue;
        n.push_back(inverted.n);
        k.push_back(inverted.k);
        sigma_n.push_back(inverted.sigma_n);
        sigma_k.push_back(inverted.sigma_k);
        // Covariance of the two weighted sums, over the product of their sums of weights below.
        const double product = inverted.sigma_n * inverted.sigma_k;
        correlation += inverted.covariance / (product * product);
    }
    AveragedIndex average;
    average.angles = static_cast<int>(n.size());
    if (n.empty()) return average;
    const Mean mean_n = weighted_mean(n, sigma_n), mean_k = weighted_mean(k, sigma_k);
    average.n = mean_n.value;
    average.k = mean_k.value;
    average.sigma_n = mean_n.sigma;
    average.sigma_k = mean_k.sigma;
    average.correlation = correlation * mean_n.sigma * mean_k.sigma;
    average.spread_n = mean_n.spread;
    average.spread_k = mean_k.spread;
    return average;
}

AveragedIndex start_from_tan2_psi(const WavelengthData& data) {
    // Normal equations of two unknowns (a, m).
    double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0, sin2_sum = 0;
    for (const AnglePoint& point : data.points) {
        const double s = point.sin_theta * point.sin_theta / point.cos_theta;
        const double N = std::cos(2 * point.psi);
        const double x = 2 * s, y = -N, z = s * s * N;
        xx += x * x;
        xy += x * y;
        yy += y * y;
        xz += x * z;
        yz += y * z;
        sin2_sum += point.sin_theta * point.sin_theta;
    }
    AveragedIndex start;
    start.angles = static_cast<int>(data.points.size());
    start.n = 1;
    start.k = 3;
    const double determinant = xx * yy - xy * xy;
    if (!(std::abs(determinant) > 1e-12 * xx * yy)) return start;
    const double a = std::max((yy * xz - xy * yz) / determinant, 1e-3);
    double m = (xx * yz - xy * xz) / determinant;
    // Noise may leave |q| below its own real part; half of |q| in b is as good a start as any.
    if (!(m > a * a)) m = 4.0 / 3.0 * a * a;
    const double mean_sin2 = sin2_sum / static_cast<double>(data.points.size());
    const Complex64 epsilon(2 * a * a - m + mean_sin2, 2 * a * std::sqrt(m - a * a));
    const Complex64 index = std::sqrt(epsilon);
    start.n = index.real();
    start.k = index.imag();
    return start;
}

}  // namespace drude
