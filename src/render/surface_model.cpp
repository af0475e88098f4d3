#include "render/surface_model.h"

#include <algorithm>
#include <cmath>

#include "render/bounce_choice.h"

namespace drude {

namespace {

bool has_film(const ConductorMaterial* metal) {
    return metal != nullptr && !metal->reflectance && !metal->surface.layers.empty();
}

bool has_films(const Scene& scene) {
    return std::any_of(
        scene.materials.begin(), scene.materials.end(), [](const SurfaceMaterial& material) {
            const auto* coated = std::get_if<CoatedMaterial>(&material);
            return has_film(coated != nullptr ? std::get_if<ConductorMaterial>(&coated->base)
                                              : std::get_if<ConductorMaterial>(&material));
        });
}

}  // namespace

SurfaceModel surface_model(const Scene& scene, const RenderOptions& options) {
    SurfaceModel model;
    model.films = options.films;
    if (has_films(scene)) model.gain_of_films = film_gain(scene);
    model.mirror_below =
        options.mirror_below.value_or(has_small_lights(scene) ? 0 : mirror_below_beta);
    return model;
}

double film_gain(const Scene& scene) {
    const double most = std::max(1, bounce_choice(scene).reflections);
    const double albedo = scene_albedo(scene).largest;
    return albedo < 1 ? std::min(most, (1 - std::pow(albedo, most)) / (1 - albedo)) : most;
}

bool has_small_lights(const Scene& scene) {
    return !scene.distant_lights.empty() || !scene.point_lights.empty();
}

double lobe_blur(Lobe lobe, double beta) {
    switch (lobe) {
        case Lobe::blinn_phong:
        case Lobe::gaussian:
            return 2 * beta / std::sqrt(pi * std::log(2.0));
        case Lobe::beckmann:
            return 2 * beta / std::sqrt(pi);
        case Lobe::trowbridge_reitz:
            break;
    }
    return 2 * trowbridge_reitz_alpha(beta);
}

double pixel_angle(const Scene& scene) {
    const Camera& camera = scene.camera;
    const double* window = camera.screen_window;
    const double width = (window[1] - window[0]) / scene.film.width;
    const double height = (window[3] - window[2]) / scene.film.height;
    switch (camera.kind) {
        case CameraKind::orthographic:
            return 0;
        case CameraKind::spherical:
            // Twice pi around, pi up; an equal-area picture shares the sphere out evenly.
            return camera.equal_area ? std::sqrt(4 * pi * std::abs(width * height))
                                     : std::min(2 * pi * std::abs(width), pi * std::abs(height));
        case CameraKind::perspective:
            break;
    }
    return std::tan(camera.fov_deg * pi / 360) * std::min(std::abs(width), std::abs(height));
}

double mirror_error(double blur, double pixel_angle) {
    if (!(blur > 0)) return 0;
    return pixel_angle > 0 ? std::min(1.0, blur / (2 * pixel_angle)) : 1;
}

}  // namespace drude
