#include "render/textures.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "materials/scalar.h"
#include "render/reference_light.h"

namespace drude {

namespace {

glm::dvec3 texture_space(const TextureMapping& mapping, const TexturePoint& at) {
    return glm::dvec3(mapping.texture_from_world * glm::dvec4(at.p(), 1));
}

// Whether the square or cube that x lies in counts as odd along this axis.
bool is_odd(double x) {
    const double cell = std::floor(x);
    return cell / 2 != std::floor(cell / 2);
}

// One overload a kind of texture; pictures are drawn elsewhere.
struct Weigh {
    const NumberTextures& numbers;
    const TexturePoint& at;

    template <class Value>
    TextureWeights operator()(const ConstantTexture<Value>&) const {
        return {1, {1}};
    }
    TextureWeights operator()(const ImageTexture&) const { return {}; }
    template <class Value>
    TextureWeights operator()(const CheckerboardTexture<Value>& board) const {
        bool odd = false;
        if (board.dimension == 2) {
            const glm::dvec2 st = texture_coordinates(board.mapping, at);
            odd = is_odd(st.x) != is_odd(st.y);
        } else {
            const glm::dvec3 p = texture_space(board.mapping, at);
            odd = (is_odd(p.x) != is_odd(p.y)) != is_odd(p.z);
        }
        return odd ? TextureWeights{2, {0, 1}} : TextureWeights{2, {1, 0}};
    }
    template <class Value>
    TextureWeights operator()(const ScaleTexture<Value>& scale) const {
        return {1, {numbers.value(scale.scale, at)}};
    }
    template <class Value>
    TextureWeights operator()(const MixTexture<Value>& mix) const {
        const double amount = numbers.value(mix.amount, at);
        return {2, {1 - amount, amount}};
    }
    template <class Value>
    TextureWeights operator()(const BilerpTexture<Value>& bilerp) const {
        const glm::dvec2 st = texture_coordinates(bilerp.mapping, at);
        const double s = st.x, t = st.y;
        return {4, {(1 - s) * (1 - t), (1 - s) * t, s * (1 - t), s * t}};
    }
    template <class Value>
    TextureWeights operator()(const DirectionMixTexture<Value>& mix) const {
        const double along = std::fmin(1, std::abs(glm::dot(at.n(), mix.direction)));
        return {2, {along, 1 - along}};
    }
};

template <class Value>
struct PartsOf {
    using Parts = TextureParts<Value>;
    Parts operator()(const ConstantTexture<Value>& t) const { return {1, {&t.value}}; }
    Parts operator()(const ImageTexture&) const { return {}; }
    Parts operator()(const CheckerboardTexture<Value>& t) const {
        return {2, {&t.first, &t.second}};
    }
    Parts operator()(const ScaleTexture<Value>& t) const { return {1, {&t.texture}}; }
    Parts operator()(const MixTexture<Value>& t) const { return {2, {&t.first, &t.second}}; }
    Parts operator()(const BilerpTexture<Value>& t) const {
        return {4, {&t.v00, &t.v01, &t.v10, &t.v11}};
    }
    Parts operator()(const DirectionMixTexture<Value>& t) const {
        return {2, {&t.first, &t.second}};
    }
};

// Pictures by path, so that textures share them.
class PictureFiles {
  public:
    template <class Value>
    TexturePictures open(const std::vector<Texture<Value>>& textures) {
        TexturePictures pictures;
        for (const Texture<Value>& texture : textures) {
            const auto* image = std::get_if<ImageTexture>(&texture);
            pictures.push_back(
                image ? std::make_unique<const TexturePicture>(*image, source(*image)) : nullptr);
        }
        return pictures;
    }

