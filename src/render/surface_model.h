// How much of a surface is modelled: its films, and lobes too narrow to be seen.
#pragma once

#include <string>

#include "materials/film_effect.h"
#include "materials/microfacet.h"
#include "render/render.h"
#include "scene/scene.h"

namespace drude {

// What of a scene's surfaces a render models.
struct SurfaceModel {
    // Lobes narrower than this (beta, or alpha where a scene gives that) are mirrors; of the others
    // none is drawn narrower than mirror_below_beta, below which a float direction has no facets.
    double mirror_below = mirror_below_beta;
    FilmUse films = FilmUse::automatic;
    // By so much a change of a film's reflectance grows until it is seen: see film_gain().
    double gain_of_films = 1;

    // The beta or alpha to draw a lobe with; 0 for a mirror.
    double lobe_width(double width) const {
        return !(width > 0) || width < mirror_below ? 0 : std::max(width, mirror_below_beta);
    }
    // Whether the films on a metal are worth their table.
    bool keeps_films(const Material& material) const {
        if (material.layers.empty() || films == FilmUse::leave_out) return false;
        return films == FilmUse::keep ||
               gain_of_films * film_effect(material) > negligible_film_effect;
    }
};

// What the options ask for. Otherwise lobes below mirror_below_beta are mirrors, but not under
// lights that have no extent (distant, point, spot): those are seen in lobes only, however narrow.
SurfaceModel surface_model(const Scene& scene, const RenderOptions& options);

// The relative change of the light, over the change of the reflectance R that makes it, at most: in
// closed surroundings that glow and reflect alike light is the sum of R^k over k = 0 ... m
// reflections, and the derivative of its logarithm at most 1 + R + ... + R^(m - 1). That with the
// scene's largest albedo for R and bounce_choice() for m: 1 where light is reflected once.
double film_gain(const Scene& scene);

// Whether lights of the scene have no extent.
bool has_small_lights(const Scene& scene);

// How far the light that a facet of a narrow lobe reflects goes astray along one direction, in
// radians: twice the mean |slope| of its facets. Beckmann: 2 beta/sqrt(pi); Blinn-Phong and
// Gaussian are Beckmann's of beta/sqrt(ln 2) where narrow; Trowbridge-Reitz: 2 c, c pbrt's alpha.
double lobe_blur(Lobe lobe, double beta);

// The angle that a pixel sees at the centre of the picture, in radians, the smaller of its width
// and height; 0 where rays are parallel (orthographic).
double pixel_angle(const Scene& scene);

// The largest change of a pixel, as a share of the contrast of what is reflected, when a lobe of
// this blur on a flat or convex surface becomes a mirror: an edge at the border of the pixel, half
// of whose blur falls into it, blur/(2 pixel angle); 1 at most.
double mirror_error(double blur, double pixel_angle);

}  // namespace drude
