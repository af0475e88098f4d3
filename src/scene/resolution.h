// Another size of the picture than the one the scene asks for.
#pragma once

#include <string>

#include "scene/scene.h"

namespace drude {

// `text` is "WIDTHxHEIGHT", each from 1 to 65536; `what` names it in errors ("--resolution"). The
// screen window follows as pbrt has it, -1 to 1 along the shorter side, unless the scene gave the
// window itself. Of a cropped picture it is the size of the whole. Throws Error (user).
void set_resolution(const std::string& text, const std::string& what, Scene* scene);

}  // namespace drude
