// LightSource and AreaLightSource.
//
// Scales follow pbrt-v4 (lights.cpp, Create): a light's spectrum is brought to luminance 1 (see
// light_spectrum), then multiplied by "scale"; "illuminance" multiplies what is then left so that a
// patch facing the light (the upper half of an infinite light) receives that many lux in pbrt's
// unit, the Y of spectrum_to_xyz; "power" likewise with lumen.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "scene/builders.h"
#include "scene/spectra.h"
#include "scene/transforms.h"
#include "scene/vocabulary.h"

namespace drude {

namespace {

constexpr double brightest = 1e15;

DenseSpectrum times(DenseSpectrum spectrum, double factor) {
    for (double& value : spectrum) value *= factor;
    return spectrum;
}

// pbrt takes 0 and less as "not given".
double target(ParameterList& list, const std::string& name) {
    return list.number_in(name, -1, -brightest, brightest);
}

void build_distant(ParameterList& list, const glm::dmat4& world_from_light, BuildContext& context,
                   Scene& scene) {
    DistantLight light;
    light.place = list.place();
    double scale = list.number_in("scale", 1, 0, brightest);
    const double illuminance = target(list, "illuminance");
    if (illuminance > 0) scale *= illuminance;
    light.irradiance = times(light_spectrum(list, "L", context), scale);
    const glm::dvec3 from = list.point3("from", {0, 0, 0}), to = list.point3("to", {0, 0, 1});
    const double distance = glm::length(to - from);
    if (!(distance > 0) || !std::isfinite(distance)) {
        user_error_at(list.place(),
                      "LightSource \"distant\": 'from' and 'to' give no direction; "
                      "expected two different points");
    }
    light.direction = glm::normalize(transform_vector(world_from_light, (to - from) / distance));
    scene.distant_lights.push_back(std::move(light));
}

void build_infinite(ParameterList& list, const glm::dmat4& world_from_light, BuildContext& context,
                    Scene& scene) {
    InfiniteLight light;
    light.place = list.place();
    light.world_from_light = world_from_light;
    light.scale = list.number_in("scale", 1, 0, brightest);
    const double illuminance = target(list, "illuminance");
    if (list.has("filename")) {
        if (list.has("L")) {
            user_error_at(list.place_of("L"),
                          "LightSource \"infinite\": 'L' and 'filename' exclude "
                          "each other; expected one of them");
        }
        const std::string name = list.text("filename", "");
        const Place place = list.place_of("filename");
        light.image = context.assets.find(name, place.file, place, "environment image");
        context.assets.count(light.image, place);
        light.radiance = constant_spectrum(0);
        if (illuminance > 0) {
            context.messages.stand_in(list.place_of("illuminance"),
                                      "LightSource \"infinite\": the illuminance of an image is "
                                      "not modelled; its scale stands as it is");
        }
    } else {
        // Constant radiance L gives the patch pi L.
        if (illuminance > 0) light.scale *= illuminance / std::numbers::pi;
        light.radiance = times(light_spectrum(list, "L", context), light.scale);
        light.scale = 1;
    }
    scene.infinite_lights.push_back(std::move(light));
}

}  // namespace

void build_light(const std::string& name, ParameterList& list, const glm::dmat4& world_from_light,
                 BuildContext& context, Scene& scene) {
    check_matrix(world_from_light, list.place());
    const std::vector<std::string> known = known_parameters("LightSource", name);
    if (name == "distant") {
        build_distant(list, world_from_light, context, scene);
    } else if (name == "infinite") {
        build_infinite(list, world_from_light, context, scene);
    } else {
        context.messages.stand_in(
            list.place(), fmt::format("LightSource \"{}\" is not modelled; it is left out", name));
        list.ignore(known);
        return;
    }
    list.finish(known, context.messages);
}

AreaLightRecipe build_area_light(const std::string& name, ParameterList& list,
                                 BuildContext& context) {
    AreaLightRecipe recipe;
    recipe.light.place = list.place();
    recipe.light.two_sided = list.boolean("twosided", false);
    recipe.light.radiance =
        times(light_spectrum(list, "L", context), list.number_in("scale", 1, 0, brightest));
    recipe.power = target(list, "power");
    if (list.has("filename")) {
        list.text("filename", "");
        context.messages.stand_in(list.place_of("filename"),
                                  "AreaLightSource \"diffuse\": an image is not modelled; constant "
                                  "radiance stands in");
    }
    list.finish(known_parameters("AreaLightSource", name), context.messages);
    return recipe;
}

AreaLight area_light_on(const AreaLightRecipe& recipe, double area) {
    AreaLight light = recipe.light;
    if (recipe.power > 0) {
        const double sides = light.two_sided ? 2 : 1;
        light.radiance = times(light.radiance, recipe.power / (std::numbers::pi * area * sides));
    }
    return light;
}

}  // namespace drude
