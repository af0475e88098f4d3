#include "device/virtual/virtual_bench.h"

#include <cmath>
#include <string>
#include <utility>

#include "base/sha256.h"
#include "device/virtual/virtual_parts.h"
#include "materials/surface.h"

namespace drude {

namespace {

std::string describe(const Material& sample, const VirtualBenchSettings& settings) {
    return "{\"virtual\": {\"material_sha256\": \"" + sha256(format_material(sample)) +
           "\", \"settings\": " + format_virtual_bench_settings(settings) + "}}";
}

}  // namespace

Bench make_virtual_bench(const Material& sample, const VirtualBenchSettings& settings,
                         FaultInjection faults) {
    const auto rig = std::make_shared<VirtualRig>(sample, settings, std::move(faults));
    Bench bench;
    bench.name = "virtual:" + sample.name;
    bench.description = describe(sample, settings);
    bench.is_virtual = true;
    bench.clock = rig->clock();
    bench.spectrometer = make_virtual_spectrometer(rig);
    bench.polariser.rotator = make_virtual_rotator(
        rig, "polariser",
        [](double degrees, OpticalState* state) { state->polariser_deg = degrees; });
    bench.analyser.rotator = make_virtual_rotator(
        rig, "analyser",
        [](double degrees, OpticalState* state) { state->analyser_deg = degrees; });
    bench.retarder.present = true;
    bench.retarder.in_deg = 90;
    bench.retarder.out_deg = 0;
    const double in_deg = bench.retarder.in_deg;
    bench.retarder.rotator =
        make_virtual_rotator(rig, "retarder", [in_deg](double degrees, OpticalState* state) {
            // The plate is wider than the beam.
            state->retarder_in = std::abs(degrees - in_deg) < 5;
        });
    bench.goniometer = make_virtual_goniometer(rig);
    bench.sample = sample.name;
    bench.notes = {{"instrument", "virtual bench (simulated; no hardware was used)"},
                   {"virtual_bench_seed", std::to_string(settings.seed)}};
    if (!sample.substrate.citation.empty()) {
        bench.notes.emplace_back("optical_constants", sample.substrate.citation);
    }
    bench.warnings = range_warnings(sample, settings.first_nm, settings.last_nm);
    return bench;
}

}  // namespace drude
