// Shapes of which light that they reflect meets nothing again.
#pragma once

#include "scene/scene.h"

namespace drude {

// Whether no path that starts at the camera, or at a surface that depolarises, is reflected twice
// by this shape. `alone`: nothing else in the scene scatters. Says no where it does not know.
bool reflects_once(const Shape& shape, const Camera& camera, bool alone);

}  // namespace drude
