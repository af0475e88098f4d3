#include "scene/resolution.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "scene/crop.h"

namespace drude {

void set_resolution(const std::string& text, const std::string& what, Scene* scene) {
    Film* film = &scene->film;
    int width = 0, height = 0;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 1 ||
        height < 1 || width > 65536 || height > 65536) {
        user_error("{} '{}': expected WIDTHxHEIGHT, e.g. 512x512", what, text);
    }
    // Of a picture that is cropped the size is the whole one's, and the part stays the same part.
    int bounds[4] = {0, width, 0, height};
    if (film->crop) {
        const Film::Crop& crop = *film->crop;
        const auto scaled = [](int at, int whole, int size) {
            return static_cast<int>((static_cast<int64_t>(at) * size + whole - 1) / whole);
        };
        bounds[0] = std::min(scaled(crop.x0, crop.whole_width, width), width - 1);
        bounds[1] = scaled(crop.x0 + film->width, crop.whole_width, width);
        bounds[2] = std::min(scaled(crop.y0, crop.whole_height, height), height - 1);
        bounds[3] = scaled(crop.y0 + film->height, crop.whole_height, height);
        uncrop_picture(film, &scene->camera);
    }
    const auto default_window = [](int w, int h, double window[4]) {
        const double aspect = static_cast<double>(w) / h;
        window[1] = std::max(1.0, aspect);
        window[3] = std::max(1.0, 1 / aspect);
        window[0] = -window[1];
        window[2] = -window[3];
    };
    double expected[4];
    default_window(film->width, film->height, expected);
    double* window = scene->camera.screen_window;
    const bool is_default = std::equal(window, window + 4, expected,
                                       [](double a, double b) { return std::abs(a - b) < 1e-9; });
    if (is_default) default_window(width, height, window);
    film->width = width;
    film->height = height;
    crop_picture(bounds[0], std::max(bounds[1], bounds[0] + 1), bounds[2],
                 std::max(bounds[3], bounds[2] + 1), film, &scene->camera);
}

}  // namespace drude
