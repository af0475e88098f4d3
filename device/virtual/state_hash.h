// Random numbers of a virtual bench: streams that are functions of what the parts stand at.
#pragma once

#include <cmath>
#include <cstdint>

#include "device/virtual/virtual_optics.h"

namespace drude {

// What a hash is for: no two of them meet in the same random numbers.
enum class Draw : uint64_t {
    polariser_jitter = 1,
    analyser_jitter,
    frame,
    dark_frame,
    mixed_frame
};

// SplitMix64's finaliser (Steele, Lea & Flood 2014): every bit of the result depends on each of x.
inline uint64_t scrambled(uint64_t x) {
    x += 0x9E3779B97F4A7C15;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EB;
    return x ^ (x >> 31);
}

class StateHash {
  public:
    explicit StateHash(Draw draw) : value_(scrambled(static_cast<uint64_t>(draw))) {}
    StateHash& add(uint64_t x) {
        value_ = scrambled(value_ ^ x);
        return *this;
    }
    // In millionths: what a mount reports may come back with another last digit after a round trip.
    StateHash& add(double x) { return add(static_cast<uint64_t>(millionths(x))); }
    StateHash& add_azimuth(double degrees) {
        const long long within = millionths(degrees) % 360000000;
        return add(static_cast<uint64_t>(within < 0 ? within + 360000000 : within));
    }
    StateHash& add_arms(const OpticalState& state) {
        add(uint64_t{state.straight_through});
        return state.straight_through ? *this : add(state.incidence_deg).add(state.offset_deg);
    }
    uint64_t value() const { return value_; }

  private:
    // Off by an eighth, so that no encoder's step of some 1/56 or 1/256 of a millionth ends between
    // two of them.
    static long long millionths(double x) { return std::llround(x * 1e6 + 0.123); }

    uint64_t value_;
};

// In [0, 1).
inline double uniform(uint64_t seed, uint64_t stream, uint64_t index) {
    return static_cast<double>(scrambled(scrambled(scrambled(seed) ^ stream) ^ index) >> 11) *
           0x1p-53;
}

}  // namespace drude
