#include "image/colour_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/numbers.h"
#include "image/font.h"
#include "image/srgb.h"

namespace drude {

namespace {

Colour from_display(double red, double green, double blue) {
    const auto linear = [](double display) {
        return linear_from_srgb(static_cast<float>(std::clamp(display, 0.0, 1.0)));
    };
    return {linear(red), linear(green), linear(blue)};
}

Colour cubehelix(double position) {
    constexpr double start = 0.6, rotations = -0.9, hue = 1.0, dark = 0.03, light = 0.97;
    const double intensity = dark + (light - dark) * position;
    const double angle = 2.0 * std::numbers::pi * (start / 3.0 + 1.0 + rotations * intensity);
    const double amplitude = hue * intensity * (1.0 - intensity) / 2.0;
    const double c = std::cos(angle), s = std::sin(angle);
    return from_display(intensity + amplitude * (-0.14861 * c + 1.78277 * s),
                        intensity + amplitude * (-0.29227 * c - 0.90649 * s),
                        intensity + amplitude * (1.97294 * c));
}

Colour diverging(double position) {
    // Display values; the two ends were chosen to have the same Rec.709 luminance (0.120).
    constexpr double blue[3] = {0.13, 0.38, 0.72}, orange[3] = {0.67, 0.295, 0.02};
    const double distance = std::abs(2.0 * position - 1.0);
    const double* end = position < 0.5 ? blue : orange;
    double rgb[3];
    for (int c = 0; c < 3; ++c) rgb[c] = 1.0 + distance * (end[c] - 1.0);
    return from_display(rgb[0], rgb[1], rgb[2]);
}

// Linear Rec.709 of Oklab (B. Ottosson, "A perceptual color space for image processing", 2020):
// equal steps of lightness and of the two opponent axes look alike.
Colour from_oklab(double lightness, double green_red, double blue_yellow) {
    const double l = std::pow(lightness + 0.3963377774 * green_red + 0.2158037573 * blue_yellow, 3);
    const double m = std::pow(lightness - 0.1055613458 * green_red - 0.0638541728 * blue_yellow, 3);
    const double s = std::pow(lightness - 0.0894841775 * green_red - 1.2914855480 * blue_yellow, 3);
    return {static_cast<float>(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
            static_cast<float>(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
            static_cast<float>(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

}  // namespace

Colour faded_cyclic_colour(double position, double strength) {
    // The largest circle around this grey that stays within the colours a display has.
    constexpr double grey = 0.65, lightness = 0.2, green_red = 0.06, blue_yellow = 0.115;
    const double radius = std::clamp(strength, 0.0, 1.0);
    const double c = radius * std::cos(2.0 * std::numbers::pi * position);
    const double s = radius * std::sin(2.0 * std::numbers::pi * position);
    return from_oklab(grey + lightness * s, green_red * s, blue_yellow * c);
}

Colour map_colour(ColourMap map, double position) {
    if (std::isnan(position)) return {1.0F, 0.0F, 1.0F};
    position = std::clamp(position, 0.0, 1.0);
    switch (map) {
        case ColourMap::sequential:
            return cubehelix(position);
        case ColourMap::diverging:
            return diverging(position);
        case ColourMap::cyclic:
            break;
    }
    return faded_cyclic_colour(position, 1.0);
}

std::vector<double> bar_ticks(double low, double high) {
    constexpr int most = 6;
    const double decade = std::pow(10.0, std::floor(std::log10((high - low) / most)));
    double step = decade;
    for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
        step = factor * decade;
        // A hair of slack keeps the ends, which rounding may put just outside.
        if (std::floor(high / step + 1e-9) - std::ceil(low / step - 1e-9) < most) break;
    }
    std::vector<double> ticks;
    const double first = std::ceil(low / step - 1e-9), last = std::floor(high / step + 1e-9);
    for (double k = first; k <= last; k += 1.0) {
        // Printed numbers should read 0.3, not 0.30000000000000004.
        const double value = step < 1.0 ? k / std::round(1.0 / step) : k * step;
        ticks.push_back(value == 0.0 ? 0.0 : value);
    }
    return ticks;
}

namespace {

int ramp_width(int scale) {
    return 12 * scale;
}
std::vector<double> ticks_of(const ColourBar& bar) {
    return bar.ticks.empty() ? bar_ticks(bar.low, bar.high) : bar.ticks;
}
int label_offset(int scale) {
    return ramp_width(scale) + 5 * scale;
}

}  // namespace

int colour_bar_width(const ColourBar& bar, int scale) {
    int widest = 0;
    for (const double tick : ticks_of(bar)) {
        widest = std::max(widest, text_width(format_double(tick)));
    }
    return label_offset(scale) + widest * scale;
}

void draw_colour_bar(Picture& picture, int x, int y, int height, const ColourBar& bar,
                     const Colour& ink, int scale) {
    const int width = ramp_width(scale);
    for (int row = 0; row < height; ++row) {
        const double position = height > 1 ? 1.0 - static_cast<double>(row) / (height - 1) : 0.0;
        fill_rectangle(picture, x, y + row, width, 1, map_colour(bar.map, position));
    }
    draw_frame(picture, x, y, width, height, ink);
    for (const double tick : ticks_of(bar)) {
        const double position = (tick - bar.low) / (bar.high - bar.low);
        const int row = y + static_cast<int>(std::lround((1.0 - position) * (height - 1)));
        fill_rectangle(picture, x + width, row, 3 * scale, 1, ink);
        // Labels at the ends stay within the bar's height.
        const int top = std::clamp(row - glyph_ascent * scale / 2, y,
                                   std::max(y, y + height - glyph_ascent * scale));
        draw_text(picture, x + label_offset(scale), top, format_double(tick), ink, scale);
    }
}

}  // namespace drude
