#include "render/courtyard_scene.h"

#include <glm/geometric.hpp>

#include "render/courtyard_stone.h"

namespace drude::courtyard {

namespace {

constexpr double eaves_overhang = 0.9;

// CIE overcast sky (Moon & Spencer 1942): L = Lz (1 + 2 cos theta) / 3, with gentle cloud, and the
// sun behind it as a wide soft lobe.
Radiance sky(const glm::dvec3& d) {
    const double up = std::max(d.z, 0.02);
    const double overcast = zenith_radiance * (1 + 2 * up) / 3;
    const double cloud = cloud_noise(1.7 * d.x / (up + 0.2) + 3.1, 2.3 * d.y / (up + 0.2), 11);
    const double level = overcast * (0.80 + 0.40 * cloud);
    const glm::dvec3 colour =
        glm::mix(glm::dvec3(0.96, 1.0, 1.12), glm::dvec3(0.82, 1.0, 1.36), ramp(0.72, 0.35, cloud));
    static const glm::dvec3 sun = glm::normalize(glm::dvec3(-0.36, 0.06, 1.0));
    const double away = std::acos(std::clamp(glm::dot(d, sun), -1.0, 1.0));
    constexpr double core = 0.13, halo = 0.34;  // radians
    const double veil = 0.7 * std::exp(-0.5 * away * away / (core * core)) +
                        0.3 * std::exp(-0.5 * away * away / (halo * halo));
    return {level * colour, veil * (0.85 + 0.3 * cloud)};
}

// Boards and rafters seen from below.
Radiance eaves(const glm::dvec3& hit, double along) {
    const double rafter = std::abs(to_nearest(along, 0.6)) < 0.09 ? 1.2 : 0.6;
    const double out = (half_width - std::abs(hit.y)) / eaves_overhang;
    return lit(oak * 1.5, 0.0, rafter * (0.7 + 0.8 * std::clamp(out, 0.0, 1.0)));
}

double ground_sky_share(double y) {
    const double left = half_width + y, right = half_width - y;
    return 0.5 * (left / std::hypot(left, eaves_height) + right / std::hypot(right, eaves_height));
}

// Worn slabs in running bond between bands of grey stone.
Radiance paving(const Ray& ray, double t) {
    const glm::dvec3 p = ray.at(t);
    const double cosine = std::max(-ray.direction.z, 1e-3);
    const double footprint = t * ray.texel_angle, stretched = footprint / cosine;
    // Across and along the line of sight the footprint differs; take what each joint meets.
    const double flat = std::hypot(ray.direction.x, ray.direction.y);
    const double share_x = flat > 0 ? std::abs(ray.direction.x) / flat : 0.5;
    const double width_x = std::lerp(footprint, stretched, share_x);
    const double width_y = std::lerp(stretched, footprint, share_x);

    const double lane = std::abs(p.y);
    const double band_y =
        std::max(line_cover(lane - 2.7, 0.5, width_y), line_cover(lane - 7.55, 0.6, width_y));
    const double band_x =
        lane < 7.3 ? line_cover(to_nearest(p.x - 0.5 * bay, bay), 0.5, width_x) : 0;
    const double band = std::max(band_y, band_x);

    constexpr double slab_x = 0.9, slab_y = 0.54;
    const double row = std::floor(p.y / slab_y);
    const double shift = static_cast<int64_t>(row) % 2 == 0 ? 0.0 : 0.5 * slab_x;
    const double column = std::floor((p.x + shift) / slab_x);
    const double joint = std::max(line_cover(to_nearest(p.x + shift, slab_x), 0.022, width_x),
                                  line_cover(to_nearest(p.y, slab_y), 0.022, width_y));
    const double fade = std::clamp(1 - std::max(width_x / slab_x, width_y / slab_y), 0.0, 1.0);
    const double tone =
        cell_noise(static_cast<int64_t>(column), static_cast<int64_t>(row), 21) - 0.5;
    const double warm =
        cell_noise(static_cast<int64_t>(column), static_cast<int64_t>(row), 22) - 0.5;
    const double wear = cloud_noise(0.6 * p.x, 0.6 * p.y, 41) - 0.5;

    glm::dvec3 slab = paving_stone * (1 + 0.34 * fade * tone + 0.30 * wear);
    slab *= glm::dvec3(1 + 0.10 * fade * warm, 1.0, 1 - 0.14 * fade * warm);
    const glm::dvec3 strip = grey_stone * (0.95 + 0.3 * wear);
    const glm::dvec3 albedo = glm::mix(slab * (1 - 0.55 * joint), strip, 0.85 * band);
    const double open =
        corner_shade(half_width - lane, 1.4) * corner_shade(half_length - std::abs(p.x), 2.0);
    Radiance seen = lit(albedo, 0.86 * ground_sky_share(std::clamp(p.y, -7.9, 7.9)), open);
    if (ray.mirrored == 0) {  // a dull gloss where feet have polished the stone
        const double fresnel = 0.03 + 0.97 * std::pow(1 - cosine, 5);
        const double gloss = 0.42 * fresnel * (0.6 + 0.8 * (wear + 0.5)) * (1 - 0.6 * joint);
        const glm::dvec3 up(ray.direction.x, ray.direction.y, -ray.direction.z);
        const Radiance mirror = trace({p + 1e-9 * up, up, 4 * ray.texel_angle, 1});
        seen.base = glm::mix(seen.base, mirror.base, gloss);
        seen.veil += gloss * mirror.veil;
    }
    return seen;
}

}  // namespace

glm::dvec3 veil_colour() {
    const glm::dvec3 white(1.015, 1.0, 0.965);
    return white / glm::dot(white, glm::dvec3(0.2126, 0.7152, 0.0722));
}

Radiance trace(const Ray& ray) {
    const glm::dvec3 &o = ray.origin, &d = ray.direction;
    constexpr double never = 1e30;
    const auto plane = [&](double origin, double direction, double at) {
        return direction != 0 ? (std::copysign(at, direction) - origin) / direction : never;
    };
    const double t_side = plane(o.y, d.y, half_width);
    const double t_end = plane(o.x, d.x, half_length);
    const double t_level = d.z > 0 ? (eaves_height - o.z) / d.z : d.z < 0 ? -o.z / d.z : never;
    if (t_level < std::min(t_side, t_end)) {
        if (d.z < 0) return paving(ray, t_level);
        const glm::dvec3 p = ray.at(t_level);
        if (std::abs(p.y) > half_width - eaves_overhang) return eaves(p, p.x);
        if (std::abs(p.x) > half_length - eaves_overhang)
            return eaves({0, half_width - half_length + std::abs(p.x), 0}, p.y);
        return sky(d);
    }

    // Into the frame of the wall that the ray meets; the side's sign folds both walls into one.
    const bool side_wall = t_side < t_end;
    WallRay local;
    local.texel_angle = ray.texel_angle;
    if (side_wall) {
        const double sign = d.y > 0 ? 1 : -1;
        local.kind = WallKind::facade;
        local.origin = {o.x, sign * o.y - half_width, o.z};
        local.direction = {d.x, sign * d.y, d.z};
        local.half_extent = half_length;
        local.opposite = 2 * half_width;
        local.salt = sign > 0 ? 100 : 200;
    } else {
        const double sign = d.x > 0 ? 1 : -1;
        local.kind = sign > 0 ? WallKind::portal_end : WallKind::arch_end;
        local.origin = {o.y, sign * o.x - half_length, o.z};
        local.direction = {d.y, sign * d.x, d.z};
        local.half_extent = half_width;
        local.opposite = 2 * half_width;  // the nearer, side walls are what hides the sky
        local.salt = sign > 0 ? 300 : 400;
    }
    const double t = std::min(t_side, t_end);
    if (ray.mirrored == 0 && ray.at(t).z > 6) {
        glm::dvec3 back = d;
        (side_wall ? back.y : back.x) *= -1;
        local.mirrored = trace({ray.at(t) + 1e-9 * back, back, 2 * ray.texel_angle, 1});
    } else {
        local.mirrored = {glm::dvec3(0.4, 0.4, 0.42), 0.0};
    }
    return wall(local);
}

}  // namespace drude::courtyard
