// Pictures for people: linear RGB with text and bars drawn into them.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace drude {

// Linear R, G, B (Rec.709), each in [0, 1] where it is to be seen unclipped.
using Colour = std::array<float, 3>;

// The linear colour of an 8-bit sRGB one.
Colour srgb_colour(int red, int green, int blue);

// Row-major, interleaved, y = 0 the top row: rgb[3 * (y * width + x) + c].
struct Picture {
    int width = 0, height = 0;
    std::vector<float> rgb;

    Picture() = default;
    // Filled with `colour`; both sides at least 1, else std::logic_error.
    Picture(int width_, int height_, const Colour& colour);

    Colour at(int x, int y) const;
    void set(int x, int y, const Colour& colour);  // nothing outside the picture
};

// All drawing is clipped at the picture's edges.
void fill_rectangle(Picture& picture, int x, int y, int width, int height, const Colour& colour);
void draw_frame(Picture& picture, int x, int y, int width, int height, const Colour& colour);
// Copies `source` with its top left corner at (x, y).
void draw_picture(Picture& picture, int x, int y, const Picture& source);
// One line of UTF-8 text with the top left corner of its first letter at (x, y), each dot of the
// font `scale` x `scale` pixels.
void draw_text(Picture& picture, int x, int y, std::string_view text, const Colour& colour,
               int scale);

}  // namespace drude
