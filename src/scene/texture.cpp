// Texture: which builder serves, and what is the same everywhere is made a constant at once.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "base/numbers.h"
#include "scene/builders.h"
#include "scene/spectra.h"
#include "scene/transforms.h"
#include "scene/vocabulary.h"

namespace drude {

namespace {

// A texture of textures of textures doubles its work at every step; this keeps it finite.
constexpr int most_visits = 4096;

// One kind of value, so that one piece of code builds both.
template <class Value>
struct Kind;

template <>
struct Kind<NumberValue> {
    static NumberValue of(double value) { return {value}; }
    static NumberValue constant(ParameterList& list, const std::string& name, double otherwise,
                                BuildContext&) {
        return {list.number(name, otherwise)};
    }
    static NumberValue operand(ParameterList& list, const std::string& name, double otherwise,
                               BuildContext& context) {
        return number_value(list, name, otherwise, context);
    }
    static void add(NumberValue& sum, double weight, const NumberValue& value) {
        sum.constant += weight * value.constant;
    }
    static double size(const NumberValue& value) { return std::abs(value.constant); }
    static auto& names(Textures& textures) { return textures.numbers; }
    static auto& list(Textures& textures) { return textures.number_textures; }
    static auto& visits(Textures& textures) { return textures.number_visits; }
};

template <>
struct Kind<SpectrumValue> {
    static SpectrumValue of(double value) { return {constant_spectrum(value)}; }
    static SpectrumValue given(ParameterList& list, const std::string& name, double otherwise,
                               const std::vector<ParameterType>& types, BuildContext& context) {
        const Parameter* parameter = list.any_of(name, types);
        return parameter == nullptr ? of(otherwise) : matter_value(*parameter, context);
    }
    static SpectrumValue constant(ParameterList& list, const std::string& name, double otherwise,
                                  BuildContext& context) {
        return given(list, name, otherwise,
                     {ParameterType::rgb, ParameterType::spectrum, ParameterType::blackbody},
                     context);
    }
    static SpectrumValue operand(ParameterList& list, const std::string& name, double otherwise,
                                 BuildContext& context) {
        return given(list, name, otherwise,
                     {ParameterType::rgb, ParameterType::spectrum, ParameterType::blackbody,
                      ParameterType::texture},
                     context);
    }
    static void add(SpectrumValue& sum, double weight, const SpectrumValue& value) {
        for (size_t i = 0; i < sum.constant.size(); ++i) {
            sum.constant[i] += weight * value.constant[i];
        }
    }
    static double size(const SpectrumValue& value) {
        double largest = 0;
        for (const double v : value.constant) largest = std::max(largest, std::abs(v));
        return largest;
    }
    static auto& names(Textures& textures) { return textures.spectra; }
    static auto& list(Textures& textures) { return textures.spectrum_textures; }
    static auto& visits(Textures& textures) { return textures.spectrum_visits; }
};

// The constants of some values, weighted.
template <class Value>
Value typical(std::initializer_list<std::pair<double, const Value*>> parts) {
    Value sum = Kind<Value>::of(0);
    for (const auto& part : parts) Kind<Value>::add(sum, part.first, *part.second);
    return sum;
}

template <class Value>
class TextureBuilder {
  public:
    TextureBuilder(const std::string& name, const std::string& type, ParameterList& list,
                   const glm::dmat4& world_from_texture, BuildContext& context)
        : name_(name),
          type_(type),
          list_(list),
          world_from_texture_(world_from_texture),
          context_(context) {}

    void build() {
        Textures& textures = context_.textures;
        const Value value = in_range(read(), "");
        list_.finish(known_parameters("Texture", type_), context_.messages);
        if (!Kind<Value>::names(textures).emplace(name_, value).second) {
            user_error_at(list_.place(), "the texture '{}' is defined twice; expected another name",
                          shown(name_));
        }
    }

  private:
    Value read() {
        if (type_ == "constant") return Kind<Value>::constant(list_, "value", 1, context_);
        if (type_ == "scale") return read_scale();
        if (type_ == "mix") return read_mix();
        if (type_ == "imagemap") {
            ImageTexture image = build_image_texture(list_, world_from_texture_, context_);
            const double middle = image.invert ? 1 - 0.5 * image.scale : 0.5 * image.scale;
            return add(std::move(image), Kind<Value>::of(middle), {});
        }
        if (type_ == "checkerboard") return read_checkerboard();
        if (type_ == "bilerp") return read_bilerp();
        if (type_ == "directionmix") return read_direction_mix();
        context_.messages.stand_in(
            list_.place(),
            fmt::format("Texture \"{}\" is not drawn; a constant 0.5 stands in", type_));
        list_.ignore(known_parameters("Texture", type_));
        return Kind<Value>::of(0.5);
    }

    // What is drawn is single precision, and differences of products of these.
    template <class Any>
    Any in_range(Any value, const std::string& name) const {
        constexpr double largest = 1e15;
        const double size = Kind<Any>::size(value);
        if (size <= largest) return value;
        user_error_at(list_.place_of(name), "{}: {} comes to {}; expected at most {}",
                      list_.owner(), name.empty() ? "the texture" : name, format_double(size),
                      format_double(largest));
    }

