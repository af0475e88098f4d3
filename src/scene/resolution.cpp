#include "scene/resolution.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace drude {

void set_resolution(const std::string& text, const std::string& what, Scene* scene) {
    Film* film = &scene->film;
    int width = 0, height = 0;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 1 ||
        height < 1 || width > 65536 || height > 65536) {
        user_error("{} '{}': expected WIDTHxHEIGHT, e.g. 512x512", what, text);
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
}

}  // namespace drude
