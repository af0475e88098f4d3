// The mean distance of two pictures to the eye.
#pragma once

#include "bench/charts/traced_picture.h"

namespace drude {

// The mean over the pixels of CIEDE2000 (image/delta_e.h) between linear sRGB, white being that of
// sRGB at luminance `white`.
double mean_delta_e(const TracedPicture& picture, const TracedPicture& reference, double white);

// The two halves as one picture.
TracedPicture mean_picture(const ReferencePicture& reference);

// The luminance that 99 % of the pixels stay below: the exposure at which the picture is looked at.
double bright_luminance(const TracedPicture& picture);

}  // namespace drude
