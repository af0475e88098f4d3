// The parts of the virtual bench, all on one rig.
#pragma once

#include <functional>
#include <memory>

#include "device/goniometer.h"
#include "device/rotator.h"
#include "device/spectrometer.h"
#include "device/virtual/virtual_rig.h"

namespace drude {

// Free-running; how its exposures are numbered is told at make_virtual_bench().
std::shared_ptr<Spectrometer> make_virtual_spectrometer(std::shared_ptr<VirtualRig> rig);

// What the light is to know of a mount that has arrived at `degrees`, in [0, 360).
using MountMoved = std::function<void(double degrees, OpticalState* state)>;

// A mount with an ELL14's encoder and pace. `part` is its name for faults, with static lifetime.
std::shared_ptr<Rotator> make_virtual_rotator(std::shared_ptr<VirtualRig> rig, const char* part,
                                              MountMoved moved);

std::shared_ptr<Goniometer> make_virtual_goniometer(std::shared_ptr<VirtualRig> rig);

}  // namespace drude