  private:
    std::shared_ptr<const TexelSource> source(const ImageTexture& image) {
        std::shared_ptr<const TexelSource>& source = sources_[image.path];
        if (source) return source;
        try {
            source = std::make_shared<const TexelSource>(image.path);
        } catch (const Error& error) {
            throw Error(error.cause(), image.place, error.message());
        }
        return source;
    }
    std::map<std::string, std::shared_ptr<const TexelSource>> sources_;
};

double finite(double value) {
    return std::isfinite(value) ? value : 0;
}

}  // namespace

glm::dvec2 texture_coordinates(const TextureMapping& mapping, const TexturePoint& at) {
    if (mapping.kind == TextureMapping::Kind::uv) {
        const glm::dvec2& uv = at.uv();
        return {mapping.scale_u * uv.x + mapping.delta_u, mapping.scale_v * uv.y + mapping.delta_v};
    }
    const glm::dvec3 p = texture_space(mapping, at);
    const double around = std::atan2(p.y, p.x);
    switch (mapping.kind) {
        case TextureMapping::Kind::spherical: {
            const double cosine = p.z / glm::length(p);
            return {std::acos(std::clamp(cosine, -1.0, 1.0)) / pi,
                    (around < 0 ? around + 2 * pi : around) / (2 * pi)};
        }
        case TextureMapping::Kind::cylindrical:
            return {(pi + around) / (2 * pi), p.z};
        default:
            return {mapping.delta_u + glm::dot(p, mapping.v1),
                    mapping.delta_v + glm::dot(p, mapping.v2)};
    }
}

template <class Value>
TextureWeights NumberTextures::weights(const Texture<Value>& texture,
                                       const TexturePoint& at) const {
    return std::visit(Weigh{*this, at}, texture);
}
template TextureWeights NumberTextures::weights(const Texture<NumberValue>&,
                                                const TexturePoint&) const;
template TextureWeights NumberTextures::weights(const Texture<SpectrumValue>&,
                                                const TexturePoint&) const;

template <class Value>
TextureParts<Value> texture_parts(const Texture<Value>& texture) {
    return std::visit(PartsOf<Value>{}, texture);
}
template TextureParts<NumberValue> texture_parts(const Texture<NumberValue>&);
template TextureParts<SpectrumValue> texture_parts(const Texture<SpectrumValue>&);

NumberTextures::NumberTextures(const Scene& scene) : scene_(scene) {
    PictureFiles files;
    pictures_ = files.open(scene.number_textures);
    spectrum_pictures_ = files.open(scene.spectrum_textures);
}

double NumberTextures::textured(int index, const TexturePoint& at) const {
    if (const auto& picture = pictures_[index]) {
        return finite(picture->number(texture_coordinates(picture->mapping(), at)));
    }
    const Texture<NumberValue>& texture = scene_.number_textures[index];
    const TextureWeights w = weights(texture, at);
    const TextureParts<NumberValue> parts = texture_parts(texture);
    double sum = 0;
    for (int i = 0; i < w.count; ++i) {
        if (w.weight[i] != 0) sum += w.weight[i] * value(*parts.part[i], at);
    }
    return finite(sum);
}

double spectrum_texture_value(const Scene& scene, const NumberTextures& numbers,
                              const SpectrumValue& value, const TexturePoint& at, double nm) {
    if (value.texture < 0) return spectrum_at(value.constant, nm);
    double sum = 0;
    if (const auto& picture = numbers.spectrum_pictures()[value.texture]) {
        const glm::dvec3 rgb = picture->rgb(texture_coordinates(picture->mapping(), at));
        for (int c = 0; c < 3; ++c) sum += rgb[c] * spectrum_at(mallett_yuksel_basis()[c], nm);
        return finite(sum);
    }
    const Texture<SpectrumValue>& texture = scene.spectrum_textures[value.texture];
    const TextureWeights w = numbers.weights(texture, at);
    const TextureParts<SpectrumValue> parts = texture_parts(texture);
    for (int i = 0; i < w.count; ++i) {
        if (w.weight[i] != 0) {
            sum += w.weight[i] * spectrum_texture_value(scene, numbers, *parts.part[i], at, nm);
        }
    }
    return finite(sum);
}

}  // namespace drude
