// How far two colours lie apart to the eye.
#pragma once

#include <array>

#include "materials/spectrum.h"

namespace drude {

struct Lab {
    double L = 0, a = 0, b = 0;
};

// CIELAB (CIE 15:2018, section 8.2.1) of X, Y and Z over those of the white it is seen against;
// below black the straight piece of its curve goes on, so that any finite colour has a Lab.
Lab cielab(const XYZ& over_white);

// Lab of linear sRGB whose white (1, 1, 1) is `white` times as bright, white > 0.
Lab cielab_of_rgb(const RGB& rgb, double white = 1);

// Euclid's distance (Delta E*ab, CIE 1976): 2.3 is just noticeable side by side (M. Mahy, L. Van
// Eycken & A. Oosterlinck, Color Res. Appl. 19, 105, 1994).
double delta_e_1976(const Lab& x, const Lab& y);

// CIEDE2000 with k_L = k_C = k_H = 1 (CIE 142-2001; G. Sharma, W. Wu & E. N. Dalal, Color Res.
// Appl. 30, 21, 2005): about 1 is just noticeable. Symmetric; meant for small differences.
double delta_e_2000(const Lab& x, const Lab& y);

}  // namespace drude
