// The picture of a polished sphere without noise: what an error of a reflectance does to colours.
//
// An orthographic camera sees a smooth sphere under a sky of constant D65, whose RGB is (1, 1, 1).
// The pixel at the distance r from the middle of a disk of radius R meets the surface at sin(theta)
// = r/R and shows the sky's spectrum times the reflectance there. The disk is `sphere_rings` rings
// of equal area, each at the middle of its sin^2(theta), so that means over rings are means over
// pixels.
#pragma once

#include <functional>
#include <vector>

#include "materials/spectrum.h"

namespace drude {

inline constexpr int sphere_rings = 64;

// cos(theta) of a ring, as a float holds it: what a renderer hands to its Fresnel.
double ring_cosine(int ring);

// Linear sRGB of every ring, from the middle outwards.
using SpherePicture = std::vector<RGB>;

// `reflectance` of the wavelength 380 nm + i and a ring.
SpherePicture sphere_picture(const std::function<double(int i, int ring)>& reflectance);

struct PictureError {
    double mean_delta_e = 0, worst_delta_e = 0;  // CIEDE2000
    double relative_rmse = 0;                    // of R, G, B over the truth's root mean square
    // log10 of the mean absolute difference over R, G, B and rings; -infinity where all are equal.
    double log10_difference = 0;
};

// `white`: the Y that is looked at as white; 1 is the sky itself.
PictureError picture_error(const SpherePicture& picture, const SpherePicture& truth,
                           double white = 1);

// The largest Y, and the mean.
double brightest(const SpherePicture& picture);
double mean_Y(const SpherePicture& picture);

}  // namespace drude
