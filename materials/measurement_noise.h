// Noise on a measured pair of ellipsometric angles.
#pragma once

#include <cmath>

#include "materials/measurement.h"

namespace drude {

// Adds errors in degrees to Psi and Delta and brings the pair back to Psi in [0, 90] and Delta in
// [0, 360). An error that takes Psi below 0 or above 90 is reflected there together with half a
// turn of Delta, which is the same point of the Poincare sphere: tan(-Psi) exp(i Delta) =
// tan(Psi) exp(i (Delta + 180)). Both errors finite.
inline void add_noise(MeasurementRow* row, double psi_error_deg, double delta_error_deg) {
    row->psi_deg += psi_error_deg;
    row->delta_deg += delta_error_deg;
    // Two foldings suffice for errors of 45 degrees; the loop covers the far tail.
    while (row->psi_deg < 0 || row->psi_deg > 90) {
        row->psi_deg = row->psi_deg < 0 ? -row->psi_deg : 180 - row->psi_deg;
        row->delta_deg += 180;
    }
    const double turned = row->delta_deg - 360 * std::floor(row->delta_deg / 360);
    row->delta_deg = turned < 360 ? turned : 0;
}

}  // namespace drude
