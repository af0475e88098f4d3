// The decisions on what a path is: parts of decisions().
#pragma once

#include "base/model_decision.h"
#include "render/render.h"
#include "scene/scene.h"

namespace drude {

ModelDecision transport_decision(const Scene& scene, const RenderOptions& options);
ModelDecision wavelength_decision(const Scene& scene, const RenderOptions& options);
ModelDecision bounce_decision(const Scene& scene, const RenderOptions& options);
ModelDecision sampler_decision(const Scene& scene, const RenderOptions& options);
ModelDecision light_decision(const Scene& scene, const RenderOptions& options);

}  // namespace drude
