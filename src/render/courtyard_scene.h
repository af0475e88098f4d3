// What a ray sees in the procedural courtyard (see courtyard.h): analytic planes, cylinders and
// procedural stone, without any state.
//
// Right-handed metres, z up, the paving at z = 0; the long axis is x, the two façades stand at
// y = +-half_width, the end walls at x = +-half_length. Radiance is in units in which the overcast
// zenith is `zenith_radiance`; the caller scales.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace drude::courtyard {

inline constexpr double half_width = 8.0;
inline constexpr double bay = 4.5;                // one arch, one window axis
inline constexpr double half_length = 9.5 * bay;  // an arch, not a column, stands at x = 0
inline constexpr double eaves_height = 20.0;
inline constexpr double eye_height = 1.7;
inline constexpr double zenith_radiance = 6.0;

// Linear in the strength of the sun behind the clouds, so that the strength can be solved for after
// the picture is made: radiance = base + strength * veil * veil_colour().
struct Radiance {
    glm::dvec3 base{0.0};
    double veil = 0;
};

// Linear RGB of luminance 1.
glm::dvec3 veil_colour();

struct Ray {
    glm::dvec3 origin, direction;  // direction of unit length
    double texel_angle = 0;        // radians; joints thinner than what it spans fade to their mean
    int mirrored = 0;              // reflections so far, in window panes and on worn paving

    glm::dvec3 at(double t) const { return origin + t * direction; }
};

// Radiance that arrives at the ray's origin, which lies inside the courtyard.
Radiance trace(const Ray& ray);

// The wall in its own frame: u along it, depth into it (0 on its face), z up. The ray starts in
// front of it (depth < 0) and meets depth = 0 below the eaves. Angles between depth and z are those
// of the courtyard, so that what a pane mirrors can be followed by `trace`.
enum class WallKind { facade, arch_end, portal_end };
struct WallRay {
    WallKind kind = WallKind::facade;
    glm::dvec3 origin, direction;  // (u, depth, z)
    double texel_angle = 0;
    double half_extent = 0;  // |u| of the inner corners
    double opposite = 0;     // distance of the wall across
    Radiance mirrored;       // what a pane would mirror, without its Fresnel factor
    uint64_t salt = 0;       // so that no two walls have the same stains
};
Radiance wall(const WallRay& ray);

}  // namespace drude::courtyard
