// The reference integrator's random numbers.
#pragma once

#include "base/counter_random.h"

namespace drude {

// Uniform numbers in [0, 1): a stream for each path.
class ReferenceRandom {
  public:
    ReferenceRandom(uint64_t seed, uint64_t pixel, uint64_t sample) : key_(seed) {
        counter_ = {static_cast<uint32_t>(pixel), static_cast<uint32_t>(pixel >> 32),
                    static_cast<uint32_t>(sample), 0};
    }
    double operator()() {
        const PhiloxBlock bits =
            philox(counter_, {static_cast<uint32_t>(key_), static_cast<uint32_t>(key_ >> 32)});
        ++counter_[3];
        return static_cast<double>((uint64_t{bits[0]} << 32 | bits[1]) >> 11) * 0x1p-53;
    }

  private:
    uint64_t key_;
    PhiloxBlock counter_;
};

}  // namespace drude
