#include "image/picture.h"

#include <algorithm>
#include <stdexcept>

#include "image/font.h"
#include "image/srgb.h"

namespace drude {

Colour srgb_colour(int red, int green, int blue) {
    return {linear_from_srgb(static_cast<float>(red) / 255.0F),
            linear_from_srgb(static_cast<float>(green) / 255.0F),
            linear_from_srgb(static_cast<float>(blue) / 255.0F)};
}

Picture::Picture(int width_, int height_, const Colour& colour) : width(width_), height(height_) {
    if (width < 1 || height < 1) throw std::logic_error("Picture: an empty picture");
    rgb.resize(3 * static_cast<size_t>(width) * static_cast<size_t>(height));
    fill_rectangle(*this, 0, 0, width, height, colour);
}

Colour Picture::at(int x, int y) const {
    const size_t i =
        3 * (static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x));
    return {rgb.at(i), rgb.at(i + 1), rgb.at(i + 2)};
}

void Picture::set(int x, int y, const Colour& colour) {
    if (x < 0 || y < 0 || x >= width || y >= height) return;
    const size_t i =
        3 * (static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x));
    std::copy(colour.begin(), colour.end(), rgb.begin() + static_cast<std::ptrdiff_t>(i));
}

void fill_rectangle(Picture& picture, int x, int y, int width, int height, const Colour& colour) {
    const int right = std::min(picture.width, x + width);
    const int bottom = std::min(picture.height, y + height);
    for (int row = std::max(0, y); row < bottom; ++row) {
        for (int column = std::max(0, x); column < right; ++column)
            picture.set(column, row, colour);
    }
}

void draw_frame(Picture& picture, int x, int y, int width, int height, const Colour& colour) {
    fill_rectangle(picture, x, y, width, 1, colour);
    fill_rectangle(picture, x, y + height - 1, width, 1, colour);
    fill_rectangle(picture, x, y, 1, height, colour);
    fill_rectangle(picture, x + width - 1, y, 1, height, colour);
}

void draw_picture(Picture& picture, int x, int y, const Picture& source) {
    for (int row = 0; row < source.height; ++row) {
        for (int column = 0; column < source.width; ++column) {
            picture.set(x + column, y + row, source.at(column, row));
        }
    }
}

void draw_text(Picture& picture, int x, int y, std::string_view text, const Colour& colour,
               int scale) {
    for (const char32_t letter : code_points(text)) {
        const Glyph& dots = glyph(letter);
        for (int row = 0; row < glyph_height; ++row) {
            for (int column = 0; column < glyph_width; ++column) {
                if (dots[static_cast<size_t>(row)] >> (glyph_width - 1 - column) & 1) {
                    fill_rectangle(picture, x + column * scale, y + row * scale, scale, scale,
                                   colour);
                }
            }
        }
        x += glyph_advance * scale;
    }
}

}  // namespace drude
