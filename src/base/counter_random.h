// Random numbers as a pure function of (seed, counter): the same numbers in any order, on any
// number of threads, and with every standard library (the distributions of <random> differ).
//
// The generator is Philox4x32-10 (Salmon, Moraes, Dror, Shaw 2011, "Parallel random numbers: as
// easy as 1, 2, 3", SC11). Normal deviates are by Box and Muller (1958); their last place depends
// on the log, sin and cos of the C library.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace drude {

using PhiloxBlock = std::array<uint32_t, 4>;

inline PhiloxBlock philox(PhiloxBlock counter, std::array<uint32_t, 2> key) {
    for (int round = 0; round < 10; ++round) {
        const uint64_t a = uint64_t{0xD2511F53} * counter[0];
        const uint64_t b = uint64_t{0xCD9E8D57} * counter[2];
        counter = {static_cast<uint32_t>(b >> 32) ^ counter[1] ^ key[0], static_cast<uint32_t>(b),
                   static_cast<uint32_t>(a >> 32) ^ counter[3] ^ key[1], static_cast<uint32_t>(a)};
        key[0] += 0x9E3779B9;
        key[1] += 0xBB67AE85;
    }
    return counter;
}

// Two independent standard normal deviates. `stream` keeps uses with the same seed apart.
inline std::array<double, 2> normal_pair(uint64_t seed, uint64_t index, uint64_t stream = 0) {
    const auto low = [](uint64_t x) { return static_cast<uint32_t>(x); };
    const auto high = [](uint64_t x) { return static_cast<uint32_t>(x >> 32); };
    const PhiloxBlock bits =
        philox({low(index), high(index), low(stream), high(stream)}, {low(seed), high(seed)});
    // 53 bits each: u in (0, 1], so that its logarithm is finite, and v in [0, 1).
    const auto fraction = [](uint32_t a, uint32_t b) { return (uint64_t{a} << 32 | b) >> 11; };
    const double u = static_cast<double>(fraction(bits[0], bits[1]) + 1) * 0x1p-53;
    const double v = static_cast<double>(fraction(bits[2], bits[3])) * 0x1p-53;
    const double radius = std::sqrt(-2 * std::log(u)), angle = 6.28318530717958647692 * v;
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace drude
