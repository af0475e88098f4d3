// Stokes parameters from the motion of the field itself, for tests that check signs.
#pragma once

#include <complex>

#include "materials/mueller.h"

namespace drude {

using Field = std::complex<double>;

// From the real field E(t) = Re(E exp(-i omega t)) over one period, x to the right and y up, seen
// looking towards the source. Its tip sweeps area counter-clockwise at the rate
// (x dy/dt - y dx/dt)/2; S3 counts the opposite turn.
inline Stokes<double> seen(Field x, Field y) {
    constexpr int steps = 64;
    Stokes<double> sum = {{0, 0, 0, 0}};
    for (int i = 0; i < steps; ++i) {
        const Field turn = std::polar(1.0, -2 * pi * i / steps);
        const Field later = turn * Field(0, -1);  // d/d(omega t) of exp(-i omega t)
        const double ex = (x * turn).real(), ey = (y * turn).real();
        const double dx = (x * later).real(), dy = (y * later).real();
        sum[0] += (ex * ex + ey * ey) * 2 / steps;
        sum[1] += (ex * ex - ey * ey) * 2 / steps;
        sum[2] += 4 * ex * ey / steps;
        sum[3] -= (ex * dy - ey * dx) * 2 / steps;
    }
    return sum;
}

}  // namespace drude
