// How polarised a light is: "float dop" and "float aolp" of any light; of an infinite light also
// "string polarisation" "rayleigh" with "vector3 sun", whose "dop" is the highest there is, at a
// right angle to the sun.
#include <glm/geometric.hpp>

#include "base/numbers.h"
#include "scene/builders.h"

namespace drude {

LightPolarisation read_light_polarisation(ParameterList& list) {
    LightPolarisation polarisation;
    polarisation.dop = list.number_in("dop", 0, 0, 1);
    polarisation.aolp_deg = list.number_in("aolp", 0, -360, 360);
    if (list.has("aolp") && !list.has("dop")) {
        user_error_at(list.place_of("aolp"),
                      "{}: aolp without \"float dop\"; expected the degree of polarisation, 0 to 1",
                      list.owner());
    }
    return polarisation;
}

void read_sky_polarisation(ParameterList& list, InfiniteLight* light) {
    const std::string kind = list.text("polarisation", "uniform");
    if (kind == "uniform") {
        light->polarisation = read_light_polarisation(list);
        if (list.has("sun")) {
            user_error_at(list.place_of("sun"),
                          "{}: a sun without \"string polarisation\" \"rayleigh\"; expected both",
                          list.owner());
        }
        return;
    }
    if (kind != "rayleigh") {
        user_error_at(list.place_of("polarisation"),
                      "{}: there is no polarisation '{}'{}; expected 'rayleigh' (a clear sky) or "
                      "'uniform' (dop and aolp everywhere)",
                      list.owner(), shown(kind), did_you_mean(kind, {"rayleigh", "uniform"}));
    }
    if (list.has("aolp")) {
        user_error_at(list.place_of("aolp"),
                      "{}: aolp beside the polarisation \"rayleigh\", which has an angle of its "
                      "own everywhere; expected one of them",
                      list.owner());
    }
    RayleighPattern pattern;
    pattern.maximum = list.number_in("dop", 1, 0, 1);
    if (const Parameter* sun = list.values("sun", ParameterType::vector3)) {
        if (sun->numbers.size() != 3) {
            user_error_at(sun->place_of(3), "{}: \"vector3 sun\" has {} values; expected 3",
                          list.owner(), sun->numbers.size());
        }
        const glm::dvec3 towards(sun->numbers[0], sun->numbers[1], sun->numbers[2]);
        const double length = glm::length(towards);
        if (!(length > 0) || !std::isfinite(length)) {
            user_error_at(sun->place, "{}: the sun is at {} {} {}, which is no direction",
                          list.owner(), format_double(towards.x), format_double(towards.y),
                          format_double(towards.z));
        }
        pattern.sun = towards / length;
    }
    light->rayleigh = pattern;
}

}  // namespace drude
