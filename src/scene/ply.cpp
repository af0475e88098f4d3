#include "scene/ply.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "base/numbers.h"
#include "scene/builders.h"
#include "scene/lexer.h"
#include "scene/ply_header.h"

namespace drude {

namespace {

// The numbers behind the header, one after the other, whatever the format.
class Body {
  public:
    Body(std::string_view bytes, const std::string& file, const PlyHeader& header)
        : bytes_(bytes),
          file_(file),
          format_(header.format),
          position_(header.body),
          line_(header.body_line) {}

    size_t left() const { return bytes_.size() - position_; }
    double read(PlyType type) { return format_ == PlyFormat::ascii ? ascii() : binary(type); }

    // Where the number that was read last stood.
    [[noreturn]] void fail(const std::string& message) const {
        if (format_ == PlyFormat::ascii) user_error_at({file_, line_, 0}, "{}", message);
        user_error("{}: byte {}: {}", file_, last_, message);
    }

    void skip_blanks() {
        if (format_ != PlyFormat::ascii) return;
        while (position_ < bytes_.size() && is_blank(bytes_[position_])) {
            if (bytes_[position_++] == '\n') ++line_;
        }
    }

  private:
    static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

    double ascii() {
        skip_blanks();
        const size_t begin = last_ = position_;
        while (position_ < bytes_.size() && !is_blank(bytes_[position_])) ++position_;
        const std::string_view word = bytes_.substr(begin, position_ - begin);
        if (word.empty()) fail("the file ends here; expected more numbers");
        const std::optional<double> value = parse_double(word);
        if (!value) fail(fmt::format("found '{}'; expected a number", shown(word)));
        return *value;
    }

    template <class T>
    T raw() {
        last_ = position_;
        if (left() < sizeof(T)) fail("the file ends here; expected more numbers");
        char buffer[sizeof(T)];
        std::memcpy(buffer, bytes_.data() + position_, sizeof(T));
        position_ += sizeof(T);
        const bool is_native =
            (format_ == PlyFormat::little_endian) == (std::endian::native == std::endian::little);
        if (!is_native) std::reverse(buffer, buffer + sizeof(T));
        T value;
        std::memcpy(&value, buffer, sizeof(T));
        return value;
    }

    double binary(PlyType type) {
        switch (type) {
            case PlyType::int8:
                return raw<int8_t>();
            case PlyType::uint8:
                return raw<uint8_t>();
            case PlyType::int16:
                return raw<int16_t>();
            case PlyType::uint16:
                return raw<uint16_t>();
            case PlyType::int32:
                return raw<int32_t>();
            case PlyType::uint32:
                return raw<uint32_t>();
            case PlyType::float32:
                return static_cast<double>(raw<float>());
            case PlyType::float64:
                return raw<double>();
        }
        return 0;
    }

