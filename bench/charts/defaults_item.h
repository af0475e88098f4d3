// The item "defaults" of `drude bench`: what is chosen by itself against the richest of everything.
#pragma once

#include "bench/charts/bench_item.h"
#include "render/render.h"

namespace drude {

BenchResult run_defaults(const BenchOptions& options);
// What the models cost beside each other, and beside what --explain says of them.
BenchResult run_decision_costs(const BenchOptions& options);

// The richest model of the same picture: Stokes transport, all wavelengths, every light sampled,
// every ray traced, lobes never mirrors, films always kept. The scene's maxdepth stands.
RenderOptions richest_options();

// A scene of scenes/, small: as compiled into the program, with what it refers to in the folder
// scenes/ of the working directory. Throws Error (user) where that is not there.
Scene small_scene(const std::string& name, int size);

}  // namespace drude
