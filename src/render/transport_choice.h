// Which transport a scene needs: the cheapest that is provably exact.
#pragma once

#include <string>
#include <string_view>

#include "render/render.h"
#include "render/throughput.h"
#include "scene/scene.h"

namespace drude {

struct TransportChoice {
    Transport transport = Transport::intensity;
    std::string reason;
};

// For pictures of S0 alone. `scalar` is exact where no path meets two polarising surfaces without
// a perfect depolariser between: at most one reflection, no metal at all, or a single metal that
// is only ever seen from its convex side.
TransportChoice cheapest_exact_transport(const Scene& scene, int max_depth);

// What a render with these options carries: what they ask for, or the cheapest exact one.
TransportChoice transport_choice(const Scene& scene, const RenderOptions& options);

// "scalar", "intensity", "stokes".
std::string_view transport_name(Transport transport);

}  // namespace drude
