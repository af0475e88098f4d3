#include "render/decisions.h"

#include "render/path_decisions.h"
#include "render/surface_decisions.h"

namespace drude {

std::vector<ModelDecision> decisions(const Scene& scene, const RenderOptions& options) {
    return {transport_decision(scene, options), wavelength_decision(scene, options),
            bounce_decision(scene, options),    sampler_decision(scene, options),
            light_decision(scene, options),     lobe_decision(scene, options),
            table_decision(scene, options),     film_decision(scene, options)};
}

}  // namespace drude
