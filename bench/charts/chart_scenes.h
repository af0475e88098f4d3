// The scenes that charts are drawn of.
#pragma once

#include <string>

#include "scene/scene.h"

namespace drude {

// One of the scenes that come with the program (scenes/NAME.pbrt), at another size. Where `of` is
// given it stands once in the scene's text, and `instead` takes its place. Geometry is looked for
// in scenes/ of the working folder, beside the program's folder, and where it is installed; Error
// (user) where it is in none of them.
Scene chart_scene(const std::string& name, int width, int height, const std::string& of = "",
                  const std::string& instead = "");

// The gold teapot's floor: of plaster as it comes, or of rough aluminium.
Scene teapot_on_plaster(int width, int height);
Scene teapot_on_metal(int width, int height);

// The half-sphere with another surface ("Material ..." line) under the courtyard, of `height`
// texels, enough for lobes that are not mirrors.
Scene half_sphere_in_courtyard(int width, int height, const std::string& material);

// Four plates of aluminium, from nearly a mirror at the top to rough at the bottom, each tilted so
// that it shows three spherical lamps of radius 0.05, 0.2 and 0.6 and the same power: the scene by
// which Veach & Guibas (1995, SIGGRAPH) showed what multiple importance sampling is for.
Scene plates_under_lamps(int width, int height);

// Spheres of copper, gold and silver and an open copper cup on grey plaster, under a sky and a lamp
// of the same spectrum; the sky's luminance is 1. `light` need not be normalised, but must have
// light that an eye sees.
Scene metals_in_light(int width, int height, const DenseSpectrum& light);

// One sphere of the given material ("Material ..." line) under the courtyard.
Scene sphere_in_courtyard(int width, int height, const std::string& material);

}  // namespace drude
