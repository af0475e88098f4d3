// Film "rgb", "spectral", "gbuffer": the size of the picture, the part of it that is rendered, its
// name, and what the scene wants in it beside colours.
#include <algorithm>
#include <cmath>

#include "base/numbers.h"
#include "scene/builders.h"
#include "scene/vocabulary.h"

namespace drude {

namespace {

// Four numbers x0 x1 y0 y1, each range ascending; nullptr where the parameter is not there.
const Parameter* range(ParameterList& list, std::string_view name, ParameterType type) {
    const Parameter* parameter = list.values(name, type);
    if (parameter == nullptr) return nullptr;
    if (parameter->numbers.size() != 4) {
        user_error_at(parameter->place, "{}: {} has {} values; expected 4: x0 x1 y0 y1",
                      list.owner(), name, parameter->numbers.size());
    }
    for (size_t i = 0; i < 4; i += 2) {
        if (parameter->numbers[i] < parameter->numbers[i + 1]) continue;
        user_error_at(parameter->place_of(i),
                      "{}: {} runs from {} to {}; expected the smaller first", list.owner(), name,
                      format_double(parameter->numbers[i]),
                      format_double(parameter->numbers[i + 1]));
    }
    return parameter;
}

// As pbrt-v4 has it: cropwindow, in fractions of the picture, overrules pixelbounds.
void read_crop(ParameterList& list, Messages& messages, FilmRecipe* recipe) {
    const int size[2] = {recipe->film.width, recipe->film.height};
    int bounds[4] = {0, size[0], 0, size[1]};
    const Parameter* used = nullptr;
    if (const Parameter* pixels = range(list, "pixelbounds", ParameterType::integer)) {
        used = pixels;
        for (size_t i = 0; i < 4; ++i) {
            const int side = size[i / 2];
            bounds[i] =
                static_cast<int>(std::clamp(pixels->numbers[i], 0.0, static_cast<double>(side)));
            if (bounds[i] != pixels->numbers[i]) {
                messages.note(pixels->place,
                              fmt::format("{}: pixelbounds reach beyond the picture of {} x {} "
                                          "pixels; they end at its edges, as in pbrt-v4",
                                          list.owner(), size[0], size[1]));
            }
        }
    }
    if (const Parameter* window = range(list, "cropwindow", ParameterType::number)) {
        if (used != nullptr) {
            messages.note(window->place, fmt::format("{}: cropwindow overrules pixelbounds, as in "
                                                     "pbrt-v4",
                                                     list.owner()));
        }
        used = window;
        for (size_t i = 0; i < 4; ++i) {
            const double fraction = window->numbers[i];
            if (!(fraction >= 0 && fraction <= 1)) {
                user_error_at(window->place_of(i),
                              "{}: cropwindow has {}; expected fractions of the picture, 0 to 1 "
                              "(pixelbounds takes pixels)",
                              list.owner(), format_double(fraction));
            }
            const int side = size[i / 2];
            bounds[i] = static_cast<int>(std::ceil(fraction * side));
        }
    }
    if (used == nullptr) return;
    if (bounds[0] >= bounds[1] || bounds[2] >= bounds[3]) {
        user_error_at(used->place, "{}: {} holds no pixel of the {} x {}; expected one at least",
                      list.owner(), used->name, size[0], size[1]);
    }
    std::copy(bounds, bounds + 4, recipe->bounds);
    messages.note(used->place,
                  fmt::format("{}: of the picture's {} x {} pixels those from ({}, {}) are "
                              "rendered, as a picture of {} x {}",
                              list.owner(), size[0], size[1], bounds[0], bounds[2],
                              bounds[1] - bounds[0], bounds[3] - bounds[2]));
}

void read_spectral(ParameterList& list, Messages& messages, Film* film) {
    film->spectral = true;
    const int buckets = list.integer_in("nbuckets", 16, 1, 100000);
    const double first = list.number("lambdamin", 360), last = list.number("lambdamax", 830);
    if (!(first > 0 && first < last)) {
        user_error_at(list.place_of(list.has("lambdamax") ? "lambdamax" : "lambdamin"),
                      "{}: lambdamin is {} and lambdamax {}; expected wavelengths in nm, the "
                      "smaller first",
                      list.owner(), format_double(first), format_double(last));
    }
    if (buckets != 40 || first != spectrum_first_nm || last != spectrum_last_nm) {
        messages.stand_in(
            list.place(),
            fmt::format("{}: {} layers from {} to {} nm are not written; 40 layers of 10 nm from "
                        "{} to {} nm stand in",
                        list.owner(), buckets, format_double(first), format_double(last),
                        spectrum_first_nm, spectrum_last_nm));
    }
}

void read_gbuffer(ParameterList& list, Film* film) {
    film->gbuffer = true;
    const std::string system = list.text("coordinatesystem", "camera");
    film->gbuffer_in_world = system == "world";
    if (!film->gbuffer_in_world && system != "camera") {
        user_error_at(list.place_of("coordinatesystem"),
                      "{}: there is no coordinatesystem '{}'{}; expected 'camera' or 'world'",
                      list.owner(), shown(system), did_you_mean(system, {"camera", "world"}));
    }
}

}  // namespace

FilmRecipe build_film(const std::string& name, ParameterList& list, Messages& messages) {
    constexpr int largest = 65536;
    FilmRecipe recipe;
    Film& film = recipe.film;
    film.width = list.integer_in("xresolution", film.width, 1, largest);
    film.height = list.integer_in("yresolution", film.height, 1, largest);
    film.filename = list.text("filename", "");
    const int bounds[4] = {0, film.width, 0, film.height};
    std::copy(bounds, bounds + 4, recipe.bounds);
    read_crop(list, messages, &recipe);
    if (name == "spectral") read_spectral(list, messages, &film);
    if (name == "gbuffer") read_gbuffer(list, &film);
    // The film's diagonal matters to lens systems only, which have their own message.
    list.number("diagonal", 35);
    const std::string sensor = list.text("sensor", "cie1931");
    if (sensor != "cie1931") {
        messages.stand_in(list.place_of("sensor"),
                          fmt::format("Film \"{}\": the sensor '{}' is not modelled; the CIE 1931 "
                                      "observer stands in",
                                      name, shown(sensor)));
    }
    list.finish(known_parameters("Film", name), messages);
    return recipe;
}

}  // namespace drude
