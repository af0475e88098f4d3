#include "render/pixel_filter.h"

#include <algorithm>
#include <cmath>

namespace drude {

namespace {

double mitchell(double x, double b, double c) {
    x = std::abs(2 * x);  // pbrt's parameterisation: 1 at the radius
    if (x <= 1) {
        return ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + (6 - 2 * b)) /
               6;
    }
    if (x <= 2) {
        return ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x +
                (8 * b + 24 * c)) /
               6;
    }
    return 0;
}

double value(const Filter& filter, double x, double radius) {
    switch (filter.kind) {
        case FilterKind::box:
            return 1;
        case FilterKind::triangle:
            return std::max(0.0, radius - std::abs(x));
        case FilterKind::gaussian: {
            const double s2 = 2 * filter.sigma * filter.sigma;
            return std::max(0.0, std::exp(-x * x / s2) - std::exp(-radius * radius / s2));
        }
        case FilterKind::mitchell:
            return mitchell(x / radius, filter.b, filter.c);
    }
    return 1;
}

}  // namespace

PixelFilter::Axis PixelFilter::make_axis(const Filter& filter, double radius) {
    Axis axis;
    // Beyond six sigma a Gaussian has nothing, and a wide radius would leave it between the cells.
    if (filter.kind == FilterKind::gaussian) radius = std::min(radius, 6 * filter.sigma);
    axis.radius = static_cast<float>(radius);
    if (filter.kind == FilterKind::box) return axis;
    constexpr int cells = 256;
    double absolute = 0, total = 0;
    std::vector<double> cumulative;
    for (int i = 0; i < cells; ++i) {
        const double f = value(filter, radius * ((2 * i + 1.0) / cells - 1), radius);
        absolute += std::abs(f);
        total += f;
        cumulative.push_back(absolute);
        axis.sign.push_back(f < 0 ? -1.0f : 1.0f);
        axis.negative = axis.negative || f < 0;
    }
    for (const double c : cumulative) axis.cdf.push_back(static_cast<float>(c / absolute));
    axis.scale = static_cast<float>(absolute / total);
    return axis;
}

PixelFilter::PixelFilter(const Filter& filter)
    : x_(make_axis(filter, filter.radius_x)), y_(make_axis(filter, filter.radius_y)) {}

float PixelFilter::Axis::offset(float u, float* weight) const {
    *weight = 1;
    if (cdf.empty()) return (2 * u - 1) * radius;
    const size_t i =
        std::min<size_t>(std::upper_bound(cdf.begin(), cdf.end(), u) - cdf.begin(), cdf.size() - 1);
    const float low = i > 0 ? cdf[i - 1] : 0;
    const float inside = cdf[i] > low ? std::clamp((u - low) / (cdf[i] - low), 0.0f, 1.0f) : 0.5f;
    *weight = sign[i] * scale;
    const float cells = static_cast<float>(cdf.size());
    return radius * (2 * (static_cast<float>(i) + inside) / cells - 1);
}

}  // namespace drude
