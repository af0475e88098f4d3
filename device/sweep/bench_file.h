// Which parts make up a bench: format "drude-bench/1" (JSON), and what `--instrument` names.
//
//   {"format": "drude-bench/1", "name": "lab 2",
//    "spectrometer": "ooi:USB4C00001",
//    "polariser": {"rotator": "ell:DK0AELL1/0", "zero_deg": 12.4, "direction": 1},
//    "analyser": {"rotator": "ell:DK0AELL1/1", "zero_deg": 271.9},
//    "retarder": {"rotator": "ell:DK0AELL1/2", "in_deg": 0, "out_deg": 90},
//    "goniometer": {"sample": {"rotator": "apt:55000001", "zero_deg": 0},
//                   "arm": {"rotator": "apt:55000002", "zero_deg": 180, "direction": -1}},
//    "calibration": "lab2-calibration.json"}
//
// An analyser may be {"fixed_deg": 45}; a retarder "manual", or be left out; a goniometer "manual",
// or {"fixed_deg": 70}. Instead of all parts there may be "head": "usbtmc:VID:PID:SERIAL" (with or
// without a goniometer), or "virtual": {"material": "Cu-McPeak", "settings": {...}} with the keys
// of VirtualBenchSettings. File names in it are taken from its own folder. A head, or a
// spectrometer of "usbtmc:", may have "scpi": {...} with the commands that it knows (scpi_file.h).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "device/bench.h"
#include "device/instruments/scpi_commands.h"
#include "device/sweep/operator.h"
#include "device/virtual/virtual_bench.h"

namespace drude {

struct AxisSetting {
    std::string rotator;  // its URI; empty: fixed
    double zero_deg = 0;
    int direction = 1;
    double fixed_deg = 45;
};

struct BenchFile {
    std::string path, name;
    std::string spectrometer, head;
    ScpiCommands scpi;
    std::string scpi_json;  // what the file says of them, canonical; empty: nothing
    AxisSetting polariser, analyser;
    bool has_retarder = false;
    std::string retarder_rotator;  // empty while there is one: by hand
    double retarder_in_deg = 0, retarder_out_deg = 90;
    enum class Arms { none, manual, fixed, motors };
    Arms arms = Arms::none;
    double fixed_incidence_deg = 0;
    AxisSetting sample_stage, detector_arm;
    std::string calibration;  // path, or empty
    std::string virtual_material;
    std::optional<VirtualBenchSettings> virtual_settings;  // the ordinary ones where not given
};

// Throws Error (user) with file:line:column; unknown keys with the nearest one. Opens nothing.
BenchFile parse_bench_file(const std::string& json, const std::string& file);

// `instrument`: "virtual:MATERIAL", a bench file, or the URI of an instrument that returns Psi and
// Delta. Opens every part. `seed` is that of a virtual bench whose settings are not given; `faults`
// is for virtual benches. Errors as of open_spectrometer() and its kin (registry.h), and (user)
// where an instrument alone makes no bench.
Bench open_bench(const std::string& instrument, uint64_t seed, std::shared_ptr<Operator> person,
                 FaultInjection faults = {});

}  // namespace drude
