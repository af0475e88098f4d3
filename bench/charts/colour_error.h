// The mean distance of two pictures to the eye.
#pragma once

#include "bench/charts/traced_picture.h"
#include "materials/spectrum.h"

namespace drude {

// How pictures are looked at: `white` is the XYZ that counts as white, brightness included.
// Pixels are told apart as CIEDE2000 does (image/delta_e.h).
double mean_delta_e(const TracedPicture& picture, const TracedPicture& reference, const XYZ& white);

// The two halves as one picture.
TracedPicture mean_picture(const ReferencePicture& reference);

// `white` scaled to the luminance that 99 % of the pixels stay below: the exposure at which the
// picture is looked at.
XYZ exposed_white(const TracedPicture& picture, const XYZ& white);

}  // namespace drude
