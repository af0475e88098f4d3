// Camera "perspective"; other cameras have it as their stand-in.
#include <algorithm>
#include <glm/matrix.hpp>

#include "base/numbers.h"
#include "scene/builders.h"
#include "scene/transforms.h"
#include "scene/vocabulary.h"

namespace drude {

namespace {

// pbrt's default: the shorter side runs from -1 to 1.
void set_window(Camera& camera, double aspect) {
    const double x = std::max(aspect, 1.0), y = std::max(1 / aspect, 1.0);
    const double window[4] = {-x, x, -y, y};
    std::copy(window, window + 4, camera.screen_window);
}

void read_window(Camera& camera, ParameterList& list) {
    const Parameter* window = list.values("screenwindow", ParameterType::number);
    if (window == nullptr) return;
    if (window->numbers.size() != 4) {
        user_error_at(window->place,
                      "Camera: \"float screenwindow\" has {} values; expected 4: "
                      "x0 x1 y0 y1",
                      window->numbers.size());
    }
    for (size_t i = 0; i < 4; i += 2) {
        if (!(window->numbers[i] < window->numbers[i + 1])) {
            user_error_at(window->place_of(i),
                          "Camera: screenwindow runs from {} to {}; expected the smaller first",
                          format_double(window->numbers[i]), format_double(window->numbers[i + 1]));
        }
    }
    std::copy(window->numbers.begin(), window->numbers.end(), camera.screen_window);
}

}  // namespace

Camera build_camera(const std::string& name, ParameterList& list,
                    const glm::dmat4& camera_from_world, const Film& film, Messages& messages) {
    Camera camera;
    check_matrix(camera_from_world, list.place());
    camera.world_from_camera = glm::inverse(camera_from_world);
    set_window(camera, static_cast<double>(film.width) / film.height);
    if (name != "perspective") {
        messages.stand_in(list.place(),
                          fmt::format("Camera \"{}\" is not modelled; a perspective camera with a "
                                      "field of view of 90 degrees stands in",
                                      name));
        list.ignore(known_parameters("Camera", name));
        return camera;
    }
    camera.fov_deg = list.number_in("fov", 90, 1e-3, 179.9);
    set_window(camera, list.number_in("frameaspectratio",
                                      static_cast<double>(film.width) / film.height, 1e-4, 1e4));
    read_window(camera, list);
    if (list.number_in("lensradius", 0, 0, 1e9) > 0) {
        messages.stand_in(
            list.place_of("lensradius"),
            "Camera \"perspective\": lensradius is not modelled; a pinhole stands in");
    }
    // Nothing moves and nothing is out of focus, so these have nothing to act on.
    list.number("focaldistance", 0);
    list.number("shutteropen", 0);
    list.number("shutterclose", 1);
    list.finish(known_parameters("Camera", name), messages);
    return camera;
}

}  // namespace drude
