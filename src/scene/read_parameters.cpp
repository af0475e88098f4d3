// The syntax of parameters: declaration, values, brackets.
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_set>

#include "base/numbers.h"
#include "scene/old_versions.h"
#include "scene/parameters.h"

namespace drude {

namespace {

enum class ValueKind { number, integer, boolean, string, number_or_string };

struct TypeFacts {
    ParameterType type;
    std::string_view name;
    ValueKind kind;
    size_t components;  // values come in groups of so many
    bool single;        // exactly one group
};

constexpr std::array<TypeFacts, 13> types = {{
    {ParameterType::boolean, "bool", ValueKind::boolean, 1, false},
    {ParameterType::integer, "integer", ValueKind::integer, 1, false},
    {ParameterType::number, "float", ValueKind::number, 1, false},
    {ParameterType::point2, "point2", ValueKind::number, 2, false},
    {ParameterType::vector2, "vector2", ValueKind::number, 2, false},
    {ParameterType::point3, "point3", ValueKind::number, 3, false},
    {ParameterType::vector3, "vector3", ValueKind::number, 3, false},
    {ParameterType::normal, "normal", ValueKind::number, 3, false},
    {ParameterType::string, "string", ValueKind::string, 1, false},
    {ParameterType::rgb, "rgb", ValueKind::number, 3, false},
    {ParameterType::blackbody, "blackbody", ValueKind::number, 1, true},
    {ParameterType::spectrum, "spectrum", ValueKind::number_or_string, 1, false},
    {ParameterType::texture, "texture", ValueKind::string, 1, true},
}};

const TypeFacts* find_type(std::string_view name) {
    // The short names are pbrt-v3's, which pbrt-v4 scenes by hand still use.
    if (name == "point") name = "point3";
    if (name == "vector") name = "vector3";
    for (const TypeFacts& facts : types) {
        if (facts.name == name) return &facts;
    }
    return nullptr;
}

std::vector<std::string> split_words(std::string_view text) {
    std::vector<std::string> words;
    std::string word;
    for (const char c : text) {
        if (c == ' ' || c == '\t') {
            if (!word.empty()) words.push_back(std::move(word));
            word.clear();
        } else {
            word.push_back(c);
        }
    }
    if (!word.empty()) words.push_back(std::move(word));
    return words;
}

std::string described(const Token& token) {
    switch (token.kind) {
        case Token::Kind::end:
            return "the end of the file";
        case Token::Kind::string:
            return fmt::format("the string \"{}\"", shown(token.text));
        default:
            return fmt::format("'{}'", shown(token.text));
    }
}

void add_value(Parameter& parameter, const TypeFacts& facts, const Token& token,
               const Lexer& lexer) {
    const auto wrong = [&](std::string_view expected) {
        user_error_at(lexer.place(token), "\"{} {}\": found {}; expected {}", facts.name,
                      shown(parameter.name), described(token), expected);
    };
    const bool quoted = token.kind == Token::Kind::string;
    switch (facts.kind) {
        case ValueKind::boolean:
            // Quoted truth values are pbrt-v3's.
            if (token.text != "true" && token.text != "false") wrong("true or false");
            parameter.booleans.push_back(token.text == "true");
            return;
        case ValueKind::string:
            if (!quoted) wrong("a string in quotes");
            parameter.strings.push_back(string_value(token));
            return;
        case ValueKind::integer: {
            const std::optional<long long> value =
                quoted ? std::nullopt : parse_integer(token.text);
            if (!value || *value < std::numeric_limits<int>::min() ||
                *value > std::numeric_limits<int>::max()) {
                wrong("an integer of 32 bits");
            }
            parameter.numbers.push_back(static_cast<double>(*value));
            return;
        }
        case ValueKind::number_or_string:
            if (quoted) {
                if (!parameter.numbers.empty()) wrong("a number");
                parameter.strings.push_back(string_value(token));
                return;
            }
            if (!parameter.strings.empty()) wrong("']'");
            [[fallthrough]];
        case ValueKind::number: {
            const std::optional<double> value = quoted ? std::nullopt : parse_double(token.text);
            if (!value || !std::isfinite(*value)) wrong("a finite number");
            parameter.numbers.push_back(*value);
            return;
        }
    }
}

void check_count(const Parameter& parameter, const TypeFacts& facts) {
    const size_t count =
        parameter.numbers.size() + parameter.strings.size() + parameter.booleans.size();
    const auto wrong = [&](const std::string& expected) {
        user_error_at(parameter.place, "\"{} {}\" has {} value{}; expected {}", facts.name,
                      shown(parameter.name), count, count == 1 ? "" : "s", expected);
    };
    if (count == 0) wrong("at least one");
    if (facts.single && count != facts.components) wrong(std::to_string(facts.components));
    if (count % facts.components != 0) wrong(fmt::format("a multiple of {}", facts.components));
    if (facts.type == ParameterType::spectrum) {
        if (parameter.strings.size() > 1) wrong("one name");
        if (parameter.numbers.size() % 2 != 0) wrong("pairs of wavelength and value");
    }
}

Parameter read_parameter(Lexer& lexer, ColourSpace colour_space) {
    const Token declaration = lexer.take();
    const Place place = lexer.place(declaration);
    const std::vector<std::string> words = split_words(string_value(declaration));
    if (words.size() != 2) {
        user_error_at(place, "\"{}\" declares no parameter; expected \"type name\"",
                      shown(declaration.text));
    }
    const TypeFacts* facts = find_type(words[0]);
    if (facts == nullptr) {
        if (is_old_type(words[0])) old_version_error(lexer, place, declaration.text);
        std::vector<std::string> names;
        for (const TypeFacts& known : types) names.emplace_back(known.name);
        user_error_at(place, "unknown parameter type '{}'{}; expected one of: {}", shown(words[0]),
                      did_you_mean(words[0], names), fmt::join(names, ", "));
    }
    Parameter parameter{facts->type, words[1], place, {},           {},
                        {},          false,    false, colour_space, lexer};
    Token value = lexer.take();
    if (value.kind == Token::Kind::open) {
        while ((value = lexer.take()).kind != Token::Kind::close) {
            if (value.kind == Token::Kind::end || value.kind == Token::Kind::open) {
                user_error_at(lexer.place(value), "\"{} {}\": found {}; expected a value or ']'",
                              facts->name, shown(parameter.name), described(value));
            }
            add_value(parameter, *facts, value, lexer);
        }
    } else if (value.kind == Token::Kind::word || value.kind == Token::Kind::string) {
        add_value(parameter, *facts, value, lexer);
    } else {
        user_error_at(lexer.place(value), "\"{} {}\": found {}; expected a value or '['",
                      facts->name, shown(parameter.name), described(value));
    }
    check_count(parameter, *facts);
    return parameter;
}

}  // namespace

std::string_view type_name(ParameterType type) {
    return types[static_cast<size_t>(type)].name;
}

Place Parameter::place_of(size_t value) const {
    Lexer lexer = values;
    if (lexer.peek().kind == Token::Kind::open) lexer.take();
    Token token = lexer.take();
    for (size_t i = 0; i < value && token.kind != Token::Kind::close; ++i) token = lexer.take();
    return lexer.place(token);
}

std::vector<Parameter> read_parameters(Lexer& lexer, ColourSpace colour_space) {
    std::vector<Parameter> parameters;
    std::unordered_set<std::string> names;
    while (lexer.peek().kind == Token::Kind::string) {
        Parameter parameter = read_parameter(lexer, colour_space);
        if (!names.insert(parameter.name).second) {
            user_error_at(parameter.place, "the parameter '{}' is given twice; expected it once",
                          shown(parameter.name));
        }
        parameters.push_back(std::move(parameter));
    }
    return parameters;
}

}  // namespace drude
