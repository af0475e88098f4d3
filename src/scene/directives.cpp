// One function a directive, or a family of directives: its arguments, then SceneReader's turn.
#include <algorithm>

#include "scene/old_versions.h"
#include "scene/parser.h"
#include "scene/transforms.h"

namespace drude {

const std::unordered_map<std::string, Parser::Handler>& Parser::handlers() {
    static const std::unordered_map<std::string, Handler> table = {
        {"Identity", &Parser::simple},
        {"ReverseOrientation", &Parser::simple},
        {"WorldBegin", &Parser::simple},
        {"Translate", &Parser::transformation},
        {"Scale", &Parser::transformation},
        {"Rotate", &Parser::transformation},
        {"LookAt", &Parser::transformation},
        {"Transform", &Parser::transformation},
        {"ConcatTransform", &Parser::transformation},
        {"CoordinateSystem", &Parser::coordinate_system},
        {"CoordSysTransform", &Parser::coordinate_system},
        {"ActiveTransform", &Parser::time},
        {"TransformTimes", &Parser::time},
        {"AttributeBegin", &Parser::block},
        {"AttributeEnd", &Parser::block},
        {"TransformBegin", &Parser::block},
        {"TransformEnd", &Parser::block},
        {"ObjectBegin", &Parser::object},
        {"ObjectEnd", &Parser::object},
        {"ObjectInstance", &Parser::object},
        {"Attribute", &Parser::attribute},
        {"Camera", &Parser::named_thing},
        {"Film", &Parser::named_thing},
        {"Sampler", &Parser::named_thing},
        {"PixelFilter", &Parser::named_thing},
        {"Integrator", &Parser::named_thing},
        {"Accelerator", &Parser::named_thing},
        {"Material", &Parser::named_thing},
        {"LightSource", &Parser::named_thing},
        {"AreaLightSource", &Parser::named_thing},
        {"Shape", &Parser::named_thing},
        {"Option", &Parser::option},
        {"ColorSpace", &Parser::colour_space},
        {"MakeNamedMaterial", &Parser::make_named},
        {"MakeNamedMedium", &Parser::make_named},
        {"NamedMaterial", &Parser::named_material},
        {"MediumInterface", &Parser::medium_interface},
        {"Texture", &Parser::texture},
        {"Include", &Parser::include},
        {"Import", &Parser::include},
    };
    return table;
}

void Parser::simple(const std::string& directive, const Place& place) {
    if (directive == "Identity") {
        reader_.replace_transform(glm::dmat4(1), place);
    } else if (directive == "ReverseOrientation") {
        reader_.reverse_orientation();
    } else {
        reader_.begin_world(place);
    }
}

void Parser::transformation(const std::string& directive, const Place& place) {
    if (directive == "Translate") {
        reader_.transform(translation(vector_argument(directive)), place);
    } else if (directive == "Scale") {
        reader_.transform(scaling(vector_argument(directive), place), place);
    } else if (directive == "Rotate") {
        const double degrees = number_argument(directive);
        reader_.transform(rotation(degrees, vector_argument(directive), place), place);
    } else if (directive == "LookAt") {
        const glm::dvec3 eye = vector_argument(directive), look = vector_argument(directive);
        reader_.transform(look_at(eye, look, vector_argument(directive), place), place);
    } else if (directive == "Transform") {
        reader_.replace_transform(matrix_argument(directive, place), place);
    } else {
        reader_.transform(matrix_argument(directive, place), place);
    }
}

void Parser::coordinate_system(const std::string& directive, const Place& place) {
    const std::string name = string_argument(directive, "the name of a coordinate system");
    if (directive == "CoordinateSystem") {
        reader_.name_coordinate_system(name);
    } else {
        reader_.use_coordinate_system(name, place);
    }
}

void Parser::time(const std::string& directive, const Place& place) {
    if (directive == "TransformTimes") {
        number_argument(directive);
        number_argument(directive);
        reader_.transform_times(place);
        return;
    }
    const Token token = lexer().take();
    const std::string which(token.text);
    if (which != "All" && which != "StartTime" && which != "EndTime") {
        user_error_at(lexer().place(token),
                      "ActiveTransform: found '{}'; expected All, StartTime or EndTime",
                      shown(which));
    }
    reader_.active_transform(which, place);
}

void Parser::block(const std::string& directive, const Place& place) {
    if (directive.rfind("Transform", 0) == 0) {
        reader_.messages().note(place,
                                "TransformBegin and TransformEnd are old; AttributeBegin "
                                "and AttributeEnd are meant, as in pbrt-v4");
    }
    if (directive.substr(directive.size() - 3) == "End") {
        reader_.end_attributes(place, directive);
    } else {
        reader_.begin_attributes(place, directive);
    }
}

void Parser::object(const std::string& directive, const Place& place) {
    if (directive == "ObjectEnd") {
        reader_.end_object(place);
        return;
    }
    const std::string name = string_argument(directive, "the name of an object");
    if (directive == "ObjectBegin") {
        reader_.begin_object(name, place);
    } else {
        reader_.instance(name, place);
    }
}

void Parser::attribute(const std::string& directive, const Place& place) {
    const std::string kind =
        string_argument(directive, "shape, light, material, medium or texture");
    reader_.attribute(kind, parameters(fmt::format("Attribute \"{}\"", shown(kind)), place));
}

void Parser::named_thing(const std::string& directive, const Place& place) {
    const Place name_place = lexer().place(lexer().peek());
    const std::string name = string_argument(directive, "a name");
    check_name(directive, name, name_place);
    ParameterList list = parameters(fmt::format("{} \"{}\"", directive, name), place);
    if (directive == "Material") {
        reader_.material(name, std::move(list));
    } else if (directive == "LightSource") {
        reader_.light(name, std::move(list));
    } else if (directive == "AreaLightSource") {
        reader_.area_light(name, std::move(list));
    } else if (directive == "Shape") {
        reader_.shape(name, std::move(list));
    } else {
        reader_.setting(directive, name, std::move(list));
    }
}

void Parser::option(const std::string& directive, const Place& place) {
    const std::string declaration = string_argument(directive, "the name of an option");
    // pbrt-v4 has the name alone; a type before it, as of a parameter, does no harm.
    const size_t blank = declaration.find_last_of(" \t");
    const std::string type = blank == std::string::npos ? "" : declaration.substr(0, blank);
    const std::string name =
        blank == std::string::npos ? declaration : declaration.substr(blank + 1);
    const std::vector<std::string> types = {"", "bool", "float", "integer", "string"};
    if (std::find(types.begin(), types.end(), type) == types.end()) {
        user_error_at(place, "Option \"{}\": there is no type '{}'{}; expected one of:{}",
                      shown(name), shown(type), did_you_mean(type, types), fmt::join(types, " "));
    }
    const Token value = lexer().take();
    if (value.kind != Token::Kind::word && value.kind != Token::Kind::string) {
        user_error_at(lexer().place(value), "Option \"{}\": found '{}'; expected a value",
                      shown(name), shown(value.text));
    }
    if (reader_.in_world()) {
        user_error_at(place, "Option behind WorldBegin; expected it before");
    }
    // As in pbrt-v4, which drops hyphens, underlines and capitals.
    std::string plain;
    for (const char c : name) {
        if (c != '-' && c != '_')
            plain += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    reader_.option(plain, string_value(value), place);
}

void Parser::colour_space(const std::string& directive, const Place& place) {
    reader_.set_colour_space(string_argument(directive, "the name of a colour space"), place);
}

std::string Parser::type_of(ParameterList& list, const std::string& kind) {
    if (!list.has("type")) {
        user_error_at(list.place(), "{} without \"string type\"; expected it", list.owner());
    }
    std::string type = list.text("type", "");
    check_name(kind, type, list.place_of("type"));
    return type;
}

void Parser::make_named(const std::string& directive, const Place& place) {
    const std::string name = string_argument(directive, "a name");
    ParameterList list = parameters(fmt::format("{} \"{}\"", directive, shown(name)), place);
    if (directive == "MakeNamedMaterial") {
        const std::string type = type_of(list, "Material");
        reader_.make_named_material(name, type, std::move(list));
    } else {
        const std::string type = type_of(list, "MakeNamedMedium");
        reader_.make_named_medium(name, type, std::move(list));
    }
}

void Parser::named_material(const std::string& directive, const Place& place) {
    reader_.named_material(string_argument(directive, "the name of a material"), place);
}

void Parser::medium_interface(const std::string& directive, const Place& place) {
    const std::string inside = string_argument(directive, "the name of a medium");
    std::string outside = inside;
    if (lexer().peek().kind == Token::Kind::string) outside = string_value(lexer().take());
    reader_.medium_interface(inside, outside, place);
}

void Parser::texture(const std::string& directive, const Place& place) {
    const std::string name = string_argument(directive, "the name of the texture");
    const Place kind_place = lexer().place(lexer().peek());
    const std::string kind = string_argument(directive, "\"float\" or \"spectrum\"");
    if (kind != "float" && kind != "spectrum") {
        if (is_old_name("Texture", kind)) old_version_error(lexer(), kind_place, kind);
        user_error_at(kind_place, "Texture \"{}\" of \"{}\"{}; expected \"float\" or \"spectrum\"",
                      shown(name), shown(kind), did_you_mean(kind, {"float", "spectrum"}));
    }
    const Place type_place = lexer().place(lexer().peek());
    const std::string type = string_argument(directive, "the type of the texture");
    check_name("Texture", type, type_place);
    reader_.texture(name, kind == "spectrum", type,
                    parameters(fmt::format("Texture \"{}\"", shown(name)), place));
}

}  // namespace drude
