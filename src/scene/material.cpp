// Material and MakeNamedMaterial: which builder serves, and what stands in where none does.
#include "scene/builders.h"
#include "scene/plugin_surface.h"
#include "scene/spectra.h"
#include "scene/vocabulary.h"

namespace drude {

namespace {

// Two names; both may be defined later.
MixMaterial build_mix(ParameterList& list, BuildContext& context) {
    const Parameter* names = list.values("materials", ParameterType::string);
    const size_t count = names == nullptr ? 0 : names->strings.size();
    if (count != 2) {
        user_error_at(list.place_of("materials"),
                      "{}: {} materials are named; expected \"string materials\" [ \"a\" \"b\" ]",
                      list.owner(), count);
    }
    MixMaterial mix;
    mix.first = context.material_named(names->strings[0], names->place_of(0));
    mix.second = context.material_named(names->strings[1], names->place_of(1));
    mix.amount = number_value(list, "amount", 0.5, context);
    if (mix.amount.texture < 0 && !(mix.amount.constant >= 0 && mix.amount.constant <= 1)) {
        user_error_at(list.place_of("amount"), "{}: amount is {}; expected 0 to 1", list.owner(),
                      mix.amount.constant);
    }
    return mix;
}

// Nothing where no builder serves.
std::optional<SurfaceMaterial> build_modelled(const std::string& name, ParameterList& list,
                                              BuildContext& context) {
    if (name == "diffuse") {
        return DiffuseMaterial{reflectance_value(list, "reflectance", 0.5, context)};
    }
    if (name == "conductor") return build_conductor(list, "", context);
    if (name == "dielectric") return build_dielectric(list, context);
    if (name == "thindielectric") return build_thin_dielectric(list, context);
    if (name == "coatedconductor" || name == "coateddiffuse") {
        return build_coated(list, name == "coatedconductor", context);
    }
    if (name == "diffusetransmission") return build_diffuse_transmission(list, context);
    if (name == "mix") return build_mix(list, context);
    if (name == "linearpolariser" || name == "retarder" || name == "circularpolariser") {
        return build_optical_element(name, list);
    }
    return {};
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
    if (std::optional<SurfaceMaterial> material = build_modelled(name, list, context)) {
        list.finish(known, context.messages);
        return material;
    }
    context.messages.stand_in(list.place(),
                              fmt::format("Material \"{}\" is not modelled; a diffuse surface of "
                                          "reflectance 0.5 stands in",
                                          name));
    list.ignore(known);
    return DiffuseMaterial{{constant_spectrum(0.5)}};
}

}  // namespace drude
