// Putting another environment around a scene than the one its file names.
#pragma once

#include <string>

#include "scene/scene.h"

namespace drude {

// Name of the environment that the program makes itself (courtyard.h).
inline constexpr const char* courtyard_name = "courtyard";

// Replaces the scene's infinite lights by one picture, upright in a z-up light space: the file
// `environment`, or the program's own courtyard. The orientation of the first infinite light is
// kept where there is one. The scene's hash takes the picture in.
// Throws Error (user) where the file cannot be read.
void replace_environment(Scene* scene, const std::string& environment, int threads);

}  // namespace drude
