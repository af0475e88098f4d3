#include "scene/spectra.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/numbers.h"

namespace drude {

namespace {

// Outside its table a spectrum keeps its end values (pbrt-v4 has 0 there); said where it matters.
void note_range(const SampledTable& table, const Place& place, Messages& messages) {
    const bool short_below =
        table.wavelength_nm.front() > spectrum_first_nm && table.values.front() != 0;
    const bool short_above =
        table.wavelength_nm.back() < spectrum_last_nm && table.values.back() != 0;
    if (!short_below && !short_above) return;
    messages.note(place, fmt::format("the spectrum {} covers {} to {} nm of {} to {} nm; its end "
                                     "values are held outside",
                                     table.name, format_double(table.wavelength_nm.front()),
                                     format_double(table.wavelength_nm.back()), spectrum_first_nm,
                                     spectrum_last_nm));
}

DenseSpectrum scaled(DenseSpectrum spectrum, double factor) {
    for (double& value : spectrum) value *= factor;
    return spectrum;
}

DenseSpectrum blackbody_of(const Parameter& parameter) {
    const double kelvin = parameter.numbers[0];
    if (!(kelvin >= 100 && kelvin <= 1e6)) {
        user_error_at(parameter.place_of(0), "blackbody of {} K; expected 100 to 1000000",
                      format_double(kelvin));
    }
    return blackbody(kelvin);
}

RGB rgb_of(const Parameter& parameter) {
    if (parameter.numbers.size() != 3) {
        user_error_at(parameter.place_of(3), "\"rgb {}\" has {} values; expected 3", parameter.name,
                      parameter.numbers.size());
    }
    return {parameter.numbers[0], parameter.numbers[1], parameter.numbers[2]};
}

// The RGB of a parameter in linear sRGB, inside [0, highest] where it was inside that in its own
// colour space.
RGB srgb_of(const Parameter& parameter, const RGB& own, const RGB& converted, double highest,
            BuildContext& context) {
    if (std::any_of(own.begin(), own.end(), [&](double v) { return !(v >= 0 && v <= highest); })) {
        return converted;
    }
    const RGB inside = into_gamut(converted, highest);
    double change = 0, size = 1;
    for (size_t c = 0; c < 3; ++c) {
        change = std::max(change, std::abs(inside[c] - converted[c]));
        size = std::max(size, std::abs(converted[c]));
    }
    if (change > 1e-6 * size) {
        context.messages.stand_in(
            parameter.place,
            fmt::format("'{}': the colour {} {} {} of the ColorSpace \"{}\" is outside sRGB, whose "
                        "primaries the spectra of colours are made of; a paler one of the same "
                        "luminance stands in",
                        parameter.name, format_double(own[0]), format_double(own[1]),
                        format_double(own[2]), colour_space_name(parameter.colour_space)));
    }
    return inside;
}

// A colour of matter. Above 1 it may be anything (an index of refraction), but never negative.
RGB matter_rgb(const Parameter& parameter, const RGB& own, BuildContext& context) {
    const RGB converted = matter_to_srgb(parameter.colour_space, own);
    if (parameter.colour_space == ColourSpace::srgb) return converted;
    const double most = *std::max_element(own.begin(), own.end());
    return srgb_of(parameter, own, converted, most <= 1 ? 1 : std::numeric_limits<double>::max(),
                   context);
}

RGB light_rgb(const Parameter& parameter, BuildContext& context) {
    const RGB own = rgb_of(parameter);
    const RGB converted = light_to_srgb(parameter.colour_space, own);
    if (parameter.colour_space == ColourSpace::srgb) return converted;
    return srgb_of(parameter, own, converted, std::numeric_limits<double>::max(), context);
}

template <class Value>
const Value& named_texture(const Parameter& parameter,
                           const std::map<std::string, Value, std::less<>>& textures,
                           std::string_view kind) {
    const std::string& name = parameter.strings[0];
    const auto found = textures.find(name);
    if (found != textures.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& entry : textures) names.push_back(entry.first);
    user_error_at(parameter.place_of(0),
                  "there is no {} texture '{}'{}; expected one that is defined before", kind,
                  shown(name), did_you_mean(name, names));
}

void stand_in_for_texture(const Parameter& parameter, BuildContext& context) {
    context.messages.stand_in(
        parameter.place,
        fmt::format("'{}' cannot change over a surface here; one value that is typical of the "
                    "texture '{}' stands in",
                    parameter.name, shown(parameter.strings[0])));
}

}  // namespace

std::vector<double> matter_rgb_values(const Parameter& parameter, BuildContext& context) {
    std::vector<double> values;
    for (size_t i = 0; i + 2 < parameter.numbers.size(); i += 3) {
        const double* own = parameter.numbers.data() + i;
        const RGB rgb = matter_rgb(parameter, {own[0], own[1], own[2]}, context);
        values.insert(values.end(), rgb.begin(), rgb.end());
    }
    return values;
}

SpectrumValue matter_value(const Parameter& parameter, BuildContext& context) {
    switch (parameter.type) {
        case ParameterType::rgb:
            return {rgb_reflectance(matter_rgb(parameter, rgb_of(parameter), context))};
        case ParameterType::blackbody:
            return {blackbody_of(parameter)};
        case ParameterType::texture:
            return named_texture(parameter, context.textures.spectra, "spectrum");
        default: {
            const SampledTable table = sampled_table(parameter, context);
            note_range(table, parameter.place, context.messages);
            return {resample(table.wavelength_nm, table.values)};
        }
    }
}

DenseSpectrum matter_spectrum(const Parameter& parameter, BuildContext& context) {
    const SpectrumValue value = matter_value(parameter, context);
    if (value.texture >= 0) stand_in_for_texture(parameter, context);
    return value.constant;
}

SpectrumValue reflectance_value(ParameterList& list, const std::string& name, double otherwise,
                                BuildContext& context) {
    const Parameter* parameter =
        list.any_of(name, {ParameterType::rgb, ParameterType::spectrum, ParameterType::texture});
    if (parameter == nullptr) return {constant_spectrum(otherwise)};
    if (parameter->type == ParameterType::rgb) {
        const RGB rgb = rgb_of(*parameter);
        for (size_t i = 0; i < 3; ++i) {
            if (!(rgb[i] >= 0 && rgb[i] <= 1)) {
                user_error_at(parameter->place_of(i), "{}: {} is {}; expected 0 to 1", list.owner(),
                              name, format_double(rgb[i]));
            }
        }
    }
    SpectrumValue spectrum = matter_value(*parameter, context);
    for (double& value : spectrum.constant) {
        // The bases sum to 1 up to rounding only.
        if (spectrum.texture < 0 && !(value >= -1e-6 && value <= 1 + 1e-6)) {
            user_error_at(parameter->place, "{}: {} reaches {}; expected 0 to 1", list.owner(),
                          name, format_double(value));
        }
        value = std::clamp(value, 0.0, 1.0);
    }
    return spectrum;
}

DenseSpectrum reflectance(ParameterList& list, const std::string& name, double otherwise,
                          BuildContext& context) {
    const SpectrumValue value = reflectance_value(list, name, otherwise, context);
    if (value.texture >= 0) {
        stand_in_for_texture(*list.any_of(name, {ParameterType::texture}), context);
    }
    return value.constant;
}

DenseSpectrum light_spectrum(ParameterList& list, const std::string& name, BuildContext& context) {
    const Parameter* parameter =
        list.any_of(name, {ParameterType::rgb, ParameterType::blackbody, ParameterType::spectrum});
    if (parameter == nullptr) return rgb_illuminant({1, 1, 1});
    if (parameter->type == ParameterType::rgb) {
        const RGB rgb = rgb_of(*parameter);
        for (size_t i = 0; i < 3; ++i) {
            if (!(rgb[i] >= 0 && rgb[i] < 1e15)) {
                user_error_at(parameter->place_of(i), "{}: {} is {}; expected 0 or more",
                              list.owner(), name, format_double(rgb[i]));
            }
        }
        return rgb_illuminant(light_rgb(*parameter, context));
    }
    DenseSpectrum spectrum;
    bool is_dark = false;
    if (parameter->type == ParameterType::spectrum) {
        const SampledTable table = sampled_table(*parameter, context);
        note_range(table, parameter->place, context.messages);
        spectrum = resample(table.wavelength_nm, table.values);
        // Of the table, so that a lamp with all its light outside the grid is not taken for off.
        is_dark = std::all_of(table.values.begin(), table.values.end(),
                              [](double value) { return value == 0; });
    } else {
        spectrum = blackbody_of(*parameter);
    }
    if (is_dark) return spectrum;
    const auto [lowest, highest] = std::minmax_element(spectrum.begin(), spectrum.end());
    if (*lowest < 0) {
        user_error_at(parameter->place, "{}: {} reaches {}; expected 0 or more", list.owner(), name,
                      format_double(*lowest));
    }
    const double luminance = spectrum_to_xyz(spectrum)[1];
    if (!(luminance > 1e-12 * *highest) || !std::isfinite(luminance)) {
        user_error_at(
            parameter->place,
            "{}: {} has no luminance, so it cannot be given Y = 1; expected light between "
            "{} and {} nm",
            list.owner(), name, spectrum_first_nm, spectrum_last_nm);
    }
    return scaled(spectrum, 1 / luminance);
}

NumberValue number_value(ParameterList& list, const std::string& name, double otherwise,
                         BuildContext& context) {
    const Parameter* parameter = list.any_of(name, {ParameterType::number, ParameterType::texture});
    if (parameter == nullptr) return {otherwise};
    if (parameter->type == ParameterType::number) return {list.number(name, otherwise)};
    return named_texture(*parameter, context.textures.numbers, "float");
}

double number_or_texture(ParameterList& list, const std::string& name, double otherwise,
                         BuildContext& context) {
    const NumberValue value = number_value(list, name, otherwise, context);
    if (value.texture >= 0) {
        stand_in_for_texture(*list.any_of(name, {ParameterType::texture}), context);
    }
    return value.constant;
}

}  // namespace drude
