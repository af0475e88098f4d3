#include "scene/material_parts.h"

#include <algorithm>
#include <cmath>

#include "base/numbers.h"
#include "scene/spectra.h"

namespace drude {

namespace {

// One of the three parameters; a texture's typical value is held in range.
NumberValue roughness_value(ParameterList& list, const std::string& name,
                            const NumberValue& otherwise, BuildContext& context) {
    if (!list.has(name)) return otherwise;
    NumberValue value = number_value(list, name, 0, context);
    if (value.texture >= 0) {
        value.constant = std::clamp(value.constant, 0.0, 10.0);
    } else if (!(value.constant >= 0 && value.constant <= 10)) {
        user_error_at(list.place_of(name), "{}: roughness {}; expected 0 to 10", list.owner(),
                      format_double(value.constant));
    }
    return value;
}

void note_direction(const ParameterList& list, const std::string& prefix, const std::string& what,
                    BuildContext& context) {
    const std::string u = prefix + "uroughness";
    context.messages.stand_in(
        list.has(u) ? list.place_of(u) : list.place_of(prefix + "vroughness"),
        fmt::format("{}: a roughness that depends on direction is not modelled; {}", list.owner(),
                    what));
}

}  // namespace

RoughnessFound read_roughness(ParameterList& list, const std::string& prefix,
                              BuildContext& context) {
    const bool remap = list.boolean("remaproughness", true);
    const NumberValue both = roughness_value(list, prefix + "roughness", {0}, context);
    const NumberValue u = roughness_value(list, prefix + "uroughness", both, context);
    const NumberValue v = roughness_value(list, prefix + "vroughness", both, context);
    const auto alpha_of = [&](const NumberValue& roughness) {
        return remap ? std::sqrt(roughness.constant) : roughness.constant;
    };
    if (u.texture >= 0 || v.texture >= 0) {
        const bool first = u.texture >= 0;
        if (u.texture != v.texture) {
            note_direction(list, prefix,
                           fmt::format("that of {} stands in for both", first ? "u" : "v"),
                           context);
        }
        return {alpha_of(first ? u : v), Roughness{first ? u : v, remap}};
    }
    if (alpha_of(u) == alpha_of(v)) return {alpha_of(u), {}};
    const double alpha = std::sqrt(alpha_of(u) * alpha_of(v));
    note_direction(list, prefix,
                   fmt::format("its geometric mean, alpha {}, stands in", format_double(alpha)),
                   context);
    return {alpha, {}};
}

double read_alpha(ParameterList& list, const std::string& prefix, BuildContext& context) {
    const RoughnessFound found = read_roughness(list, prefix, context);
    if (found.textured) {
        context.messages.stand_in(
            list.place(), fmt::format("{}: its roughness cannot change over a surface; one that is "
                                      "typical of the texture, alpha {}, stands in",
                                      list.owner(), format_double(found.alpha)));
    }
    return found.alpha;
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
