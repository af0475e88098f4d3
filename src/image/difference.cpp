#include "image/difference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "image/font.h"
#include "image/noise_test.h"

namespace drude {

namespace {

template <class Measure>
std::vector<double> mean_over_channels(const Image& a, const Image& b,
                                       const std::vector<std::string>& channels, Measure measure) {
    if (a.width != b.width || a.height != b.height || channels.empty()) {
        throw std::logic_error("difference of pictures of different sizes, or of no channel");
    }
    std::vector<double> mean(a.pixels(), 0.0);
    for (const std::string& name : channels) {
        const Channel& in_a = a.at(name, "first picture");
        const Channel& in_b = b.at(name, "second picture");
        for (size_t i = 0; i < mean.size(); ++i) {
            const double difference =
                static_cast<double>(in_a.data[i]) - static_cast<double>(in_b.data[i]);
            mean[i] += std::isfinite(difference) ? measure(difference)
                                                 : std::numeric_limits<double>::quiet_NaN();
        }
    }
    for (double& value : mean) value /= static_cast<double>(channels.size());
    return mean;
}

}  // namespace

std::vector<double> log_difference(const Image& a, const Image& b,
                                   const std::vector<std::string>& channels) {
    std::vector<double> values =
        mean_over_channels(a, b, channels, [](double d) { return std::abs(d); });
    for (double& value : values) value = std::log10(value);
    return values;
}

std::vector<double> signed_difference(const Image& a, const Image& b,
                                      const std::vector<std::string>& channels) {
    return mean_over_channels(a, b, channels, [](double d) { return d; });
}

std::vector<double> standard_error_difference(const Image& a, const Image& b,
                                              const std::vector<std::string>& channels,
                                              const std::string& name_a,
                                              const std::string& name_b) {
    std::vector<double> furthest(a.pixels(), 0.0);
    for (const std::string& name : channels) {
        const std::vector<double> z = standardised_difference(a, b, name, name_a, name_b);
        for (size_t i = 0; i < z.size(); ++i) {
            // NaN is further off than anything.
            if (!(std::abs(z[i]) <= std::abs(furthest[i])) && !std::isnan(furthest[i])) {
                furthest[i] = z[i];
            }
        }
    }
    return furthest;
}

Picture map_values(int width, int height, const std::vector<double>& values, const ColourBar& bar) {
    Picture picture(width, height, {});
    if (values.size() * 3 != picture.rgb.size()) throw std::logic_error("map_values: wrong size");
    for (size_t i = 0; i < values.size(); ++i) {
        const Colour colour = map_colour(bar.map, (values[i] - bar.low) / (bar.high - bar.low));
        std::copy(colour.begin(), colour.end(),
                  picture.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
    return picture;
}

ColourBar log_difference_bar() {
    return {ColourMap::sequential, -5.0, 0.0, "log10 |a-b|"};
}

ColourBar signed_difference_bar() {
    return {ColourMap::diverging, -0.1, 0.1, "a-b"};
}

ColourBar standard_error_bar() {
    return {ColourMap::diverging, -6.0, 6.0, "(a-b)/s"};
}

Picture with_colour_bar(const Picture& picture, const ColourBar& bar) {
    const int scale = std::max(1, std::min(picture.width, picture.height) / 180);
    const int margin = 6 * scale, line = (glyph_height + 2) * scale;
    const int bar_height = std::max(40 * scale, picture.height - line);
    const int right = std::max(colour_bar_width(bar, scale), text_width(bar.label) * scale);
    Picture result(picture.width + right + 3 * margin,
                   std::max(picture.height, bar_height + line) + 2 * margin, {1.0F, 1.0F, 1.0F});
    const Colour ink = srgb_colour(30, 30, 30);
    const int x = picture.width + 2 * margin;
    draw_picture(result, margin, margin, picture);
    draw_text(result, x, margin, bar.label, ink, scale);
    draw_colour_bar(result, x, margin + line, bar_height, bar, ink, scale);
    return result;
}

}  // namespace drude
