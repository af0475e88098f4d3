// Texture: until textures are drawn, each is the one value that stands for it.
#include "scene/builders.h"
#include "scene/spectra.h"
#include "scene/vocabulary.h"

namespace drude {

namespace {

// A texture of either kind, so that one piece of code combines both.
using Value = std::variant<double, DenseSpectrum>;

Value operand(ParameterList& list, const std::string& name, double otherwise, bool is_spectrum,
              BuildContext& context) {
    if (!is_spectrum) return number_or_texture(list, name, otherwise, context);
    const Parameter* parameter =
        list.any_of(name, {ParameterType::rgb, ParameterType::spectrum, ParameterType::blackbody,
                           ParameterType::texture});
    if (parameter == nullptr) return constant_spectrum(otherwise);
    return matter_spectrum(*parameter, context);
}

// a (1 - t) + b t
Value blend(const Value& a, const Value& b, double t) {
    if (const double* number = std::get_if<double>(&a)) {
        return *number * (1 - t) + std::get<double>(b) * t;
    }
    DenseSpectrum result = std::get<DenseSpectrum>(a);
    const DenseSpectrum& other = std::get<DenseSpectrum>(b);
    for (size_t i = 0; i < result.size(); ++i) result[i] = result[i] * (1 - t) + other[i] * t;
    return result;
}

Value constant(double value, bool is_spectrum) {
    if (is_spectrum) return constant_spectrum(value);
    return value;
}

Value texture_value(const std::string& type, bool is_spectrum, ParameterList& list,
                    BuildContext& context) {
    if (type == "constant") return operand(list, "value", 1, is_spectrum, context);
    if (type == "scale") {
        const Value texture = operand(list, "tex", 1, is_spectrum, context);
        const double scale = number_or_texture(list, "scale", 1, context);
        return blend(constant(0, is_spectrum), texture, scale);
    }
    if (type == "mix") {
        const Value first = operand(list, "tex1", 0, is_spectrum, context);
        const Value second = operand(list, "tex2", 1, is_spectrum, context);
        return blend(first, second, number_or_texture(list, "amount", 0.5, context));
    }
    const auto stand_in = [&](std::string_view what) {
        context.messages.stand_in(
            list.place(), fmt::format("Texture \"{}\" is not drawn; {} stands in", type, what));
    };
    if (type == "checkerboard" || type == "directionmix") {
        const Value first = operand(list, "tex1", 1, is_spectrum, context);
        const Value second = operand(list, "tex2", 0, is_spectrum, context);
        stand_in("the mean of its two parts");
        list.ignore(known_parameters("Texture", type));
        return blend(first, second, 0.5);
    }
    stand_in("a constant 0.5");
    list.ignore(known_parameters("Texture", type));
    return constant(0.5, is_spectrum);
}

}  // namespace

void build_texture(const std::string& name, bool is_spectrum, const std::string& type,
                   ParameterList& list, BuildContext& context) {
    const Value value = texture_value(type, is_spectrum, list, context);
    list.finish(known_parameters("Texture", type), context.messages);
    const bool added =
        is_spectrum ? context.textures.spectra.emplace(name, std::get<DenseSpectrum>(value)).second
                    : context.textures.numbers.emplace(name, std::get<double>(value)).second;
    if (!added) {
        user_error_at(list.place(), "the texture '{}' is defined twice; expected another name",
                      shown(name));
    }
}

}  // namespace drude
