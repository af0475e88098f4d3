// The default environment: a colonnaded courtyard under an overcast sky, seen from its middle, made
// by the program itself so that nothing has to be downloaded.
//
// Architecture and light are procedural (courtyard_scene.h). The statistics are those published for
// the Uffizi gallery probe (P. Debevec), which the study's original pictures were lit by: a
// solid-angle mean of 0.9 and a highest luminance of 16 times the mean.
#pragma once

#include "image/image.h"

namespace drude {

inline constexpr double courtyard_mean_luminance = 0.9;
inline constexpr double courtyard_max_over_mean = 16.0;

// A lat-long picture, 2*height by height, channels R, G, B in linear Rec.709 radiance, all > 0.
// pbrt's light space, z up: row y is theta = pi (y + 1/2) / height from +z, column x is
// phi = 2 pi (x + 1/2) / width, direction = (sin theta cos phi, sin theta sin phi, cos theta). The
// long axis is x; the end wall with the arch stands towards -x, the middle of the picture.
//
// The solid-angle mean of the luminance is courtyard_mean_luminance and its highest value
// courtyard_max_over_mean times that, at every height. The bits do not depend on `threads` (0: all
// available). Throws Error (user) where height is outside [16, 8192].
Image make_courtyard(int height, int threads = 0);

}  // namespace drude
