// What `drude render --dry-run` says of a scene.
#pragma once

#include <string>

#include "scene/scene.h"

namespace drude {

// Lines for people: the picture, the shapes, the materials and lights by kind, textures, the hash.
std::string describe_scene(const Scene& scene);

}  // namespace drude
