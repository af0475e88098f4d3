// Materials that light goes into or through: dielectrics, coats, transmitting diffusers.
//
//   "dielectric"           eta, roughness (uroughness, vroughness, remaproughness)
//   "thindielectric"       eta
//   "coatedconductor"      interface.eta, interface.roughness, thickness; the metal's parameters
//                          behind "conductor.", or reflectance
//   "coateddiffuse"        eta, roughness, thickness; reflectance
//   "diffusetransmission"  reflectance, transmittance, scale
#include <algorithm>

#include "base/numbers.h"
#include "scene/builders.h"
#include "scene/material_parts.h"
#include "scene/spectra.h"

namespace drude {

DielectricMaterial build_dielectric(ParameterList& list, BuildContext& context) {
    DielectricMaterial glass;
    glass.eta = read_eta(list, "eta", context);
    glass.alpha = read_alpha(list, "", context);
    return glass;
}

ThinDielectricMaterial build_thin_dielectric(ParameterList& list, BuildContext& context) {
    return {read_eta(list, "eta", context)};
}

CoatedMaterial build_coated(ParameterList& list, bool on_metal, BuildContext& context) {
    const std::string prefix = on_metal ? "interface." : "";
    CoatedMaterial coated;
    coated.eta = read_eta(list, prefix + "eta", context);
    coated.alpha = read_alpha(list, prefix, context);
    coated.thickness = list.number_in("thickness", 0.01, 0, 1e6);
    // A medium in the coat scatters where it has an albedo; g says how.
    const Parameter* albedo = list.any_of(
        "albedo", {ParameterType::rgb, ParameterType::spectrum, ParameterType::texture});
    if (albedo != nullptr) {
        const DenseSpectrum values = matter_spectrum(*albedo, context);
        if (std::any_of(values.begin(), values.end(), [](double a) { return a != 0; })) {
            context.messages.stand_in(
                albedo->place, fmt::format("{}: a coat that scatters light is not modelled; a "
                                           "clear one stands in",
                                           list.owner()));
        }
    }
    number_or_texture(list, "g", 0, context);
    if (on_metal) {
        coated.base = build_conductor(list, "conductor.", context);
    } else {
        coated.base = DiffuseMaterial{reflectance_value(list, "reflectance", 0.5, context)};
    }
    return coated;
}

namespace {

// `value` times a number, in place; a texture gets one more on top of it.
void scale_by(double factor, SpectrumValue* value, BuildContext& context) {
    if (factor == 1) return;
    if (value->texture >= 0) {
        Textures& textures = context.textures;
        const int visits = textures.spectrum_visits[value->texture] + 1;
        textures.spectrum_textures.emplace_back(ScaleTexture<SpectrumValue>{*value, {factor, -1}});
        textures.spectrum_visits.push_back(visits);
        value->texture = static_cast<int>(textures.spectrum_textures.size()) - 1;
    }
    for (double& v : value->constant) v *= factor;
}

}  // namespace

DiffuseTransmissionMaterial build_diffuse_transmission(ParameterList& list, BuildContext& context) {
    DiffuseTransmissionMaterial diffuser{reflectance_value(list, "reflectance", 0.25, context),
                                         reflectance_value(list, "transmittance", 0.25, context)};
    const double scale = list.number_in("scale", 1, 0, 1e6);
    scale_by(scale, &diffuser.reflectance, context);
    scale_by(scale, &diffuser.transmittance, context);
    double most = 0;
    for (int i = 0; i < spectrum_size; ++i) {
        most =
            std::max(most, diffuser.reflectance.constant[i] + diffuser.transmittance.constant[i]);
    }
    if (most > 1 + 1e-6) {
        context.messages.stand_in(
            list.place(),
            fmt::format("{}: reflectance and transmittance come to {} together, more light than "
                        "there is; both divided by that stand in",
                        list.owner(), format_double(most)));
        scale_by(1 / most, &diffuser.reflectance, context);
        scale_by(1 / most, &diffuser.transmittance, context);
    }
    return diffuser;
}

}  // namespace drude
