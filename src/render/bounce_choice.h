// How many reflections the paths of a scene can have, and what a limit on them loses.
#pragma once

#include <string>

#include "scene/scene.h"

namespace drude {

struct BounceChoice {
    // No path has more: the scene's limit, or fewer where fewer are all there can be.
    int reflections = 0;
    // From so many reflections on a ray is known to meet nothing any more, and need not be traced;
    // larger than any path where that is not known.
    int clear_after = 0;
    bool limited = false;  // by the scene's maxdepth: paths could be longer
    std::string reason;
};

// A single shape that reflects light and is flat, or convex and seen from outside, reflects it
// once. Otherwise the scene's limit stands.
BounceChoice bounce_choice(const Scene& scene);

// The share of unpolarised light from all sides that the scene's surfaces give back, weighed by the
// eye's sensitivity in light of equal energy; of textures what is typical of them, 1 for what is
// not known (plugins) or loses nothing (glass). In [0, 1]; 0 and 0 without surfaces.
struct SceneAlbedo {
    double mean = 0;  // over the area of the surfaces, spheres taken as round whatever their scale
    double largest = 0;
};
SceneAlbedo scene_albedo(const Scene& scene);

// The share of the light that paths of more than `reflections` bring where all surfaces have the
// albedo and enclose the camera: albedo^(reflections + 1). In an open scene it is less.
double light_beyond(double albedo, int reflections);

}  // namespace drude
