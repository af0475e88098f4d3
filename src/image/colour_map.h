// Numbers as colours that keep their order for every eye, and the bar that explains them.
#pragma once

#include <string>

#include "image/picture.h"

namespace drude {

enum class ColourMap {
    // Dark to light: Green's cubehelix (D. A. Green, "A colour scheme for the display of
    // astronomical intensity images", Bull. Astr. Soc. India 39, 289, 2011, eq. 2) with start
    // 0.6, -0.9 rotations, hue 1, gamma 1, from intensity 0.03 to 0.97. Perceived intensity rises
    // evenly along it, so the order survives in grey and under every colour blindness.
    sequential,
    // Blue below, white at the middle, orange above; luminance falls alike towards both ends.
    // Blue and orange stay apart for the common (red-green) colour blindnesses.
    diverging,
    // For angles: ends where it starts. A circle around a middle grey whose diameters are yellow to
    // blue (positions 0 and 1/2) and light rose to dark green (1/4 and 3/4), so that a quarter turn
    // stays a difference of hue or of lightness for the common colour blindnesses and in no
    // direction looks like no direction.
    cyclic,
};

// Linear colour at `position` in [0, 1] (clamped). NaN is magenta, which is in none of the maps.
Colour map_colour(ColourMap map, double position);

// The cyclic map faded: `strength` (clamped to [0, 1]) 1 is the map's colour, 0 its middle grey.
Colour faded_cyclic_colour(double position, double strength);

struct ColourBar {
    ColourMap map = ColourMap::sequential;
    double low = 0.0, high = 1.0;    // values at the bottom and at the top, low < high
    std::string label;               // written above, "" for none
    std::vector<double> ticks = {};  // values that get a number; none: bar_ticks
};

// At most six round values (steps of 1, 2 or 5 times a power of ten) within [low, high].
std::vector<double> bar_ticks(double low, double high);

// Width in pixels that draw_colour_bar takes at this scale, tick labels included.
int colour_bar_width(const ColourBar& bar, int scale);

// The bar itself with ticks and their values, its top left corner at (x, y), `height` pixels high.
// The label is the caller's to place.
void draw_colour_bar(Picture& picture, int x, int y, int height, const ColourBar& bar,
                     const Colour& ink, int scale);

}  // namespace drude
