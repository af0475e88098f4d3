#include "render/light_choice.h"

#include <algorithm>

namespace drude {

LightChoice light_choice(const Scene& scene, const RenderOptions& options) {
    const bool skies = std::any_of(scene.infinite_lights.begin(), scene.infinite_lights.end(),
                                   [](const InfiniteLight& light) { return light.image.empty(); });
    const bool others =
        std::any_of(scene.infinite_lights.begin(), scene.infinite_lights.end(),
                    [](const InfiniteLight& light) { return !light.image.empty(); }) ||
        !scene.distant_lights.empty() || !scene.point_lights.empty() || !scene.area_lights.empty();
    if (options.sample_every_light) return {skies, skies || others, "asked for"};
    if (!others) {
        return {false, false,
                skies ? "all light comes from a constant sky, which lobes find with less noise"
                      : "there is no light"};
    }
    return {false, true,
            skies ? "lamps and pictures stand out from their surroundings; the constant sky is "
                    "left to the lobes"
                  : "lamps and pictures stand out from their surroundings"};
}

}  // namespace drude
