// LightSource and AreaLightSource.
//
// Scales follow pbrt-v4 (lights.cpp, Create): a light's spectrum is brought to luminance 1 (see
// light_spectrum), then multiplied by "scale"; "illuminance" multiplies what is then left so that a
// patch facing the light (the upper half of an infinite light) receives that many lux in pbrt's
// unit, the Y of spectrum_to_xyz; "power" likewise with lumen.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "base/numbers.h"
#include "image/equal_area.h"
#include "image/image.h"
#include "scene/builders.h"
#include "scene/spectra.h"
#include "scene/transforms.h"
#include "scene/vocabulary.h"

namespace drude {

namespace {

constexpr double brightest = 1e15;
// Of a light with all its factors; what is above overflows in single precision.
constexpr double brightest_product = 1e20;

DenseSpectrum times(DenseSpectrum spectrum, double factor) {
    for (double& value : spectrum) value *= factor;
    return spectrum;
}

// The spectrum of a light with its scale.
DenseSpectrum scaled(const DenseSpectrum& spectrum, double scale, const ParameterList& list) {
    DenseSpectrum result = times(spectrum, scale);
    const double most = *std::max_element(result.begin(), result.end());
    if (!(most <= brightest_product)) {
        user_error_at(list.place(),
                      "{}: its spectrum and its scales come to {} together; expected at most {}",
                      list.owner(), format_double(most), format_double(brightest_product));
    }
    return result;
}

// pbrt takes 0 and less as "not given".
double target(ParameterList& list, const std::string& name) {
    return list.number_in(name, -1, -brightest, brightest);
}

// The direction from one point to another, in the world.
glm::dvec3 axis_of(const ParameterList& list, const glm::dvec3& from, const glm::dvec3& to,
                   const glm::dmat4& world_from_light) {
    const double distance = glm::length(to - from);
    if (!(distance > 0) || !std::isfinite(distance)) {
        user_error_at(list.place(),
                      "{}: 'from' and 'to' give no direction; expected two different points",
                      list.owner());
    }
    return glm::normalize(transform_vector(world_from_light, (to - from) / distance));
}

void build_distant(ParameterList& list, const glm::dmat4& world_from_light, BuildContext& context,
                   Scene& scene) {
    DistantLight light;
    light.place = list.place();
    double scale = list.number_in("scale", 1, 0, brightest);
    const double illuminance = target(list, "illuminance");
    if (illuminance > 0) scale *= illuminance;
    light.irradiance = scaled(light_spectrum(list, "L", context), scale, list);
    light.direction = axis_of(list, list.point3("from", {0, 0, 0}), list.point3("to", {0, 0, 1}),
                              world_from_light);
    light.x_axis = glm::normalize(glm::dvec3(world_from_light[0]));
    // Along its own x it would have no angle zero: there its y serves.
    if (glm::length(glm::cross(light.x_axis, light.direction)) < 1e-4) {
        light.x_axis = glm::normalize(glm::dvec3(world_from_light[1]));
    }
    light.polarisation = read_light_polarisation(list);
    scene.distant_lights.push_back(std::move(light));
}

// Whether a transformation keeps angles.
bool is_similarity(const glm::dmat4& matrix) {
    const glm::dmat3 axes(matrix);
    const double size = glm::dot(axes[0], axes[0]);
    for (int i = 0; i < 3; ++i) {
        if (std::abs(glm::dot(axes[i], axes[i]) - size) > 1e-6 * size) return false;
        if (std::abs(glm::dot(axes[i], axes[(i + 1) % 3])) > 1e-6 * size) return false;
    }
    return true;
}

// The integral of a spot's falloff over all directions, in steradians (its smooth step is 1/2 on
// average over the cosine); of a point light 4 pi.
double cone(const PointLight& light) {
    return 2 * std::numbers::pi * (1 - light.cos_start + (light.cos_start - light.cos_end) / 2);
}

void build_point(const std::string& name, ParameterList& list, const glm::dmat4& world_from_light,
                 BuildContext& context, Scene& scene) {
    PointLight light;
    light.place = list.place();
    const glm::dvec3 from = list.point3("from", {0, 0, 0});
    light.position = transform_point(world_from_light, from);
    light.x_axis = glm::normalize(glm::dvec3(world_from_light[0]));
    if (name == "spot") {
        light.axis = axis_of(list, from, list.point3("to", {0, 0, 1}), world_from_light);
        const double end = list.number_in("coneangle", 30, 1e-3, 180);
        // pbrt takes a falloff wider than the cone for one that never ends within.
        const double start = std::max(0.0, end - list.number_in("conedeltaangle", 5, 0, 180));
        light.cos_end = std::cos(end * degree);
        light.cos_start = std::cos(start * degree);
        if (!is_similarity(world_from_light)) {
            context.messages.stand_in(
                list.place(),
                "LightSource \"spot\": a cone that a transformation stretches "
                "is not modelled; a round cone stands in");
        }
    }
    double scale = list.number_in("scale", 1, 0, brightest);
    if (const double power = target(list, "power"); power > 0) scale *= power / cone(light);
    light.intensity = scaled(light_spectrum(list, "I", context), scale, list);
    light.polarisation = read_light_polarisation(list);
    scene.point_lights.push_back(std::move(light));
}

// Of a picture, in units of its own: what a patch receives that faces the light's +z, the Y of its
// linear sRGB. Texels are constant over their part of the sphere.
double upper_illuminance(const Image& image, const std::string& where) {
    const Channel* grey = image.find("Y");
    const Channel* rgb[3];
    for (int c = 0; c < 3; ++c) {
        const std::string channel(1, "RGB"[c]);
        rgb[c] = grey && !image.find(channel) ? grey : &image.at(channel, where);
    }
    const auto luminance = [&](size_t texel) {
        RGB value;
        for (size_t c = 0; c < 3; ++c) {
            const auto v = static_cast<double>(rgb[c]->data[texel]);
            value[c] = v >= 0 && std::isfinite(v) ? v : 0;
        }
        return rgb_to_xyz(value)[1];
    };
    double sum = 0;
    const bool lat_long = image.width == 2 * image.height;
    // Within a texel of the square the cosine is summed over a grid of points.
    const int grid = lat_long ? 1 : std::max(1, 256 / image.width);
    for (int y = 0; y < image.height; ++y) {
        // The integral of the cosine over the row: sin^2 of its ends, of what is above the horizon.
        const double top = std::min(0.5, static_cast<double>(y) / image.height) * std::numbers::pi;
        const double bottom =
            std::min(0.5, static_cast<double>(y + 1) / image.height) * std::numbers::pi;
        const double row =
            std::numbers::pi / image.width * std::sin(bottom - top) * std::sin(bottom + top);
        for (int x = 0; x < image.width; ++x) {
            double weight = row;
            if (!lat_long) {
                weight = 0;
                for (int i = 0; i < grid * grid; ++i) {
                    const int column = i % grid, line = i / grid;
                    const glm::dvec2 p((x + (column + 0.5) / grid) / image.width,
                                       (y + (line + 0.5) / grid) / image.height);
                    weight += std::max(0.0, equal_area_direction(p).z);
                }
                weight *=
                    4 * std::numbers::pi / (static_cast<double>(image.pixels()) * grid * grid);
            }
            if (weight > 0) sum += weight * luminance(static_cast<size_t>(y) * image.width + x);
        }
    }
    return sum;
}

// The picture is read for that, and kept.
void scale_picture(InfiniteLight* light, double illuminance, const Place& place,
                   BuildContext& context) {
    light->picture = std::make_shared<const Image>(read_image(light->image));
    const double own = upper_illuminance(*light->picture, light->image);
    if (!(own > 0) || !std::isfinite(own)) {
        user_error_at(place,
                      "LightSource \"infinite\": the upper half of {} gives an illuminance of {}, "
                      "which nothing brings to {}; expected a picture with light above",
                      light->image, format_double(own), format_double(illuminance));
    }
    light->scale *= illuminance / own;
    if (!(light->scale <= brightest_product)) {
        user_error_at(place, "LightSource \"infinite\": its scale comes to {}; expected at most {}",
                      format_double(light->scale), format_double(brightest_product));
    }
    context.messages.note(place,
                          fmt::format("LightSource \"infinite\": the picture is scaled so that an "
                                      "upward patch receives an illuminance of {}; pbrt-v4 takes "
                                      "half the solid angle and makes it twice as bright",
                                      format_double(illuminance)));
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
            scale_picture(&light, illuminance, list.place_of("illuminance"), context);
        }
    } else {
        // Constant radiance L gives the patch pi L.
        if (illuminance > 0) light.scale *= illuminance / std::numbers::pi;
        light.radiance = scaled(light_spectrum(list, "L", context), light.scale, list);
        light.scale = 1;
    }
    if (const Parameter* portal = list.values("portal", ParameterType::point3)) {
        context.messages.stand_in(portal->place,
                                  "LightSource \"infinite\": a portal is not modelled; light comes "
                                  "from everywhere, not through the portal alone");
    }
    read_sky_polarisation(list, &light);
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
    } else if (name == "point" || name == "spot") {
        build_point(name, list, world_from_light, context, scene);
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
        scaled(light_spectrum(list, "L", context), list.number_in("scale", 1, 0, brightest), list);
    recipe.power = target(list, "power");
    recipe.light.polarisation = read_light_polarisation(list);
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
        const double most = *std::max_element(light.radiance.begin(), light.radiance.end());
        if (!(most <= brightest_product)) {
            user_error_at(light.place,
                          "AreaLightSource: its power on a shape of area {} comes to a radiance of "
                          "{}; expected at most {}",
                          format_double(area), format_double(most),
                          format_double(brightest_product));
        }
    }
    return light;
}

}  // namespace drude
