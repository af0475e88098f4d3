// What holds of every scene that was read, whatever its text: indices point at something, numbers
// are finite and in the range that the renderer counts on. Aborts where one does not, so that a
// fuzzer reports it.
#pragma once

#include "scene/scene.h"

namespace drude {

void check_scene(const Scene& scene);

}  // namespace drude
