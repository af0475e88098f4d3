// Camera "perspective", "orthographic" and "spherical", with what stands before them.
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

// What perspective and orthographic cameras share.
void read_projective(Camera& camera, ParameterList& list, double aspect) {
    set_window(camera, list.number_in("frameaspectratio", aspect, 1e-4, 1e4));
    read_window(camera, list);
    camera.lens_radius = list.number_in("lensradius", 0, 0, 1e9);
    // Without a lens nothing is out of focus, wherever that is.
    camera.focal_distance = camera.lens_radius > 0
                                ? list.number_in("focaldistance", 1e6, 1e-9, 1e15)
                                : list.number("focaldistance", 1e6);
}

void read_spherical(Camera& camera, ParameterList& list) {
    camera.kind = CameraKind::spherical;
    const double window[4] = {0, 1, 0, 1};
    std::copy(window, window + 4, camera.screen_window);
    const std::string mapping = list.text("mapping", "equalarea");
    camera.equal_area = mapping == "equalarea";
    if (!camera.equal_area && mapping != "equirectangular") {
        user_error_at(list.place_of("mapping"),
                      "Camera \"spherical\": there is no mapping '{}'{}; expected 'equalarea' or "
                      "'equirectangular'",
                      shown(mapping), did_you_mean(mapping, {"equalarea", "equirectangular"}));
    }
    // pbrt-v4 takes these and makes nothing of them.
    for (const char* name : {"frameaspectratio", "lensradius", "focaldistance"}) {
        list.number(name, 0);
    }
    list.values("screenwindow", ParameterType::number);
}

std::optional<Analyser> read_analyser(ParameterList& list) {
    if (!list.has("analyser")) {
        for (const char* name : {"retarder", "retarderaxis"}) {
            if (!list.has(name)) continue;
            user_error_at(list.place_of(name),
                          "{}: {} without \"float analyser\"; expected the angle of the polariser "
                          "that stands behind the retarder",
                          list.owner(), name);
        }
        return {};
    }
    Analyser analyser;
    analyser.axis_deg = list.number_in("analyser", 0, -360, 360);
    if (list.has("retarder")) {
        Analyser::Retarder retarder;
        retarder.retardance_deg = list.number_in("retarder", 90, -360, 360);
        retarder.fast_axis_deg = list.number_in("retarderaxis", 0, -360, 360);
        analyser.retarder = retarder;
    } else if (list.has("retarderaxis")) {
        user_error_at(list.place_of("retarderaxis"),
                      "{}: retarderaxis without a retarder; expected \"float retarder\" with its "
                      "retardance in degrees, 90 for a quarter-wave plate",
                      list.owner());
    }
    return analyser;
}

}  // namespace

Camera build_camera(const std::string& name, ParameterList& list,
                    const glm::dmat4& camera_from_world, const Film& film, Messages& messages) {
    Camera camera;
    check_matrix(camera_from_world, list.place());
    camera.world_from_camera = glm::inverse(camera_from_world);
    const double aspect = static_cast<double>(film.width) / film.height;
    set_window(camera, aspect);
    camera.analyser = read_analyser(list);
    if (name == "perspective") {
        camera.fov_deg = list.number_in("fov", 90, 1e-3, 179.9);
        read_projective(camera, list, aspect);
    } else if (name == "orthographic") {
        camera.kind = CameraKind::orthographic;
        read_projective(camera, list, aspect);
        if (camera.lens_radius > 0) {
            messages.stand_in(list.place_of("lensradius"),
                              "Camera \"orthographic\": every point of the picture has a lens of "
                              "its own; pbrt-v4 gives all of them one lens in the middle, which "
                              "makes the picture a perspective");
        }
    } else if (name == "spherical") {
        read_spherical(camera, list);
    } else {
        messages.stand_in(list.place(),
                          fmt::format("Camera \"{}\" is not modelled; a perspective camera with a "
                                      "field of view of 90 degrees stands in",
                                      name));
        list.ignore(known_parameters("Camera", name));
        return camera;
    }
    // Nothing moves, so these have nothing to act on.
    list.number("shutteropen", 0);
    list.number("shutterclose", 1);
    list.finish(known_parameters("Camera", name), messages);
    return camera;
}

}  // namespace drude
