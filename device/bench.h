// A bench: which parts play spectrometer, polariser, analyser, retarder and goniometer.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "device/bench_clock.h"
#include "device/goniometer.h"
#include "device/psi_delta_head.h"
#include "device/rotator.h"
#include "device/spectrometer.h"

namespace drude {

// A rotator with the azimuth that its element has when it reports `zero_deg`: the element's axis
// stands at direction * (reported - zero_deg), from the plane of incidence (p), counter-clockwise
// seen looking towards the source.
struct Azimuth {
    std::shared_ptr<Rotator> rotator;  // none: the element is fixed at fixed_deg
    double zero_deg = 0;
    int direction = 1;  // +1 or -1
    double fixed_deg = 45;
};

// The retarder stands between sample and analyser, its fast axis along p when it is in the beam.
// A mount whose arm swings it in and out, or a person who is asked to.
struct RetarderArm {
    bool present = false;
    std::shared_ptr<Rotator> rotator;  // none while present: by hand
    double in_deg = 0, out_deg = 90;
};

struct Bench {
    std::string name;         // of the bench file, or "virtual:Cu"
    std::string description;  // canonical JSON of what it consists of, serials included
    bool is_virtual = false;
    std::shared_ptr<BenchClock> clock;
    std::shared_ptr<Spectrometer> spectrometer;
    Azimuth polariser, analyser;
    RetarderArm retarder;
    std::shared_ptr<Goniometer> goniometer;
    bool goniometer_by_hand = false;     // somebody is asked to move it
    double fixed_incidence_deg = 0;      // where the arms do not move; 0: they do
    std::shared_ptr<PsiDeltaHead> head;  // instead of everything above
    std::string calibration;             // the file that goes with it; empty: none
    std::string sample;                  // its name, where the bench knows it (virtual ones do)
    std::vector<std::pair<std::string, std::string>> notes;  // for the measurement's header
    std::vector<std::string> warnings;
};

}  // namespace drude
