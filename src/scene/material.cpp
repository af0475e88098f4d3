// Material and MakeNamedMaterial: which builder serves, and what stands in where none does.
#include "scene/builders.h"
#include "scene/plugin_surface.h"
#include "scene/spectra.h"
#include "scene/vocabulary.h"

namespace drude {

namespace {

SurfaceMaterial diffuse_stand_in(const std::string& name, ParameterList& list,
                                 BuildContext& context) {
    // Those with a diffuse base keep its colour.
    const bool has_base =
        (name == "coateddiffuse" || name == "diffusetransmission") && list.has("reflectance");
    context.messages.stand_in(
        list.place(), fmt::format("Material \"{}\" is not modelled; a diffuse surface of {} stands "
                                  "in",
                                  name, has_base ? "its reflectance" : "reflectance 0.5"));
    DiffuseMaterial diffuse{{constant_spectrum(0.5)}};
    if (has_base) diffuse.reflectance.constant = reflectance(list, "reflectance", 0.5, context);
    list.ignore(known_parameters("Material", name));
    return diffuse;
}

}  // namespace

std::optional<SurfaceMaterial> build_material(const std::string& name, ParameterList& list,
                                              BuildContext& context) {
    if (!name.empty() && !is_known_name("Material", name)) {
        return build_plugin_material(name, find_plugin(name), list, context);
    }
    const std::vector<std::string> known = known_parameters("Material", name);
    if (name.empty() || name == "interface") {
        list.finish(known, context.messages);
        return {};
    }
    if (name == "diffuse") {
        DiffuseMaterial diffuse{{reflectance(list, "reflectance", 0.5, context)}};
        list.finish(known, context.messages);
        return diffuse;
    }
    if (name == "conductor") {
        ConductorMaterial conductor = build_conductor(list, "", context);
        list.finish(known, context.messages);
        return conductor;
    }
    if (name == "coatedconductor") {
        context.messages.stand_in(list.place(),
                                  "Material \"coatedconductor\" is not modelled; its conductor "
                                  "without the coat stands in");
        ConductorMaterial conductor = build_conductor(list, "conductor.", context);
        list.ignore(known);
        return conductor;
    }
    return diffuse_stand_in(name, list, context);
}

}  // namespace drude
