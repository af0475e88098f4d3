#include "render/courtyard_wall.h"

namespace drude::courtyard {

namespace {

struct Window {
    double u, half, bottom, top;  // of the opening
    int floor;
};

// The window whose surroundings (surround, pediment, sill) hold (u, z), if any.
bool find_window(double u, double z, double half_extent, Window& window) {
    const double axis = bay * std::round(u / bay);
    if (std::abs(axis) > half_extent - 0.9) return false;
    if (z > storey && z < second_floor - 0.3) {
        window = {axis, 0.78, 7.9, 10.9, 1};
        return true;
    }
    if (z > second_floor && z < 18.6) {
        window = {axis, 0.68, 14.4, 16.6, 2};
        return true;
    }
    return false;
}

Radiance scaled(Radiance r, double factor) {
    return {r.base * factor, r.veil * factor};
}

Radiance plus(const Radiance& a, const Radiance& b) {
    return {a.base + b.base, a.veil + b.veil};
}

Radiance mix(const Radiance& a, const Radiance& b, double t) {
    return plus(scaled(a, 1 - t), scaled(b, t));
}

// The pane, its bars or a closed shutter at (u, z), a hand's width behind the wall's face.
Radiance pane(const WallRay& ray, const Window& w, double u, double z, double footprint) {
    const int64_t axis = std::llround(w.u / bay);
    const double fate = cell_noise(axis, w.floor, ray.salt + 7);
    const double sky = 0.75 * sky_share(z, ray.opposite);
    if (fate < 0.16) {  // shutters closed
        const double slat = line_cover(to_nearest(z, 0.09), 0.03, footprint);
        const double gap = line_cover(u - w.u, 0.04, footprint);
        return scaled(lit({0.10, 0.12, 0.10}, sky, 1.0), (1 - 0.5 * slat) * (1 - 0.8 * gap));
    }
    const double bars = std::max({line_cover(u - w.u, 0.09, footprint),
                                  line_cover(to_nearest(z - w.bottom, 0.74), 0.05, footprint),
                                  line_cover(std::abs(u - w.u) - w.half, 0.14, footprint)});
    const double cosine = std::abs(ray.direction.y);
    const double fresnel = 0.08 + 0.92 * std::pow(1 - cosine, 5);
    const double tilt = 0.85 + 0.3 * cell_noise(axis * 2 + (u > w.u), w.floor, ray.salt + 8);
    Radiance glass = scaled(ray.mirrored, fresnel * tilt);
    const double curtain = fate > 0.6 ? ramp(0.25, 0.75, std::abs(u - w.u) / w.half) : 0;
    glass.base += glm::dvec3(0.022, 0.020, 0.018) + curtain * glm::dvec3(0.10, 0.095, 0.085);
    return mix(glass, lit(oak * 1.8, sky, 1.0), bars);
}

// Stone frames, sills and gables around a window. `relief` is what to multiply the light by.
bool window_trim(const Window& w, double u, double z, bool round_gable, double& relief) {
    const double side = std::abs(u - w.u);
    const double out = w.half + 0.30;
    if (z > w.bottom - 0.30 && z < w.bottom && side < out + 0.15) {  // sill, and its shadow's lip
        relief = std::lerp(0.75, 1.35, ramp(w.bottom - 0.22, w.bottom - 0.08, z));
        return true;
    }
    if (side < out && z >= w.bottom && z < w.top + 0.30) {
        relief = 1.0 + 0.12 * ramp(out - 0.07, out - 0.02, side);
        return true;
    }
    const double base = w.top + 0.30;
    if (side < out + 0.2 && z >= base && z < base + 0.22) {
        relief = std::lerp(0.6, 1.3, ramp(base, base + 0.14, z));
        return true;
    }
    if (w.floor != 1 || z < base + 0.22 || side > out + 0.2) return false;
    const double span = out + 0.2, height = 0.85;
    const double edge = round_gable
                            ? height * std::sqrt(std::max(0.0, 1 - side * side / span / span))
                            : height * (1 - side / span);
    const double rise = z - base - 0.22;
    if (rise > edge) return false;
    relief = edge - rise < 0.17 ? 1.3 : 0.78;  // raking cornice, tympanum
    return true;
}

// String courses and the main cornice: 0 where there is none at this height.
double cornice(double u, double z, double footprint) {
    const auto course = [&](double bottom, double top) {
        if (z < bottom || z > top) return 0.0;
        return std::lerp(0.55, 1.35, ramp(bottom, top, z));
    };
    double relief = course(storey - 0.35, storey);
    if (relief == 0) relief = course(second_floor - 0.3, second_floor);
    if (relief == 0) relief = course(7.45, 7.6);
    if (relief == 0) relief = course(18.7, 18.95);
    if (relief == 0 && z > 18.95) {  // dentils under the eaves
        const double teeth = std::abs(to_nearest(u, 0.6)) < 0.17 ? 1.0 : 0.35;
        const double seen = std::lerp(teeth, 0.62, std::min(1.0, footprint / 0.5));
        relief = z < 19.5 ? seen : 0.8;
    }
    return relief;
}

Radiance upper_wall(const WallRay& ray, const glm::dvec3& hit, double footprint) {
    const double u = hit.x, z = hit.z;
    const double sky = sky_share(z, ray.opposite);
    const double corner = corner_shade(ray.half_extent - std::abs(u), 1.6);
    if (const double relief = cornice(u, z, footprint); relief > 0)
        return lit(stained(limestone, u, z, ray.salt), sky, relief * corner);
    Window w{};
    double beside_window = 1;
    if (find_window(u, z, ray.half_extent, w)) {
        const bool inside = std::abs(u - w.u) < w.half && z > w.bottom && z < w.top;
        if (inside) {
            const double recess = 0.3;
            const double t = (recess - ray.origin.y) / ray.direction.y;
            const glm::dvec3 deep = ray.origin + t * ray.direction;
            if (deep.z > w.top) return lit(limestone, 0.3 * sky, 0.75);
            if (deep.z < w.bottom) return lit(limestone, 1.4 * sky, 1.0);
            if (std::abs(deep.x - w.u) > w.half) return lit(limestone, 0.7 * sky, 0.9);
            const double lintel = 1 - 0.5 * ramp(w.top - 0.35, w.top, deep.z);
            return scaled(pane(ray, w, deep.x, deep.z, footprint), lintel);
        }
        double relief = 1;
        const bool round_gable = std::llround(w.u / bay) % 2 != 0;
        if (window_trim(w, u, z, round_gable, relief))
            return lit(stained(grey_stone * 1.35, u, z, ray.salt), sky, relief * corner);
        const double below = w.bottom - 0.30 - z;
        if (below > 0 && std::abs(u - w.u) < w.half + 0.45)
            beside_window = 1 - 0.30 * std::exp(-below / 0.25);
    }
    // Quoins at the corners.
    const double from_corner = ray.half_extent - std::abs(u);
    const double reach = static_cast<int64_t>(std::floor(z / 0.62)) % 2 == 0 ? 0.95 : 0.65;
    const glm::dvec3 skin = from_corner < reach ? limestone : plaster;
    return lit(stained(skin, u, z, ray.salt), sky, corner * cornice_shadow(z) * beside_window);
}

// Beyond the arch of the end wall: haze over a low bank of the river.
Radiance beyond(const glm::dvec3& d) {
    const double rise = d.z / std::hypot(d.x, d.y);
    const double bank = 0.055 + 0.02 * smooth_noise(22 * d.x / d.y, 0.5, 5);
    if (rise > bank) return {glm::dvec3(2.0, 2.15, 2.35) * (1 + 0.8 * rise), 0.0};
    if (rise > 0.004) return {glm::dvec3(0.55, 0.60, 0.66) * (0.8 + 3 * rise), 0.0};
    return {glm::dvec3(0.85, 0.82, 0.78), 0.0};
}

Radiance arch_end(const WallRay& ray, const glm::dvec3& hit, double footprint) {
    constexpr double radius = 3.0, spring = 5.0, thickness = 5.0;
    const auto open = [](double u, double z) {
        if (std::abs(u) < radius) return z < spring || std::hypot(u, z - spring) < radius;
        return std::abs(std::abs(u) - 4.9) < 1.05 && z < 4.6;
    };
    const double u = hit.x, z = hit.z, sky = sky_share(z, ray.opposite);
    const double corner = corner_shade(ray.half_extent - std::abs(u), 1.6);
    if (open(u, z)) {
        const double t = (thickness - ray.origin.y) / ray.direction.y;
        const glm::dvec3 far = ray.origin + t * ray.direction;
        if (far.z <= 0) return lit(paving_stone, 0.10, 0.8);
        if (open(far.x, far.z)) return beyond(ray.direction);
        return lit(limestone, 0.06, 0.75);
    }
    const double ring =
        std::abs(u) < radius + 0.5 ? std::hypot(u, std::max(z - spring, 0.0)) - radius : 9;
    if (ring < 0.5) {
        const double relief = ring > 0.4 ? 1.3 : 1.0;
        return lit(stained(grey_stone * 1.5, u, z, ray.salt), sky, relief * corner);
    }
    if (z > 8.6 && z < 8.9)
        return lit(limestone, sky, std::lerp(0.55, 1.35, ramp(8.6, 8.9, z)) * corner);
    if (z > 8.9) {
        // Only the upper floor has windows: the arch takes the place of the first.
        if (z > second_floor - 0.3) return upper_wall(ray, hit, footprint);
        const bool panel = std::abs(std::abs(to_nearest(u, bay)) - 1.5) < 0.12 || z > 12.2;
        return lit(stained(panel ? limestone : plaster, u, z, ray.salt), sky,
                   corner * cornice_shadow(z));
    }
    if (std::abs(std::abs(u) - 4.9) < 1.35 && z < 4.9) return lit(limestone, sky, 1.1 * corner);
    return lit(stained(plaster, u, z, ray.salt), sky, corner * corner_shade(z, 0.9));
}

Radiance portal_end(const WallRay& ray, const glm::dvec3& hit, double footprint) {
    const double u = hit.x, z = hit.z, sky = sky_share(z, ray.opposite);
    if (z > storey - 0.35) return upper_wall(ray, hit, footprint);
    const double shade =
        corner_shade(ray.half_extent - std::abs(u), 1.6) * corner_shade(z, 0.9) * cornice_shadow(z);
    const double side = std::abs(u);
    if (side < 1.35 && z < 3.9) {  // a closed oak gate
        const double leaf = line_cover(side, 0.05, footprint);
        const bool panel = std::abs(to_nearest(side - 0.2, 0.55)) < 0.2 &&
                           std::abs(to_nearest(z - 0.1, 0.95)) < 0.36;
        return lit(oak, 0.7 * sky, (panel ? 0.75 : 1.05) * (1 - 0.7 * leaf));
    }
    if (side < 1.85 && z < 4.4) return lit(grey_stone * 1.5, sky, shade * (z > 4.2 ? 1.35 : 1.0));
    // Rusticated courses.
    const double course = std::floor(z / 0.62);
    const double shift = static_cast<int64_t>(course) % 2 == 0 ? 0.0 : 0.65;
    const double joint = std::max(line_cover(to_nearest(z, 0.62), 0.05, footprint),
                                  line_cover(to_nearest(u + shift, 1.3), 0.05, footprint));
    const double block = cell_noise(static_cast<int64_t>(std::floor((u + shift) / 1.3)),
                                    static_cast<int64_t>(course), ray.salt);
    return lit(stained(limestone, u, z, ray.salt) * (0.86 + 0.28 * block), sky,
               shade * (1 - 0.55 * joint));
}

}  // namespace

Radiance wall(const WallRay& ray) {
    const double t = -ray.origin.y / ray.direction.y;
    const glm::dvec3 hit = ray.origin + t * ray.direction;
    const double footprint = t * ray.texel_angle / std::max(std::abs(ray.direction.y), 0.05);
    switch (ray.kind) {
        case WallKind::arch_end:
            return arch_end(ray, hit, footprint);
        case WallKind::portal_end:
            return portal_end(ray, hit, footprint);
        case WallKind::facade:
            break;
    }
    return hit.z < storey - 0.35 ? arcade(ray, hit, footprint) : upper_wall(ray, hit, footprint);
}

}  // namespace drude::courtyard
