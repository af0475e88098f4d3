// Whether paths look for lights by themselves, or leave finding them to the surfaces' lobes.
#pragma once

#include <string>

#include "render/render.h"
#include "scene/scene.h"

namespace drude {

struct LightChoice {
    // Constant skies are among the lights that are sampled.
    bool constant_skies = false;
    // Anything is: otherwise no ray is spent on it.
    bool any = false;
    std::string reason;
};

// A constant sky is left to the lobes: sampling lights in proportion to what they have above their
// mean (MIS compensation: Karlik et al. 2019, ACM TOG 38(6)) leaves nothing of it, and a lobe finds
// it with the weight of the lobe alone.
LightChoice light_choice(const Scene& scene, const RenderOptions& options);

}  // namespace drude
