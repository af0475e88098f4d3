#include "image/polarisation_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "image/difference.h"

namespace drude {

namespace {

double value_of(const Stokes<double>& v, PolarisationView view) {
    const double p = std::hypot(v[1], v[2]);
    switch (view) {
        case PolarisationView::dop:
            return std::hypot(p, v[3]) / v[0];
        case PolarisationView::dolp:
            return p / v[0];
        case PolarisationView::docp:
            return std::abs(v[3]) / v[0];
        case PolarisationView::aolp: {
            if (!(p > 0.0)) return std::numeric_limits<double>::quiet_NaN();
            const double degrees = 0.5 * std::atan2(v[2], v[1]) * 180.0 / std::numbers::pi;
            // A hair below 0 becomes 180 by rounding, which is 0.
            const double turned = degrees < 0.0 ? degrees + 180.0 : degrees;
            return turned < 180.0 ? turned : 0.0;
        }
        case PolarisationView::s0:
            return v[0];
        case PolarisationView::s1:
            return v[1];
        case PolarisationView::s2:
            return v[2];
        case PolarisationView::s3:
            return v[3];
    }
    throw std::logic_error("polarisation view: an unknown figure");
}

bool is_component(PolarisationView view) {
    return view >= PolarisationView::s0;
}

double component_range(const std::vector<double>& values) {
    std::vector<double> sizes;
    for (const double value : values) {
        if (std::isfinite(value)) sizes.push_back(std::abs(value));
    }
    if (sizes.empty()) return 1.0;
    const double rank = std::ceil(0.995 * static_cast<double>(sizes.size()));
    const auto nth = sizes.begin() + static_cast<std::ptrdiff_t>(rank) - 1;
    std::nth_element(sizes.begin(), nth, sizes.end());
    // A picture that is black but for some pixels is shown by those.
    const double size = *nth > 0.0 ? *nth : *std::max_element(sizes.begin(), sizes.end());
    // Rounding below works with powers of ten that a double still has.
    if (!(size > 1e-300)) return 1.0;
    const double digit = std::pow(10.0, std::floor(std::log10(size)) - 1.0);
    const double rounded = std::ceil(size / digit * (1.0 - 1e-12));
    // 4.6, not 4.6000000000000005.
    return digit < 1.0 ? rounded / std::round(1.0 / digit) : rounded * digit;
}

}  // namespace

bool needs_s3(PolarisationView view) {
    return view == PolarisationView::dop || view == PolarisationView::docp ||
           view == PolarisationView::s3;
}

std::vector<double> view_values(const StokesLayer& layer, PolarisationView view) {
    if (needs_s3(view) && layer.s[3].empty()) {
        throw std::logic_error("polarisation view: S3 was not read");
    }
    std::vector<double> values(layer.s[0].size(), std::numeric_limits<double>::quiet_NaN());
    for (size_t i = 0; i < values.size(); ++i) {
        const Stokes<double> v = layer.at(i);
        if (!is_component(view) && !(v[0] > 0.0 && std::isfinite(v[0]))) continue;
        const double value = value_of(v, view);
        if (std::isfinite(value)) values[i] = value;
    }
    return values;
}

ColourBar view_bar(PolarisationView view, const std::vector<double>& values,
                   std::optional<double> range) {
    if (range && !(*range > 0.0 && std::isfinite(*range))) {
        throw std::logic_error("polarisation view: a range that is not above 0");
    }
    switch (view) {
        case PolarisationView::dop:
            return {ColourMap::sequential, 0.0, range.value_or(1.0), "DoP"};
        case PolarisationView::dolp:
            return {ColourMap::sequential, 0.0, range.value_or(1.0), "DoLP"};
        case PolarisationView::docp:
            return {ColourMap::sequential, 0.0, range.value_or(1.0), "DoCP"};
        case PolarisationView::aolp:
            return {ColourMap::cyclic, 0.0, 180.0, "AoLP \u00b0", {0, 45, 90, 135, 180}};
        default:
            break;
    }
    const double size = range ? *range : component_range(values);
    if (view == PolarisationView::s0) return {ColourMap::sequential, 0.0, size, "S0"};
    const char* label = view == PolarisationView::s1   ? "S1"
                        : view == PolarisationView::s2 ? "S2"
                                                       : "S3";
    // The ends are named: a symmetric range is read off at a glance.
    return {ColourMap::diverging, -size, size, label, {-size, -size / 2, 0, size / 2, size}};
}

Picture view_picture(const StokesLayer& layer, PolarisationView view,
                     const std::vector<double>& values, const ColourBar& bar) {
    const bool fades = view == PolarisationView::aolp;
    Picture picture = map_values(layer.width, layer.height, values, bar);
    for (size_t i = 0; i < values.size(); ++i) {
        if (!fades && !std::isnan(values[i])) continue;
        double strength = 0.0;
        if (!std::isnan(values[i])) {
            const Stokes<double> v = layer.at(i);
            strength = std::hypot(v[1], v[2]) / v[0] / full_colour_dolp;
        }
        const double position = strength > 0.0 ? values[i] / 180.0 : 0.0;
        const Colour colour = faded_cyclic_colour(position, strength);
        std::copy(colour.begin(), colour.end(),
                  picture.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
    return picture;
}

}  // namespace drude
