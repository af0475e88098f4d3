// `drude capture` on the virtual USB bench: one short sweep, with faults, and what came of it.
#pragma once

#include <string>
#include <vector>

#include "device/sweep/journal.h"
#include "materials/measurement.h"

namespace drude {

// Three steps of the polariser at one angle: the shortest sweep that there is. Noise is off, so
// that a reading is the same whenever it is taken.
extern const char* const short_recipe;

// Which devices there are.
enum class CaptureBench {
    full,   // USB4000, three Elliptec mounts, two APT arms
    small,  // STS (checksums) and a polariser alone: a sweep of few transfers
    head,   // a USBTMC head that returns Psi and Delta
};

struct CaptureCell {
    std::string faults;  // "stall@12"; separated by spaces; empty: none
    double wait_s = 1;   // for an unplugged instrument
    CaptureBench bench = CaptureBench::full;
};

struct CaptureResult {
    int status = -1, status_of_second = -1;  // of capture, and of capture --resume; -1: not run
    int answers = 0, applied = 0;
    size_t retries = 0;
    std::string error_line;             // of the first run, where it failed
    std::vector<std::string> troubles;  // what the bench saw, or what is wrong with the result
    std::string answer_list;            // of usb-bench --answers
    Measurement measurement;
    Journal journal;
};

// In a folder of its own below `folder`; `build` is where the programs are. With a reference, the
// result is compared with it: raw frames bit for bit, Psi and Delta to 1e-9 degrees. Where a part
// of a frame of light was saturated, rows must be those of the reference without the same readings,
// to 1e-9 degrees, and as near to the sample as the reference's. No dark may be saturated.
CaptureResult run_capture_cell(const std::string& build, const std::string& folder,
                               const CaptureCell& cell, const CaptureResult* reference);

}  // namespace drude
