#include "scene/material_parts.h"

#include <cmath>

#include "base/numbers.h"
#include "scene/spectra.h"

namespace drude {

double read_alpha(ParameterList& list, const std::string& prefix, BuildContext& context) {
    const bool remap = list.boolean("remaproughness", true);
    const double both = number_or_texture(list, prefix + "roughness", 0, context);
    const double u = number_or_texture(list, prefix + "uroughness", both, context);
    const double v = number_or_texture(list, prefix + "vroughness", both, context);
    for (const double roughness : {both, u, v}) {
        if (!(roughness >= 0 && roughness <= 10)) {
            user_error_at(list.place_of(prefix + "roughness"), "{}: roughness {}; expected 0 to 10",
                          list.owner(), format_double(roughness));
        }
    }
    const auto alpha_of = [&](double roughness) {
        return remap ? std::sqrt(roughness) : roughness;
    };
    const double alpha_u = alpha_of(u), alpha_v = alpha_of(v);
    if (alpha_u == alpha_v) return alpha_u;
    const double alpha = std::sqrt(alpha_u * alpha_v);
    context.messages.stand_in(
        list.place_of(prefix + "uroughness"),
        fmt::format("{}: a roughness that depends on direction is not modelled; its geometric "
                    "mean, alpha {}, stands in",
                    list.owner(), format_double(alpha)));
    return alpha;
}

DenseSpectrum read_eta(ParameterList& list, const std::string& name, BuildContext& context) {
    const Parameter* parameter =
        list.any_of(name, {ParameterType::number, ParameterType::spectrum, ParameterType::rgb});
    DenseSpectrum eta = constant_spectrum(1.5);
    if (parameter == nullptr) return eta;
    if (parameter->type == ParameterType::number) {
        eta = constant_spectrum(list.number(name, 1.5));
    } else {
        eta = matter_spectrum(*parameter, context);
    }
    for (const double value : eta) {
        if (!(value >= 0.1 && value <= 10)) {
            user_error_at(parameter->place_of(0),
                          "{}: {} is {}; expected a refractive index of 0.1 to 10", list.owner(),
                          name, format_double(value));
        }
    }
    return eta;
}

}  // namespace drude
