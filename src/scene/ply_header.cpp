#include "scene/ply_header.h"

#include <array>
#include <optional>

#include "base/numbers.h"
#include "scene/lexer.h"

namespace drude {

namespace {

struct TypeName {
    std::string_view name, long_name;
    PlyType type;
    size_t size;
};

constexpr std::array<TypeName, 8> type_names = {{
    {"char", "int8", PlyType::int8, 1},
    {"uchar", "uint8", PlyType::uint8, 1},
    {"short", "int16", PlyType::int16, 2},
    {"ushort", "uint16", PlyType::uint16, 2},
    {"int", "int32", PlyType::int32, 4},
    {"uint", "uint32", PlyType::uint32, 4},
    {"float", "float32", PlyType::float32, 4},
    {"double", "float64", PlyType::float64, 8},
}};

PlyType parse_type(std::string_view name, const Place& place) {
    std::vector<std::string> names;
    for (const TypeName& known : type_names) {
        if (name == known.name || name == known.long_name) return known.type;
        names.emplace_back(known.name);
    }
    user_error_at(place, "unknown PLY type '{}'{}; expected one of: {}", shown(name),
                  did_you_mean(name, names), fmt::join(names, ", "));
}

std::vector<std::string_view> split(std::string_view line) {
    std::vector<std::string_view> words;
    size_t i = 0;
    while (i < line.size()) {
        while (i < line.size() && (line[i] == ' ' || line[i] == '\t')) ++i;
        const size_t begin = i;
        while (i < line.size() && line[i] != ' ' && line[i] != '\t') ++i;
        if (i > begin) words.push_back(line.substr(begin, i - begin));
    }
    return words;
}

PlyFormat parse_format(const std::vector<std::string_view>& words, const Place& place) {
    if (words.size() == 3 && words[2] == "1.0") {
        if (words[1] == "ascii") return PlyFormat::ascii;
        if (words[1] == "binary_little_endian") return PlyFormat::little_endian;
        if (words[1] == "binary_big_endian") return PlyFormat::big_endian;
    }
    user_error_at(place,
                  "unknown PLY format; expected 'format ascii 1.0', 'format "
                  "binary_little_endian 1.0' or 'format binary_big_endian 1.0'");
}

PlyElement parse_element(const std::vector<std::string_view>& words, const Place& place) {
    const std::optional<long long> count =
        words.size() == 3 ? parse_integer(words[2]) : std::nullopt;
    if (!count || *count < 0) {
        user_error_at(place, "a PLY element without a count; expected 'element NAME COUNT'");
    }
    PlyElement element;
    element.name = words[1];
    element.count = static_cast<uint64_t>(*count);
    element.place = place;
    return element;
}

PlyProperty parse_property(const std::vector<std::string_view>& words, const Place& place) {
    PlyProperty property;
    if (words.size() == 3) {
        property.type = parse_type(words[1], place);
        property.name = words[2];
    } else if (words.size() == 5 && words[1] == "list") {
        property.is_list = true;
        property.count_type = parse_type(words[2], place);
        property.type = parse_type(words[3], place);
        property.name = words[4];
        if (property.count_type == PlyType::float32 || property.count_type == PlyType::float64) {
            user_error_at(place, "a PLY list counted in '{}'; expected an integer type",
                          shown(words[2]));
        }
    } else {
        user_error_at(place,
                      "a PLY property of {} words; expected 'property TYPE NAME' or 'property "
                      "list TYPE TYPE NAME'",
                      words.size());
    }
    return property;
}

}  // namespace

size_t ply_size(PlyType type) {
    return type_names[static_cast<size_t>(type)].size;
}

uint64_t PlyElement::least_bytes(PlyFormat format) const {
    uint64_t bytes = 0;
    for (const PlyProperty& property : properties) {
        if (format == PlyFormat::ascii) {
            bytes += 2;
        } else {
            bytes += ply_size(property.is_list ? property.count_type : property.type);
        }
    }
    return bytes;
}

int PlyElement::find(const std::vector<std::string_view>& names) const {
    for (const std::string_view wanted : names) {
        for (size_t i = 0; i < properties.size(); ++i) {
            if (properties[i].name == wanted) return static_cast<int>(i);
        }
    }
    return -1;
}

PlyHeader parse_ply_header(std::string_view bytes, const std::string& file) {
    PlyHeader header;
    bool has_format = false;
    size_t position = 0;
    for (int line_number = 1;; ++line_number) {
        const Place place{file, line_number, 0};
        const size_t end = bytes.find('\n', position);
        std::string_view line = bytes.substr(
            position, end == std::string_view::npos ? std::string_view::npos : end - position);
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        if (line_number == 1) {
            if (line != "ply")
                user_error_at(place, "no PLY file; expected 'ply' in the first line");
        } else if (line.size() > 4096) {
            user_error_at(place,
                          "a line of {} bytes in a PLY header; expected 'end_header' before "
                          "the data",
                          line.size());
        }
        const std::vector<std::string_view> words = split(line);
        if (line_number > 1 && !words.empty()) {
            if (words[0] == "format") {
                header.format = parse_format(words, place);
                has_format = true;
            } else if (words[0] == "element") {
                header.elements.push_back(parse_element(words, place));
            } else if (words[0] == "property") {
                if (header.elements.empty()) {
                    user_error_at(place, "a PLY property before any element");
                }
                header.elements.back().properties.push_back(parse_property(words, place));
            } else if (words[0] == "end_header") {
                if (!has_format) user_error_at(place, "a PLY header without 'format'");
                header.body = end == std::string_view::npos ? bytes.size() : end + 1;
                header.body_line = line_number + 1;
                return header;
            } else if (words[0] != "comment" && words[0] != "obj_info") {
                user_error_at(place,
                              "'{}' in a PLY header; expected format, comment, obj_info, "
                              "element, property or end_header",
                              shown(words[0]));
            }
        }
        if (end == std::string_view::npos) {
            user_error_at(place, "the file ends within the PLY header; expected 'end_header'");
        }
        position = end + 1;
    }
}

}  // namespace drude
