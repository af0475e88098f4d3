// Shape: which builder serves.
#include "scene/builders.h"
#include "scene/vocabulary.h"

namespace drude {

namespace {

std::optional<ShapeGeometry> build_geometry(const std::string& name, ParameterList& list,
                                            BuildContext& context) {
    if (name == "sphere") return build_sphere(list);
    if (name == "disk") return build_disk(list);
    if (name == "cylinder") return build_cylinder(list);
    if (name == "trianglemesh") return build_triangle_mesh(list, context.messages);
    if (name == "bilinearmesh") return build_bilinear_mesh(list, context.messages);
    if (name == "loopsubdiv") return build_loop_surface(list, context.messages);
    if (name == "plymesh") return build_ply_mesh(list, context);
    return {};
}

}  // namespace

std::optional<ShapeGeometry> build_shape(const std::string& name, ParameterList& list,
                                         BuildContext& context) {
    const std::vector<std::string> known = known_parameters("Shape", name);
    std::optional<ShapeGeometry> geometry = build_geometry(name, list, context);
    if (!geometry) {
        context.messages.stand_in(
            list.place(), fmt::format("Shape \"{}\" is not modelled; it is left out", name));
        list.ignore(known);
        return {};
    }
    if (const Parameter* alpha =
            list.any_of("alpha", {ParameterType::number, ParameterType::texture})) {
        if (alpha->type == ParameterType::texture || alpha->numbers[0] != 1) {
            context.messages.stand_in(alpha->place,
                                      fmt::format("Shape \"{}\": alpha is not modelled; the shape "
                                                  "is opaque everywhere",
                                                  name));
        }
    }
    list.finish(known, context.messages);
    return geometry;
}

}  // namespace drude
