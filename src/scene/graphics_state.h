// What AttributeBegin saves and AttributeEnd brings back.
#pragma once

#include <glm/mat4x4.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scene/builders.h"

namespace drude {

// An area light waits for the shapes it is on. Without "power" all of them share one entry.
struct PendingAreaLight {
    AreaLightRecipe recipe;
    int index = -1;
};

struct GraphicsState {
    glm::dmat4 ctm{1};  // the current transformation
    // ActiveTransform EndTime: transformations then are those of the end of a motion.
    bool start_time_active = true;
    bool reverse_orientation = false;
    ColourSpace colour_space = ColourSpace::srgb;
    int material = 0;  // as in Shape; below -1 a name that is resolved at the end
    std::shared_ptr<PendingAreaLight> area_light;
    // Defaults that Attribute gave, by kind ("shape", "light", ...). Never changed in place.
    std::map<std::string, std::shared_ptr<const std::vector<Parameter>>, std::less<>> defaults;
};

}  // namespace drude