    Value operand(const std::string& name, double otherwise) {
        return in_range(Kind<Value>::operand(list_, name, otherwise, context_), name);
    }
    Value corner(const std::string& name, double otherwise) {
        return in_range(Kind<Value>::constant(list_, name, otherwise, context_), name);
    }
    NumberValue factor(const std::string& name, double otherwise) {
        return in_range(number_value(list_, name, otherwise, context_), name);
    }

    Value read_scale() {
        ScaleTexture<Value> scale{operand("tex", 1), factor("scale", 1)};
        const auto middle = typical<Value>({{scale.scale.constant, &scale.texture}});
        if (scale.texture.texture < 0 && scale.scale.texture < 0) return middle;
        const int visits = visits_of(scale.texture) + visits_of(scale.scale);
        return add(std::move(scale), middle, visits);
    }

    Value read_mix() {
        MixTexture<Value> mix{operand("tex1", 0), operand("tex2", 1), factor("amount", 0.5)};
        const double t = mix.amount.constant;
        const auto middle = typical<Value>({{1 - t, &mix.first}, {t, &mix.second}});
        if (mix.amount.texture < 0) {
            if (mix.first.texture < 0 && mix.second.texture < 0) return middle;
            if (t == 0) return mix.first;
            if (t == 1) return mix.second;
        }
        const int visits = visits_of(mix.first) + visits_of(mix.second) + visits_of(mix.amount);
        return add(std::move(mix), middle, visits);
    }

    Value read_checkerboard() {
        CheckerboardTexture<Value> board;
        board.dimension = list_.integer_in("dimension", 2, 2, 3);
        board.first = operand("tex1", 1);
        board.second = operand("tex2", 0);
        if (board.dimension == 2) {
            board.mapping = build_mapping(list_, world_from_texture_);
        } else {
            board.mapping.texture_from_world = glm::inverse(world_from_texture_);
        }
        const auto middle = typical<Value>({{0.5, &board.first}, {0.5, &board.second}});
        const int visits = visits_of(board.first) + visits_of(board.second);
        return add(std::move(board), middle, visits);
    }

    Value read_bilerp() {
        BilerpTexture<Value> bilerp;
        bilerp.mapping = build_mapping(list_, world_from_texture_);
        bilerp.v00 = corner("v00", 0);
        bilerp.v01 = corner("v01", 1);
        bilerp.v10 = corner("v10", 0);
        bilerp.v11 = corner("v11", 1);
        const auto middle = typical<Value>(
            {{0.25, &bilerp.v00}, {0.25, &bilerp.v01}, {0.25, &bilerp.v10}, {0.25, &bilerp.v11}});
        return add(std::move(bilerp), middle, 0);
    }

    Value read_direction_mix() {
        DirectionMixTexture<Value> mix{operand("tex1", 0), operand("tex2", 1), {0, 1, 0}};
        const glm::dvec3 own = list_.vector3("dir", {0, 1, 0});
        const glm::dvec3 direction = transform_vector(world_from_texture_, own);
        const double length = glm::length(direction);
        if (!(length > 0) || !std::isfinite(length)) {
            user_error_at(list_.place_of("dir"), "{}: dir has no direction; expected a vector",
                          list_.owner());
        }
        mix.direction = direction / length;
        const auto middle = typical<Value>({{0.5, &mix.first}, {0.5, &mix.second}});
        const int visits = visits_of(mix.first) + visits_of(mix.second);
        return add(std::move(mix), middle, visits);
    }

    int visits_of(const NumberValue& value) const {
        return value.texture < 0 ? 0 : context_.textures.number_visits[value.texture];
    }
    int visits_of(const SpectrumValue& value) const {
        return value.texture < 0 ? 0 : context_.textures.spectrum_visits[value.texture];
    }

    // Enters a texture that visits that many others; `middle` is its constant.
    template <class Any>
    Value add(Any&& texture, Value middle, int visits) {
        if (visits >= most_visits) {
            user_error_at(list_.place(),
                          "the texture '{}' is made of {} textures, counted once for every use; "
                          "expected fewer than {}",
                          shown(name_), visits, most_visits);
        }
        auto& all = Kind<Value>::list(context_.textures);
        middle.texture = static_cast<int>(all.size());
        all.emplace_back(std::forward<Any>(texture));
        Kind<Value>::visits(context_.textures).push_back(visits + 1);
        return middle;
    }

    const std::string& name_;
    const std::string& type_;
    ParameterList& list_;
    const glm::dmat4& world_from_texture_;
    BuildContext& context_;
};

}  // namespace

void build_texture(const std::string& name, bool is_spectrum, const std::string& type,
                   ParameterList& list, const glm::dmat4& world_from_texture,
                   BuildContext& context) {
    if (is_spectrum) {
        TextureBuilder<SpectrumValue>(name, type, list, world_from_texture, context).build();
    } else {
        TextureBuilder<NumberValue>(name, type, list, world_from_texture, context).build();
    }
}

}  // namespace drude
