// Every automatic decision of a render, with its reason, cost and error.
#pragma once

#include <vector>

#include "base/model_decision.h"
#include "render/render.h"
#include "scene/scene.h"

namespace drude {

// What render_film() does with this scene and these options, decision by decision: transport,
// wavelengths, bounces, sampler, lights, lobes, tables, films. Every rule is the renderer's own
// (transport_choice.h, wavelength_choice.h, bounce_choice.h, sampler_choice.h, light_choice.h,
// surface_model.h). Costs are relative processor times or counts of rays; errors are those of the
// picture without its noise. Each says where its number comes from. Takes milliseconds; up to a
// second where films are 100 micrometres thick.
std::vector<ModelDecision> decisions(const Scene& scene, const RenderOptions& options);

}  // namespace drude
