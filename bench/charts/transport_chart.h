// What each transport costs on a scene and how wrong it is: chart 1, and the figures behind it.
#pragma once

#include <cstdint>

#include "bench/charts/traced_picture.h"

namespace drude {

// What `transport` leaves out of S0, from pairs of pictures with the same samples of it and of
// `stokes`: noise that both share does not count.
struct TransportBias {
    double mean = 0, sigma = 0;  // of the picture's mean, relative; its standard error over seeds
    double chance = 3;           // sigmas that chance alone reaches in 0.27 % of cases (Student)
    double rms = 0;              // over the pixels, relative as in relative_product()
    double largest = 0;  // difference of any pixel and colour in a pair, over the picture's mean
    // Nothing but rounding.
    bool is_exact() const { return largest < 1e-4; }
};

// `seeds` at least 2.
TransportBias transport_bias(const TracedScene& scene, Transport transport, int samples, int seeds,
                             uint64_t first_seed, const ReferencePicture& reference);

}  // namespace drude
