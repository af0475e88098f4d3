#include "render/texture_picture.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "image/srgb.h"

namespace drude {

namespace {

using Wrap = ImageTexture::Wrap;

// Keeps coordinates where they can be counted in pixels; what is not a number is 0.
double tame(double s, Wrap wrap) {
    if (!std::isfinite(s)) return 0;
    return wrap == Wrap::repeat ? s - std::floor(s) : std::clamp(s, -2.0, 3.0);
}

// The pixel that stands for pixel i of [0, size); -1 for black.
long long wrapped(long long i, int size, Wrap wrap) {
    if (i >= 0 && i < size) return i;
    if (wrap == Wrap::black) return -1;
    if (wrap == Wrap::clamp) return i < 0 ? 0 : size - 1;
    const long long rest = i % size;
    return rest < 0 ? rest + size : rest;
}

double linear_from(double value, const ImageTexture& texture) {
    switch (texture.encoding) {
        case ImageTexture::Encoding::srgb:
            return linear_from_srgb(static_cast<float>(value));
        case ImageTexture::Encoding::gamma:
            return std::pow(value, texture.gamma);
        case ImageTexture::Encoding::linear:
            break;
    }
    return value;
}

}  // namespace

TexturePicture::TexturePicture(const ImageTexture& texture,
                               std::shared_ptr<const TexelSource> source)
    : texture_(texture), source_(std::move(source)) {
    for (size_t i = 0; i < decoded_.size(); ++i) {
        decoded_[i] = static_cast<float>(linear_from(static_cast<double>(i) / 255, texture_));
    }
}

double TexturePicture::decode(float value) const {
    if (!source_->is_integer()) return std::isfinite(value) ? value : 0;
    const float scaled = 255 * value;
    const long nearest = std::lround(scaled);
    if (std::abs(scaled - static_cast<float>(nearest)) < 1e-4f && nearest >= 0 && nearest < 256) {
        return decoded_[static_cast<size_t>(nearest)];
    }
    return linear_from(value, texture_);  // of 16 bits
}

glm::dvec3 TexturePicture::colour(const float* values) const {
    if (source_->channels() == 1) return glm::dvec3(decode(values[0]));
    return {decode(values[0]), decode(values[1]), decode(values[2])};
}

glm::dvec3 TexturePicture::texel(long long x, long long y) const {
    x = wrapped(x, source_->width(), texture_.wrap);
    y = wrapped(y, source_->height(), texture_.wrap);
    if (x < 0 || y < 0) return glm::dvec3(0);
    float values[3];
    source_->read(static_cast<int>(x), static_cast<int>(y), 1, 1, values);
    return colour(values);
}

void TexturePicture::corners(long long x, long long y, glm::dvec3 values[4]) const {
    if (x >= 0 && y >= 0 && x + 1 < source_->width() && y + 1 < source_->height()) {
        float raw[12];
        source_->read(static_cast<int>(x), static_cast<int>(y), 2, 2, raw);
        for (int i = 0; i < 4; ++i) values[i] = colour(raw + i * source_->channels());
        return;
    }
    for (int i = 0; i < 4; ++i) values[i] = texel(x + i % 2, y + i / 2);
}

glm::dvec3 TexturePicture::look_up(glm::dvec2 st) const {
    // Rows count from the top.
    st.y = 1 - st.y;
    const double x = tame(st.x, texture_.wrap) * source_->width() - 0.5;
    const double y = tame(st.y, texture_.wrap) * source_->height() - 0.5;
    if (!texture_.bilinear) return texel(std::llround(x), std::llround(y));
    const double left = std::floor(x), top = std::floor(y);
    glm::dvec3 v[4];
    corners(static_cast<long long>(left), static_cast<long long>(top), v);
    const double right = x - left, down = y - top;
    return (1 - down) * ((1 - right) * v[0] + right * v[1]) +
           down * ((1 - right) * v[2] + right * v[3]);
}

glm::dvec3 TexturePicture::rgb(const glm::dvec2& st) const {
    try {
        glm::dvec3 value = texture_.scale * look_up(st);
        if (texture_.invert) value = 1.0 - value;
        return {std::fmax(value.x, 0), std::fmax(value.y, 0), std::fmax(value.z, 0)};
    } catch (const Error& error) {
        throw Error(error.cause(), texture_.place, error.message());
    }
}

double TexturePicture::number(const glm::dvec2& st) const {
    try {
        const double value = texture_.scale * look_up(st).x;
        return texture_.invert ? std::fmax(1 - value, 0) : value;
    } catch (const Error& error) {
        throw Error(error.cause(), texture_.place, error.message());
    }
}

}  // namespace drude
