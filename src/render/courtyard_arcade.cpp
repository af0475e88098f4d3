#include "render/courtyard_wall.h"

namespace drude::courtyard {

namespace {

constexpr double springing = 3.4;  // of the arches, top of the capitals
constexpr double arch_radius = 0.5 * bay - 0.34;
constexpr double arcade_depth = 0.75;  // of the arches
constexpr double gallery_depth = 5.0;  // behind them
constexpr double gallery_height = 5.7;

// A shaft, its base and its capital at u = axis; the nearest hit in front of `t_best`.
bool column(const WallRay& ray, double axis, double& t_best, Radiance& seen) {
    struct Drum {
        double radius, bottom, top;
    };
    static constexpr Drum drums[] = {
        {0.29, 0.34, 3.0}, {0.40, 0.0, 0.34}, {0.40, 3.12, springing}, {0.34, 3.0, 3.12}};
    const double ou = ray.origin.x - axis, ov = ray.origin.y - 0.5 * arcade_depth;
    const double a = ray.direction.x * ray.direction.x + ray.direction.y * ray.direction.y;
    const double b = ou * ray.direction.x + ov * ray.direction.y;
    bool hit = false;
    for (const Drum& drum : drums) {
        const double c = ou * ou + ov * ov - drum.radius * drum.radius;
        const double root = b * b - a * c;
        if (root <= 0) continue;
        const double t = (-b - std::sqrt(root)) / a;
        const double z = ray.origin.z + t * ray.direction.z;
        if (t <= 0 || t >= t_best || z < drum.bottom || z > drum.top) continue;
        t_best = t;
        hit = true;
        const double towards_court = -(ov + t * ray.direction.y) / drum.radius;  // cos of normal
        const double light = 0.5 + 0.5 * towards_court;
        const double along = (ou + t * ray.direction.x) / drum.radius;
        const double ring = drum.radius > 0.3 ? 0.8 + 0.5 * ramp(drum.bottom, drum.top, z) : 1.0;
        seen = lit(stained(grey_stone * 1.5, axis + 3 * along, z, 77), 0.17 * light * light,
                   ring * (0.30 + 0.70 * light) * (1 - 0.25 * ramp(2.4, 3.0, z) * (z < 3.0)));
    }
    return hit;
}

bool in_arch(double u, double z) {
    const double side = std::abs(to_nearest(u, bay));
    if (z < springing) return true;  // open; the columns are solids of their own
    return side < arch_radius && std::hypot(side, z - springing) < arch_radius;
}

// Behind the arches: floor, vaults and the back wall with its doors.
Radiance gallery(const WallRay& ray, double footprint) {
    const glm::dvec3 &o = ray.origin, &d = ray.direction;
    const double back = arcade_depth + gallery_depth;
    double t = (back - o.y) / d.y;
    const double t_floor = d.z < 0 ? -o.z / d.z : 1e30;
    const double t_vault = d.z > 0 ? (gallery_height - o.z) / d.z : 1e30;
    const double t_end = d.x != 0 ? (std::copysign(ray.half_extent, d.x) - o.x) / d.x : 1e30;
    enum { wall_face, floor_face, vault_face, end_face } face = wall_face;
    if (t_floor < t) t = t_floor, face = floor_face;
    if (t_vault < t) t = t_vault, face = vault_face;
    if (t_end < t) t = t_end, face = end_face;
    const glm::dvec3 p = o + t * d;
    const double depth = std::clamp(p.y / back, 0.0, 1.0);
    const double rib = 1 - 0.35 * line_cover(to_nearest(p.x - 0.5 * bay, bay), 0.5, footprint);
    switch (face) {
        case floor_face: {
            const double joint = std::max(line_cover(to_nearest(p.x, 0.75), 0.02, footprint),
                                          line_cover(to_nearest(p.y, 0.75), 0.02, footprint));
            const double sky = 0.20 * (1 - depth) * (1 - depth);
            return lit(paving_stone, sky, (1 - 0.6 * depth) * (1 - 0.4 * joint));
        }
        case vault_face:
            return lit(plaster, 0.0, (0.50 - 0.36 * depth) * rib);
        case end_face:
            return lit(plaster, 0.02, 0.5 - 0.3 * depth);
        case wall_face:
            break;
    }
    // Blind arches answer the columns; a dark oak door or a niche stands in each.
    const double u = to_nearest(p.x, bay), z = p.z;
    const double light = (0.42 - 0.20 * ramp(2.0, gallery_height, z)) * corner_shade(z, 0.8);
    const double lunette = std::hypot(u, std::max(z - 3.3, 0.0));
    if (std::abs(std::abs(u) - 0.5 * bay) < 0.2) return lit(grey_stone, 0.02, light * 1.1);
    if (std::abs(lunette - 1.75) < 0.09 && z > 3.3) return lit(grey_stone, 0.02, light);
    if (std::llround(p.x / bay) % 2 != 0) {
        if (std::abs(u) < 0.75 && z < 2.7) {
            const bool panel = std::abs(std::abs(u) - 0.38) < 0.25 && to_nearest(z, 0.9) > -0.3;
            return lit(oak, 0.03, light * (panel ? 0.8 : 1.1));
        }
        if (std::abs(u) < 0.98 && z < 2.95) return lit(limestone, 0.02, light);
    }
    return lit(stained(plaster, p.x, z, ray.salt + 5), 0.035, light);
}

}  // namespace

Radiance arcade(const WallRay& ray, const glm::dvec3& hit, double footprint) {
    const glm::dvec3 &o = ray.origin, &d = ray.direction;
    const double sky = sky_share(hit.z, ray.opposite);
    if (!in_arch(hit.x, hit.z)) {
        const double side = std::abs(to_nearest(hit.x, bay));
        const double ring = std::hypot(side, std::max(hit.z - springing, 0.0)) - arch_radius;
        const double corner = corner_shade(ray.half_extent - std::abs(hit.x), 1.6);
        if (ring < 0.34 && side < 0.5 * bay) {  // archivolt
            const double relief = ring < 0.06 ? 0.8 : ring > 0.27 ? 1.3 : 1.0;
            return lit(stained(grey_stone * 1.35, hit.x, hit.z, ray.salt), sky, relief * corner);
        }
        const double from_middle =
            std::hypot(std::abs(to_nearest(hit.x - 0.5 * bay, bay)), hit.z - 5.02);
        if (from_middle < 0.36) {  // roundels between the arches
            const glm::dvec3 glaze = from_middle < 0.27 ? glm::dvec3(0.16, 0.22, 0.34) : limestone;
            return lit(glaze, sky, 1.1);
        }
        return lit(stained(plaster, hit.x, hit.z, ray.salt), sky, corner * cornice_shadow(hit.z));
    }
    const double t_in = -o.y / d.y, t_out = (arcade_depth - o.y) / d.y;
    const double u_in = hit.x, u_out = o.x + t_out * d.x;
    double t_best = 1e30;
    Radiance seen;
    bool on_column = false;
    const double first = std::floor((std::min(u_in, u_out) - 0.6) / bay - 0.5);
    for (int i = 0; i < 3 + static_cast<int>(std::abs(u_out - u_in) / bay); ++i) {
        const double axis = (first + i + 0.5) * bay;
        if (std::abs(axis) > ray.half_extent + 0.1) continue;
        on_column |= column(ray, axis, t_best, seen);
    }
    const glm::dvec3 out = o + t_out * d;
    const bool passes = in_arch(out.x, out.z) && out.z > 0;
    if (on_column && (passes || t_best < t_out)) return seen;
    if (passes || out.z <= 0) return gallery(ray, footprint);
    // The soffit of an arch: darker towards its crown and its depth.
    const double within =
        std::clamp((t_out - t_in) > 0 ? (hit.z - springing) / arch_radius : 0., 0., 1.);
    return lit(limestone, 0.04 * (1 - within), 0.62 - 0.22 * within);
}

}  // namespace drude::courtyard
