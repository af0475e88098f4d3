// "mapping" of two-dimensional textures.
#include <glm/matrix.hpp>

#include "scene/builders.h"

namespace drude {

TextureMapping build_mapping(ParameterList& list, const glm::dmat4& world_from_texture) {
    TextureMapping mapping;
    const std::string kind =
        list.choice("mapping", "uv", {"uv", "spherical", "cylindrical", "planar"});
    if (kind == "uv") {
        mapping.scale_u = list.number("uscale", 1);
        mapping.scale_v = list.number("vscale", 1);
    } else {
        mapping.kind = kind == "spherical"     ? TextureMapping::Kind::spherical
                       : kind == "cylindrical" ? TextureMapping::Kind::cylindrical
                                               : TextureMapping::Kind::planar;
        mapping.texture_from_world = glm::inverse(world_from_texture);
    }
    if (kind == "planar") {
        mapping.v1 = list.vector3("v1", mapping.v1);
        mapping.v2 = list.vector3("v2", mapping.v2);
    }
    if (kind == "uv" || kind == "planar") {
        mapping.delta_u = list.number("udelta", 0);
        mapping.delta_v = list.number("vdelta", 0);
    }
    return mapping;
}

}  // namespace drude
