// The colours that FLIP measures in (image/flip.h): as the eye filters them, and as it tells them
// apart.
#pragma once

#include <array>

namespace drude {

using Triple = std::array<double, 3>;

// CIE XYZ (2 degrees) of linear Rec.709, white being (1, 1, 1).
Triple xyz_of(const Triple& rgb);

// The opponent space YCxCz, linear in R, G, B, in which the contrast sensitivity of the eye is
// filtered (X. Zhang & B. A. Wandell, "A Spatial Extension of CIELAB", SID 1996, in the form of
// Andersson et al. 2020), and back.
Triple opponent_of(const Triple& rgb);
Triple rgb_of_opponent(const Triple& opponent);

// CIELAB (D65) of linear Rec.709 with the Hunt effect: chroma fades with lightness.
Triple hunt_lab_of(const Triple& rgb);

// The HyAB distance (S. Abasi, M. A. Tehran, M. D. Fairchild, Color Res. Appl. 45, 2020): city
// blocks between lightness and chroma, which suits large differences.
double hyab(const Triple& a, const Triple& b);

}  // namespace drude
