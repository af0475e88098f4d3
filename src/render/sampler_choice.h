// In which batches a picture's samples come.
#pragma once

#include <optional>
#include <string>

#include "render/render.h"
#include "scene/scene.h"

namespace drude {

struct SamplerChoice {
    int batch_size = 16;         // a power of two, up to largest_batch of sampler.h
    std::optional<int> samples;  // a pixel, before rounding up to batches; none where time or error
                                 // ends the picture
    std::string reason;
};

// Low-discrepancy points in independent batches: of 16, of fewer for very few samples, so that
// there are two batches to compare, and of more where the sums could not hold as many of 16.
SamplerChoice sampler_choice(const Scene& scene, const RenderOptions& options);

}  // namespace drude
