#include "render/environment.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "base/error.h"
#include "image/equal_area.h"
#include "materials/scalar.h"

namespace drude {

namespace {

constexpr float pi_f = static_cast<float>(pi);

float luminance(const glm::vec3& rgb) {
    return 0.2126f * rgb.x + 0.7152f * rgb.y + 0.0722f * rgb.z;
}

// atan2 within 3e-7, in a fifth of the library's time: a directory of texels needs no more. The
// polynomial is the minimax one of atan(x)/x in x^2 on [0, 1], fitted for this.
float fast_atan2(float y, float x) {
    const float ax = std::abs(x), ay = std::abs(y);
    const float large = std::max(ax, ay), small = std::min(ax, ay);
    const float t = large > 0 ? small / large : 0.0f, s = t * t;
    float p = -4.0545668e-3f;
    for (const float c : {2.1862958e-2f, -5.5912327e-2f, 9.6421972e-2f, -1.3908629e-1f,
                          1.9946566e-1f, -3.3329859e-1f, 9.9999934e-1f}) {
        p = p * s + c;
    }
    float angle = p * t;
    if (ay > ax) angle = pi_f / 2 - angle;
    if (x < 0) angle = pi_f - angle;
    return y < 0 ? -angle : angle;
}

// (cos, sin) of 2 pi t for t in [0, 1], within 1e-7 of the library's in a fifth of its time. The
// polynomials are minimax ones on an eighth of a turn to either side, in quarter turns.
glm::vec2 direction_of_turn(float t) {
    const float quarters = 4 * t;
    const float nearest = std::floor(quarters + 0.5f);
    const float r = quarters - nearest, s = r * r;
    const float sine =
        r * (1.57079637f + s * (-0.64596349f + s * (0.0796802267f + s * -0.00460217707f)));
    const float cosine =
        1 + s * (-1.23370051f + s * (0.253669202f + s * (-0.0208600722f + s * 9.03631677e-4f)));
    const int turned = static_cast<int>(nearest) & 3;
    const float x = turned & 1 ? sine : cosine, y = turned & 1 ? cosine : sine;
    return {turned == 1 || turned == 2 ? -x : x, turned >= 2 ? -y : y};
}

}  // namespace

Environment::Environment(const Image& image, double scale, const glm::dmat4& world_from_light,
                         const std::string& where, bool compensated)
    : width_(image.width), height_(image.height) {
    lat_long_ = width_ == 2 * height_;
    if (!lat_long_ && width_ != height_) {
        user_error(
            "{}: the picture is {} x {}; an environment must be twice as wide as high (lat-long) "
            "or square (equal-area)",
            where, width_, height_);
    }
    const Channel* grey = image.find("Y");
    const Channel& r = grey && !image.find("R") ? *grey : image.at("R", where);
    const Channel& g = grey && !image.find("G") ? *grey : image.at("G", where);
    const Channel& b = grey && !image.find("B") ? *grey : image.at("B", where);

    const glm::dmat3 matrix(world_from_light);
    const double scale_of_space = std::cbrt(std::abs(glm::determinant(matrix)));
    world_from_light_ = glm::mat3(matrix / scale_of_space);
    light_from_world_ = glm::mat3(glm::inverse(matrix) * scale_of_space);

    texels_.resize(image.pixels());
    std::vector<float> solid_angle_weight(static_cast<size_t>(height_), 1.0f);
    if (lat_long_) {
        for (int y = 0; y < height_; ++y) {
            // The exact share of a row: the difference of cosines, not sin at its middle.
            solid_angle_weight[y] = static_cast<float>(
                (std::cos(pi * y / height_) - std::cos(pi * (y + 1) / height_)) * height_ / 2);
        }
    }
    double total = 0;
    for (size_t i = 0; i < texels_.size(); ++i) {
        glm::vec3 rgb(r.data[i], g.data[i], b.data[i]);
        bool repaired = false;
        for (int c = 0; c < 3; ++c) {
            if (!(rgb[c] >= 0) || !std::isfinite(rgb[c])) {
                rgb[c] = 0;
                repaired = true;
            }
        }
        repaired_ += repaired;
        texels_[i] = glm::vec4(rgb * static_cast<float>(scale), 0);
        total += static_cast<double>(luminance(glm::vec3(texels_[i]))) *
                 static_cast<double>(solid_angle_weight[i / width_]);
    }
    mean_luminance_ = total / static_cast<double>(texels_.size());
    if (!(mean_luminance_ > 0)) user_error("{}: the picture is black everywhere", where);
    if (!std::isfinite(mean_luminance_)) user_error("{}: the picture is too bright", where);

    const size_t groups = (static_cast<size_t>(width_) + group_size - 1) / group_size;
    std::vector<float> row_sums(static_cast<size_t>(height_));
    std::vector<float> group_sums(static_cast<size_t>(height_) * groups);
    const auto build = [&](float threshold) {
        double rows = 0;
        for (int y = 0; y < height_; ++y) {
            double row = 0;
            for (int x = 0; x < width_; ++x) {
                const size_t i = static_cast<size_t>(y) * width_ + x;
                texels_[i].w = std::max(0.0f, luminance(glm::vec3(texels_[i])) - threshold);
                row += static_cast<double>(texels_[i].w);
                group_sums[static_cast<size_t>(y) * groups + x / group_size] =
                    static_cast<float>(row);
            }
            rows += row * static_cast<double>(solid_angle_weight[y]);
            row_sums[y] = static_cast<float>(rows);
        }
        return rows;
    };
    double rows = build(compensated ? static_cast<float>(mean_luminance_) : 0.0f);
    // A constant sky has nothing above its mean.
    if (!(rows > 1e-6 * mean_luminance_ * static_cast<double>(texels_.size()))) rows = build(0);
    const auto normalise = static_cast<float>(static_cast<double>(texels_.size()) / rows);
    for (glm::vec4& t : texels_) t.w *= normalise;
    rows_ = CumulativeRows(row_sums, static_cast<size_t>(height_));
    groups_ = CumulativeRows(group_sums, groups);
    for (int y = 0; y <= height_; ++y) {
        edge_.push_back(static_cast<float>(std::cos(pi * y / height_)));
    }
}

size_t Environment::texel(const glm::vec3& l) const {
    glm::vec2 uv;
    if (lat_long_) {
        const float phi = fast_atan2(l.y, l.x);
        uv = {(phi < 0 ? phi + 2 * pi_f : phi) * (1 / (2 * pi_f)),
              fast_atan2(std::sqrt(l.x * l.x + l.y * l.y), l.z) * (1 / pi_f)};
    } else {
        uv = equal_area_square<float>(glm::normalize(l));
    }
    const int x = std::clamp(static_cast<int>(uv.x * static_cast<float>(width_)), 0, width_ - 1);
    const int y = std::clamp(static_cast<int>(uv.y * static_cast<float>(height_)), 0, height_ - 1);
    return static_cast<size_t>(y) * width_ + x;
}

glm::vec3 Environment::radiance(const glm::vec3& d) const {
    return glm::vec3(texels_[texel(light_from_world_ * d)]);
}

// A texel of weight w (1 on average over the sphere) is chosen in proportion to w times its solid
// angle, and uniformly in solid angle within, so the density over light-space directions is
// w / 4 pi. A linear map W of determinant +-1 takes the solid angle around a unit vector d to
// 1 / |W d|^3 of it; for a rotation that is 1.
Environment::Light Environment::light(const glm::vec3& d) const {
    const glm::vec3 l = light_from_world_ * d;
    const float size2 = glm::dot(l, l);
    const glm::vec4& t = texels_[texel(l)];
    return {glm::vec3(t), t.w / (4 * pi_f * size2 * std::sqrt(size2))};
}

// Which of the group's texels, and where in it, by the group's own uniform number.
size_t Environment::texel_of_group(size_t y, size_t first, float u, float* inside) const {
    const glm::vec4* group = &texels_[y * static_cast<size_t>(width_) + first];
    const size_t count = std::min<size_t>(group_size, static_cast<size_t>(width_) - first);
    float total = 0;
    for (size_t k = 0; k < count; ++k) total += group[k].w;
    float target = u * total;
    size_t last = 0;  // of some weight: where rounding carries the target beyond all of them
    for (size_t k = 0; k < count; ++k) {
        if (!(group[k].w > 0)) continue;
        last = k;
        if (target < group[k].w) break;
        target -= group[k].w;
    }
    *inside = std::clamp(target / group[last].w, 0.0f, 0x1.fffffep-1f);
    return last;
}

Environment::Sample Environment::sample(const glm::vec2& u) const {
    float inside_group = 0, inside_x = 0, inside_y = 0;
    const size_t y = rows_.find(0, u.y, &inside_y);
    const size_t first = groups_.find(y, u.x, &inside_group) * group_size;
    const size_t x = first + texel_of_group(y, first, inside_group, &inside_x);
    const float fx = (static_cast<float>(x) + inside_x) / static_cast<float>(width_);
    glm::vec3 l;
    if (lat_long_) {
        const glm::vec2 side = direction_of_turn(fx);
        const float z = edge_[y] + inside_y * (edge_[y + 1] - edge_[y]);
        const float r = std::sqrt(std::max(0.0f, 1 - z * z));
        l = {r * side.x, r * side.y, z};
    } else {
        l = equal_area_direction<float>(
            {fx, (static_cast<float>(y) + inside_y) / static_cast<float>(height_)});
    }
    Sample s;
    const glm::vec3 d = world_from_light_ * l;
    const float size = glm::length(d);
    s.d = d / size;
    const glm::vec4& t = texels_[y * static_cast<size_t>(width_) + x];
    s.radiance = glm::vec3(t);
    s.pdf = t.w * size * size * size / (4 * pi_f);
    return s;
}

}  // namespace drude
