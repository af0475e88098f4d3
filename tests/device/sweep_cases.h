// Short sweeps on a virtual bench without drift, so that a repeated setting reads the same bits.
#pragma once

#include <memory>
#include <string>

#include "base/error.h"
#include "device/sweep/bench_file.h"
#include "device/sweep/sweep.h"
#include "temporary_folder.h"

namespace drude {

inline VirtualBenchSettings short_bench_settings() {
    VirtualBenchSettings settings;
    settings.pixels = 24;
    settings.electrons_per_count = 2;
    settings.read_noise_counts = 15;
    settings.dark_counts = 1500;
    settings.mount_jitter_deg = 0.05;
    settings.reported_nonlinearity = {};
    return settings;
}

inline Recipe short_recipe() {
    Recipe recipe;
    recipe.angles_deg = {70};
    recipe.steps = 5;
    recipe.cycles = 1;
    recipe.zones_deg = {45};
    recipe.averages = 2;
    recipe.dark_frames = 2;
    recipe.integration_s = 0.04;
    recipe.harmonic_4 = false;
    recipe.drift = false;
    recipe.first_nm = 450;
    recipe.last_nm = 750;
    recipe.step_nm = 100;
    return recipe;
}

// Nobody is asked anything on a bench that moves by itself.
class NoOperator : public Operator {
  public:
    void ask(const std::string& request) override { user_error("asked to {}", request); }
};

inline Bench short_bench(FaultInjection faults = {}) {
    return make_virtual_bench(find_material("Cu-McPeak"), short_bench_settings(),
                              std::move(faults));
}

inline SweepOutcome run_short_sweep(const std::string& journal, bool resume,
                                    FaultInjection faults = {},
                                    const Recipe& recipe = short_recipe(),
                                    std::function<bool()> stop = {}) {
    Bench bench = short_bench(std::move(faults));
    NoOperator nobody;
    SweepOptions options;
    options.journal = journal;
    options.resume = resume;
    options.stop = std::move(stop);
    return run_sweep(bench, recipe, nobody, options);
}

}  // namespace drude