    std::string_view bytes_;
    const std::string& file_;
    PlyFormat format_;
    size_t position_, last_ = 0;
    int line_;
};

float finite(double value, const Body& body) {
    if (!(std::abs(value) <= 1e15)) {
        body.fail(
            fmt::format("found {}; expected a coordinate of at most 1e15", format_double(value)));
    }
    return static_cast<float>(value);
}

uint64_t list_length(const PlyProperty& property, Body& body, PlyFormat format) {
    const double length = body.read(property.count_type);
    const uint64_t least = format == PlyFormat::ascii ? 2 : ply_size(property.type);
    // The last number of an ascii file has no blank behind it.
    if (!(length >= 0) || length != std::floor(length) ||
        length > static_cast<double>(body.left() + 1) / static_cast<double>(least)) {
        body.fail(fmt::format("a list of {} in '{}'; expected a count that the file can hold",
                              format_double(length), shown(property.name)));
    }
    return static_cast<uint64_t>(length);
}

void read_vertices(const PlyElement& element, Body& body, PlyFormat format, TriangleMesh& mesh) {
    const int position[3] = {element.find({"x"}), element.find({"y"}), element.find({"z"})};
    const int normal[3] = {element.find({"nx"}), element.find({"ny"}), element.find({"nz"})};
    const int uv[2] = {element.find({"u", "s", "texture_u", "texture_s"}),
                       element.find({"v", "t", "texture_v", "texture_t"})};
    for (const int axis : position) {
        if (axis < 0) {
            user_error_at(element.place, "PLY vertices without x, y and z; expected all three");
        }
    }
    for (const int index :
         {position[0], position[1], position[2], normal[0], normal[1], normal[2], uv[0], uv[1]}) {
        if (index < 0 || !element.properties[static_cast<size_t>(index)].is_list) continue;
        user_error_at(element.place, "the PLY vertices have a list '{}'; expected one number",
                      shown(element.properties[static_cast<size_t>(index)].name));
    }
    const bool has_normals = normal[0] >= 0 && normal[1] >= 0 && normal[2] >= 0;
    const bool has_uv = uv[0] >= 0 && uv[1] >= 0;
    mesh.positions.reserve(element.count);
    if (has_normals) mesh.normals.reserve(element.count);
    if (has_uv) mesh.uv.reserve(element.count);
    std::vector<double> values(element.properties.size());
    for (uint64_t i = 0; i < element.count; ++i) {
        for (size_t p = 0; p < values.size(); ++p) {
            const PlyProperty& property = element.properties[p];
            if (property.is_list) {
                const uint64_t length = list_length(property, body, format);
                for (uint64_t j = 0; j < length; ++j) body.read(property.type);
            } else {
                values[p] = body.read(property.type);
                const int index = static_cast<int>(p);
                const auto wanted = [&](const auto& some) {
                    return std::find(std::begin(some), std::end(some), index) != std::end(some);
                };
                if (wanted(position) || (has_normals && wanted(normal)) || (has_uv && wanted(uv))) {
                    finite(values[p], body);
                }
            }
        }
        const auto value = [&](int p) {
            return static_cast<float>(values[static_cast<size_t>(p)]);
        };
        mesh.positions.emplace_back(value(position[0]), value(position[1]), value(position[2]));
        if (has_normals) {
            mesh.normals.emplace_back(value(normal[0]), value(normal[1]), value(normal[2]));
        }
        if (has_uv) mesh.uv.emplace_back(value(uv[0]), value(uv[1]));
    }
}

void read_faces(const PlyElement& element, Body& body, PlyFormat format, TriangleMesh& mesh) {
    const int polygon = element.find({"vertex_indices", "vertex_index"});
    if (polygon < 0 || !element.properties[static_cast<size_t>(polygon)].is_list) {
        user_error_at(element.place, "PLY faces without the list 'vertex_indices'; expected it");
    }
    mesh.triangles.reserve(element.count);
    for (uint64_t i = 0; i < element.count; ++i) {
        for (size_t p = 0; p < element.properties.size(); ++p) {
            const PlyProperty& property = element.properties[p];
            const uint64_t length = property.is_list ? list_length(property, body, format) : 1;
            const bool is_polygon = static_cast<int>(p) == polygon;
            unsigned first = 0, previous = 0;
            for (uint64_t j = 0; j < length; ++j) {
                const double value = body.read(property.type);
                if (!is_polygon) continue;
                if (!(value >= 0 && value < static_cast<double>(mesh.positions.size())) ||
                    value != std::floor(value)) {
                    body.fail(fmt::format("index {}; expected 0 to {}", format_double(value),
                                          static_cast<long long>(mesh.positions.size()) - 1));
                }
                const auto index = static_cast<unsigned>(value);
                if (j == 0) first = index;
                if (j >= 2) mesh.triangles.emplace_back(first, previous, index);
                previous = index;
            }
        }
    }
}

void skip(const PlyElement& element, Body& body, PlyFormat format) {
    for (uint64_t i = 0; i < element.count; ++i) {
        for (const PlyProperty& property : element.properties) {
            const uint64_t length = property.is_list ? list_length(property, body, format) : 1;
            for (uint64_t j = 0; j < length; ++j) body.read(property.type);
        }
    }
}

void check_count(const PlyElement& element, const Body& body, PlyFormat format) {
    const uint64_t least = element.least_bytes(format);
    if (element.count > 0 && least == 0) {
        user_error_at(element.place, "{} PLY elements '{}' without properties; expected some",
                      element.count, shown(element.name));
    }
    if (least > 0 && element.count > (body.left() + 1) / least) {
        user_error_at(element.place,
                      "{} PLY elements '{}' of {} bytes at least, and {} bytes left; expected a "
                      "count that the file can hold",
                      element.count, shown(element.name), least, body.left());
    }
    if (element.count > std::numeric_limits<unsigned>::max()) {
        user_error_at(element.place, "{} PLY elements; expected at most {}", element.count,
                      std::numeric_limits<unsigned>::max());
    }
}

}  // namespace

TriangleMesh parse_ply(std::string_view bytes, const std::string& file, Messages& messages) {
    const PlyHeader header = parse_ply_header(bytes, file);
    Body body(bytes, file, header);
    TriangleMesh mesh;
    for (const PlyElement& element : header.elements) {
        check_count(element, body, header.format);
        if (element.name == "vertex") {
            if (!mesh.positions.empty()) user_error_at(element.place, "PLY vertices twice");
            read_vertices(element, body, header.format, mesh);
        } else if (element.name == "face") {
            read_faces(element, body, header.format, mesh);
        } else {
            skip(element, body, header.format);
        }
    }
    body.skip_blanks();
    if (body.left() > 0) {
        messages.note({file, 0, 0},
                      fmt::format("{}: {} bytes behind the last PLY element are not read", file,
                                  body.left()));
    }
    tidy_mesh(mesh, "the PLY file", {file, 0, 0}, messages);
    return mesh;
}

TriangleMesh build_ply_mesh(ParameterList& list, BuildContext& context) {
    const std::string name = list.text("filename", "");
    if (!list.has("filename")) {
        user_error_at(list.place(), "Shape \"plymesh\" without \"string filename\"; expected it");
    }
    const Place place = list.place_of("filename");
    const std::string path = context.assets.find(name, place.file, place, "PLY file");
    return parse_ply(context.assets.read(path, place), path, context.messages);
}

}  // namespace drude
