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

}  // namespace

Colour map_colour(ColourMap map, double position) {
    if (std::isnan(position)) return {1.0F, 0.0F, 1.0F};
    position = std::clamp(position, 0.0, 1.0);
    return map == ColourMap::sequential ? cubehelix(position) : diverging(position);
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
int label_offset(int scale) {
    return ramp_width(scale) + 5 * scale;
}

}  // namespace

int colour_bar_width(const ColourBar& bar, int scale) {
    int widest = 0;
    for (const double tick : bar_ticks(bar.low, bar.high)) {
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
    for (const double tick : bar_ticks(bar.low, bar.high)) {
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
