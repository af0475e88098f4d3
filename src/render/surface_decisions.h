// The decisions on what surfaces are: parts of decisions().
#pragma once

#include "base/model_decision.h"
#include "render/render.h"
#include "scene/scene.h"

namespace drude {

// Of all lobes of the scene's surfaces together.
ModelDecision lobe_decision(const Scene& scene, const RenderOptions& options);
ModelDecision table_decision(const Scene& scene, const RenderOptions& options);
// Of all metals with films together.
ModelDecision film_decision(const Scene& scene, const RenderOptions& options);

}  // namespace drude
