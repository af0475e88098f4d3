// Film "rgb", "spectral", "gbuffer": the size of the picture and its name. What a picture holds is
// a matter of the command that renders it, not of the scene.
#include "scene/builders.h"
#include "scene/vocabulary.h"

namespace drude {

Film build_film(const std::string& name, ParameterList& list, Messages& messages) {
    constexpr int largest = 65536;
    Film film;
    film.width = list.integer_in("xresolution", film.width, 1, largest);
    film.height = list.integer_in("yresolution", film.height, 1, largest);
    film.filename = list.text("filename", "");
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
    return film;
}

}  // namespace drude
