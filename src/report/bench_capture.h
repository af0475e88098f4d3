// Captures on the in-process virtual bench, as `drude capture` makes them: sweep, journal,
// reduction.
#pragma once

#include <string>
#include <vector>

#include "device/signal/calibration.h"
#include "device/sweep/recipe.h"
#include "device/virtual/virtual_optics.h"
#include "materials/material.h"
#include "report/study_data.h"

namespace drude {

// Where a study keeps what its captures need, relative to its folder: bench/calibration.json, the
// recipes bench/psi-delta.json, ..., and METAL/bench.json.
struct CaptureSite {
    std::string folder;  // of the study
    std::string within;  // of what is captured: "copper", "bench"
    std::string bench;   // name of the bench: "virtual copper"
    VirtualBenchSettings settings;
    std::vector<std::string>* files = nullptr;  // written, relative to the study's folder
};

struct Captured {
    std::string text;  // of the file that drude capture writes: CSV, or JSON of a calibration
    StudyCapture about;
};

// Runs `recipe` with `sample` on the bench, into the journal within/journal (an older one is
// replaced), and reduces it. Throws as run_sweep() and reduce_journal() do, and Error (outside)
// where a signal stops it.
Captured capture_on_bench(const CaptureSite& site, const Material& sample, const Recipe& recipe,
                          const std::string& journal, const Calibration& calibration);

// A bench file (drude-bench/1) with which `drude capture --instrument` finds the same bench: the
// sample is `material`, its settings and the calibration those of the study.
std::string virtual_bench_file(const CaptureSite& site, const std::string& material,
                               const std::string& calibration);

// Straight through, then with a mirror of gold for the plane of incidence.
struct BenchCalibration {
    Calibration calibration;
    std::vector<std::string> warnings;
};
BenchCalibration calibrate_bench(const CaptureSite& site);

}  // namespace drude
