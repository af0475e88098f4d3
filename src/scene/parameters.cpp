#include "scene/parameters.h"

#include <algorithm>

#include "base/numbers.h"

namespace drude {

void ParameterList::add_defaults(const std::vector<Parameter>& defaults) {
    for (const Parameter& parameter : defaults) {
        if (has(parameter.name)) continue;
        parameters_.push_back(parameter);
        parameters_.back().from_attribute = true;
    }
}

Parameter* ParameterList::find(std::string_view name) {
    const auto found =
        std::find_if(parameters_.begin(), parameters_.end(),
                     [&](const Parameter& parameter) { return parameter.name == name; });
    return found == parameters_.end() ? nullptr : &*found;
}

bool ParameterList::has(std::string_view name) const {
    return std::any_of(parameters_.begin(), parameters_.end(),
                       [&](const Parameter& parameter) { return parameter.name == name; });
}

Place ParameterList::place_of(std::string_view name) const {
    for (const Parameter& parameter : parameters_) {
        if (parameter.name == name) return parameter.place;
    }
    return place_;
}

const Parameter* ParameterList::any_of(std::string_view name,
                                       const std::vector<ParameterType>& types) {
    asked_.emplace_back(name);
    Parameter* parameter = find(name);
    if (parameter == nullptr) return nullptr;
    if (std::find(types.begin(), types.end(), parameter->type) == types.end()) {
        std::string expected;
        for (const ParameterType type : types) {
            if (!expected.empty()) expected += " or ";
            expected += fmt::format("\"{} {}\"", type_name(type), name);
        }
        user_error_at(parameter->place, "{}: \"{} {}\" has the wrong type; expected {}", owner_,
                      type_name(parameter->type), name, expected);
    }
    parameter->used = true;
    return parameter;
}

const Parameter* ParameterList::values(std::string_view name, ParameterType type) {
    return any_of(name, {type});
}

const Parameter* ParameterList::single(std::string_view name, ParameterType type,
                                       size_t components) {
    const Parameter* parameter = values(name, type);
    if (parameter == nullptr) return nullptr;
    const size_t count = std::max(
        {parameter->numbers.size(), parameter->strings.size(), parameter->booleans.size()});
    if (count != components) {
        user_error_at(parameter->place_of(components), "{}: \"{} {}\" has {} values; expected {}",
                      owner_, type_name(type), name, count, components);
    }
    return parameter;
}

double ParameterList::number(std::string_view name, double otherwise) {
    const Parameter* parameter = single(name, ParameterType::number, 1);
    return parameter ? parameter->numbers[0] : otherwise;
}

int ParameterList::integer(std::string_view name, int otherwise) {
    const Parameter* parameter = single(name, ParameterType::integer, 1);
    return parameter ? static_cast<int>(parameter->numbers[0]) : otherwise;
}

bool ParameterList::boolean(std::string_view name, bool otherwise) {
    const Parameter* parameter = single(name, ParameterType::boolean, 1);
    return parameter ? parameter->booleans[0] : otherwise;
}

std::string ParameterList::text(std::string_view name, const std::string& otherwise) {
    const Parameter* parameter = single(name, ParameterType::string, 1);
    return parameter ? parameter->strings[0] : otherwise;
}

glm::dvec3 ParameterList::triple(std::string_view name, ParameterType type,
                                 const glm::dvec3& otherwise) {
    const Parameter* parameter = single(name, type, 3);
    if (parameter == nullptr) return otherwise;
    return {parameter->numbers[0], parameter->numbers[1], parameter->numbers[2]};
}

glm::dvec3 ParameterList::point3(std::string_view name, const glm::dvec3& otherwise) {
    return triple(name, ParameterType::point3, otherwise);
}

glm::dvec3 ParameterList::vector3(std::string_view name, const glm::dvec3& otherwise) {
    return triple(name, ParameterType::vector3, otherwise);
}

std::string ParameterList::choice(std::string_view name, const std::string& otherwise,
                                  const std::vector<std::string>& words) {
    std::string word = text(name, otherwise);
    if (std::find(words.begin(), words.end(), word) == words.end()) {
        user_error_at(find(name)->place_of(0), "{}: {} is '{}'{}; expected one of: {}", owner_,
                      name, shown(word), did_you_mean(word, words), fmt::join(words, ", "));
    }
    return word;
}

double ParameterList::number_in(std::string_view name, double otherwise, double lowest,
                                double highest) {
    const double value = number(name, otherwise);
    if (!(value >= lowest && value <= highest)) {
        user_error_at(find(name)->place_of(0), "{}: {} is {}; expected {} to {}", owner_, name,
                      format_double(value), format_double(lowest), format_double(highest));
    }
    return value;
}

int ParameterList::integer_in(std::string_view name, int otherwise, int lowest, int highest) {
    const int value = integer(name, otherwise);
    if (value < lowest || value > highest) {
        user_error_at(find(name)->place_of(0), "{}: {} is {}; expected {} to {}", owner_, name,
                      value, lowest, highest);
    }
    return value;
}

void ParameterList::unknown(const Parameter& parameter, const std::vector<std::string>& known) {
    std::vector<std::string> words = asked_;
    words.insert(words.end(), known.begin(), known.end());
    std::sort(words.begin(), words.end());
    words.erase(std::unique(words.begin(), words.end()), words.end());
    const std::string hint = did_you_mean(parameter.name, words);
    user_error_at(parameter.place, "{} has no parameter '{}'{}; expected one of: {}", owner_,
                  shown(parameter.name), hint, fmt::join(words, ", "));
}

void ParameterList::finish(const std::vector<std::string>& known, Messages& messages) {
    for (const Parameter& parameter : parameters_) {
        if (parameter.used || parameter.from_attribute) continue;
        if (std::find(known.begin(), known.end(), parameter.name) == known.end()) {
            unknown(parameter, known);
        }
        messages.stand_in(parameter.place, fmt::format("{}: '{}' is known to pbrt-v4 and has no "
                                                       "effect in this renderer",
                                                       owner_, parameter.name));
    }
}

void ParameterList::ignore(const std::vector<std::string>& known) {
    for (Parameter& parameter : parameters_) {
        if (!parameter.used &&
            std::find(known.begin(), known.end(), parameter.name) == known.end() &&
            !parameter.from_attribute) {
            unknown(parameter, known);
        }
        parameter.used = true;
    }
}

}  // namespace drude
