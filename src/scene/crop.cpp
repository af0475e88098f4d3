#include "scene/crop.h"

#include <algorithm>

namespace drude {

namespace {

// The window seen by the pixels from (x0, y0) to (x1, y1) of a picture of w x h pixels, which may
// lie outside it.
void cut_window(double x0, double x1, double y0, double y1, double w, double h, Camera* camera) {
    double* s = camera->screen_window;
    const double step_x = (s[1] - s[0]) / w, step_y = (s[3] - s[2]) / h;
    const double window[4] = {s[0] + x0 * step_x, s[0] + x1 * step_x, s[3] - y1 * step_y,
                              s[3] - y0 * step_y};
    std::copy(window, window + 4, s);
}

}  // namespace

void crop_picture(int x0, int x1, int y0, int y1, Film* film, Camera* camera) {
    uncrop_picture(film, camera);
    if (x0 == 0 && y0 == 0 && x1 == film->width && y1 == film->height) return;
    cut_window(x0, x1, y0, y1, film->width, film->height, camera);
    film->crop = Film::Crop{film->width, film->height, x0, y0};
    film->width = x1 - x0;
    film->height = y1 - y0;
}

void uncrop_picture(Film* film, Camera* camera) {
    if (!film->crop) return;
    const Film::Crop& c = *film->crop;
    cut_window(-c.x0, c.whole_width - c.x0, -c.y0, c.whole_height - c.y0, film->width, film->height,
               camera);
    film->width = c.whole_width;
    film->height = c.whole_height;
    film->crop.reset();
}

}  // namespace drude
