#include "materials/microfacet.h"

namespace drude::microfacet_detail {

double solve_visible_slope(double c, double s, double v) {
    constexpr double two_sqrt_pi = 3.54490770181103205460;
    // Beyond 6 a Gaussian of variance 1/2 holds less than 1e-16.
    double low = -6, high = s > 0 ? std::min(6.0, c / s) : 6.0;
    double x = std::min(0.0, high);
    for (int step = 0; step < 60; ++step) {
        const double bell = std::exp(-x * x);
        const double error = c * (1 + std::erf(x)) / 2 + s * bell / two_sqrt_pi - v;
        (error > 0 ? high : low) = x;
        const double slope = 2 * bell / two_sqrt_pi * (c - s * x);
        double next = slope > 0 ? x - error / slope : high;
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        if (std::abs(next - x) <= 1e-12 * (1 + std::abs(x))) return next;
        x = next;
    }
    return x;
}

namespace {
constexpr int cells = 256;
}

// The variable is x = g a: for narrow lobes everything then happens at the scale of 1. The factor
// g/2 takes sin(2x/g) to x there.
double GaussianAngles::density(double x) const {
    return std::exp(-x * x) * 0.5 * g_ * std::sin(2 * x / g_);
}

GaussianAngles::GaussianAngles(double g) : g_(g) {
    step_ = std::min(7.0, g * pi / 2) / cells;
    cumulative_.assign(cells + 1, 0);
    for (int i = 0; i < cells; ++i) {
        const double middle = (i + 0.5) * step_, offset = step_ * 0.5 * std::sqrt(0.6);
        cumulative_[i + 1] =
            cumulative_[i] +
            step_ / 18 *
                (5 * density(middle - offset) + 8 * density(middle) + 5 * density(middle + offset));
    }
}

double GaussianAngles::tangent(double u) const {
    const double target = u * cumulative_.back();
    const auto above = std::upper_bound(cumulative_.begin(), cumulative_.end(), target);
    const auto cell = std::clamp<long>(above - cumulative_.begin() - 1, 0, cells - 1);
    const double begin = static_cast<double>(cell) * step_;
    const double rest = target - cumulative_[cell];
    // Newton on the cell's own integral (3-point Gauss-Legendre), kept inside the cell, from the
    // answer for a density that is linear there: in the first cell, and in the last of a wide
    // lobe, the density falls to 0 and a linear start would not converge.
    const double share = rest / (cumulative_[cell + 1] - cumulative_[cell]);
    const double d0 = density(begin), d1 = density(begin + step_);
    const double root = std::sqrt(std::max(0.0, d0 * d0 + share * (d1 * d1 - d0 * d0)));
    double size = d0 + root > 0 ? step_ * share * (d0 + d1) / (d0 + root) : 0;
    for (int i = 0; i < 3; ++i) {
        const double middle = begin + size / 2, offset = size * 0.5 * std::sqrt(0.6);
        const double integral =
            size / 18 *
            (5 * density(middle - offset) + 8 * density(middle) + 5 * density(middle + offset));
        const double slope = density(begin + size);
        if (!(slope > 0)) break;
        size = std::clamp(size - (integral - rest) / slope, 0.0, step_);
    }
    return std::tan((begin + size) / g_);
}

}  // namespace drude::microfacet_detail
