// Aims a bench's polariser and analyser by its calibration before a sweep, where nothing can be
// corrected after it.
#pragma once

#include "device/bench.h"
#include "device/signal/calibration.h"

namespace drude {

// Moves the zeros of both azimuths by the calibration's offsets, so that an axis that is sent to an
// azimuth stands there, and says so in bench->description, by which a resumed sweep knows its
// bench.
//
// For lobe scans: with the polariser along s or p and nothing turning, an azimuth that is off by e
// (radians) changes the flux by up to 2 e, for s and p the other way round, and with the analyser
// at 45 degrees the straight beam differently than the sample's. Scans of the polariser are
// reduced with the calibration instead: a bench that was corrected must not be reduced with it
// again.
void correct_azimuths(const Calibration& calibration, Bench* bench);

}  // namespace drude
