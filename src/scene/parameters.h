// Parameter lists: `"type name" value` or `"type name" [ values ]`, as they follow a directive.
//
// Values are checked against their type where they are read, names and types against what a
// builder asks for where it asks. What nobody asked for is an error at the end (finish()), so a
// misspelt parameter cannot be ignored.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "scene/lexer.h"
#include "scene/messages.h"

namespace drude {

enum class ParameterType {
    boolean,
    integer,
    number,
    point2,
    vector2,
    point3,
    vector3,
    normal,
    string,
    rgb,
    blackbody,
    spectrum,
    texture,
};
// "bool", "integer", "float", ... as a scene spells it.
std::string_view type_name(ParameterType type);

struct Parameter {
    ParameterType type = ParameterType::number;
    std::string name;
    Place place;                       // of its declaration
    std::vector<double> numbers;       // of every numeric type, all components in a row
    std::vector<std::string> strings;  // string, texture, or a spectrum's name or file
    std::vector<bool> booleans;
    bool from_attribute = false;  // a default that an Attribute directive gave
    bool used = false;

    // Where the values start; the place of one of them is found by reading them again, so that
    // places cost nothing where there is no error.
    Lexer values;
    Place place_of(size_t value) const;
};

// Reads the parameters that stand at the lexer, up to the first token that starts none. Errors
// (user): unknown types, values of another type, counts the type cannot have, numbers that are not
// finite, names given twice.
std::vector<Parameter> read_parameters(Lexer& lexer);

// The parameters of one directive and what a builder gets from them. Getters mark as used.
class ParameterList {
  public:
    // `owner` names it in messages: `Shape "sphere"`.
    ParameterList(std::string owner, Place place, std::vector<Parameter> parameters)
        : owner_(std::move(owner)), place_(std::move(place)), parameters_(std::move(parameters)) {}

    const std::string& owner() const { return owner_; }
    const Place& place() const { return place_; }
    const std::vector<Parameter>& all() const { return parameters_; }

    // Adds defaults of an Attribute directive; what the list holds itself stays.
    void add_defaults(const std::vector<Parameter>& defaults);

    bool has(std::string_view name) const;
    // The place of the parameter, or of the directive where there is none.
    Place place_of(std::string_view name) const;

    // One value; Error (user) where there are more, or where the type is another.
    double number(std::string_view name, double otherwise);
    int integer(std::string_view name, int otherwise);
    bool boolean(std::string_view name, bool otherwise);
    std::string text(std::string_view name, const std::string& otherwise);
    glm::dvec3 point3(std::string_view name, const glm::dvec3& otherwise);
    glm::dvec3 vector3(std::string_view name, const glm::dvec3& otherwise);
    // One of some words; Error (user) with the nearest where it is none of them.
    std::string choice(std::string_view name, const std::string& otherwise,
                       const std::vector<std::string>& words);
    // The same with bounds: Error (user) where the number is not in [lowest, highest].
    double number_in(std::string_view name, double otherwise, double lowest, double highest);
    int integer_in(std::string_view name, int otherwise, int lowest, int highest);

    // All values of a parameter of this type, or nullptr where it is not there.
    const Parameter* values(std::string_view name, ParameterType type);
    // A parameter that has one of these types, or nullptr where it is not there.
    const Parameter* any_of(std::string_view name, const std::vector<ParameterType>& types);

    // The last word on a list: what nobody asked for is noted to have no effect where it is one of
    // `known` (what pbrt-v4 takes here), and is an Error (user) otherwise.
    void finish(const std::vector<std::string>& known, Messages& messages);
    // Passes over everything that is one of `known`; for things that are left out as a whole.
    void ignore(const std::vector<std::string>& known);

  private:
    Parameter* find(std::string_view name);
    const Parameter* single(std::string_view name, ParameterType type, size_t components);
    glm::dvec3 triple(std::string_view name, ParameterType type, const glm::dvec3& otherwise);
    [[noreturn]] void unknown(const Parameter& parameter, const std::vector<std::string>& known);

    std::string owner_;
    Place place_;
    std::vector<Parameter> parameters_;
    std::vector<std::string> asked_;
};

}  // namespace drude
