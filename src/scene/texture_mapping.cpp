// "mapping" of two-dimensional textures.
#include <cmath>
#include <glm/matrix.hpp>

#include "base/numbers.h"
#include "scene/builders.h"

namespace drude {

namespace {

// Whatever a surface's uv or position is, (s, t) stays finite.
constexpr double largest = 1e9;

double number(ParameterList& list, const char* name, double otherwise) {
    return list.number_in(name, otherwise, -largest, largest);
}

glm::dvec3 axis(ParameterList& list, const char* name, const glm::dvec3& otherwise) {
    const glm::dvec3 vector = list.vector3(name, otherwise);
    for (int i = 0; i < 3; ++i) {
        if (std::abs(vector[i]) <= largest) continue;
        user_error_at(list.place_of(name), "{}: {} is {} {} {}; expected numbers of at most {}",
                      list.owner(), name, format_double(vector.x), format_double(vector.y),
                      format_double(vector.z), format_double(largest));
    }
    return vector;
}

}  // namespace

TextureMapping build_mapping(ParameterList& list, const glm::dmat4& world_from_texture) {
    TextureMapping mapping;
    const std::string kind =
        list.choice("mapping", "uv", {"uv", "spherical", "cylindrical", "planar"});
    if (kind == "uv") {
        mapping.scale_u = number(list, "uscale", 1);
        mapping.scale_v = number(list, "vscale", 1);
    } else {
        mapping.kind = kind == "spherical"     ? TextureMapping::Kind::spherical
                       : kind == "cylindrical" ? TextureMapping::Kind::cylindrical
                                               : TextureMapping::Kind::planar;
        mapping.texture_from_world = glm::inverse(world_from_texture);
    }
    if (kind == "planar") {
        mapping.v1 = axis(list, "v1", mapping.v1);
        mapping.v2 = axis(list, "v2", mapping.v2);
    }
    if (kind == "uv" || kind == "planar") {
        mapping.delta_u = number(list, "udelta", 0);
        mapping.delta_v = number(list, "vdelta", 0);
    }
    return mapping;
}

}  // namespace drude
