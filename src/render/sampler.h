// Owen-scrambled Sobol points as a pure function of pixel, batch, sample, dimension and seed.
//
// Samples come in batches of a power of two; within a batch each pair of dimensions is a (0,2)-net,
// shuffled and scrambled by hashes (Burley 2020, JCGT 9(4), "Practical Hash-based Owen
// Scrambling"). Batches are independent, so that the variance between them estimates the error.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

namespace drude {

inline constexpr int largest_batch = 256;

namespace sampler_detail {

// Finaliser of SplitMix64 (Steele, Lea & Flood 2014).
inline uint64_t mix(uint64_t x) {
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9u;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

inline uint32_t reverse_bits(uint32_t x) {
    x = __builtin_bswap32(x);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
    x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
    return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
}

// A permutation in which no bit is changed by a higher one: with its argument bit-reversed, an
// Owen scrambling (Laine & Karras 2011, constants of Burley 2020).
inline uint32_t laine_karras(uint32_t x, uint32_t seed) {
    x += seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return x;
}

// The second Sobol dimension of the first points, bit-reversed: column j of its generator matrix
// is the polynomial (1 + x)^j over GF(2).
constexpr std::array<uint8_t, largest_batch> second_dimension() {
    std::array<uint8_t, largest_batch> table{};
    for (unsigned i = 0; i < largest_batch; ++i) {
        uint32_t direction = 0x80000000u, value = 0;
        for (unsigned bits = i; bits != 0; bits >>= 1, direction ^= direction >> 1) {
            if (bits & 1u) value ^= direction;
        }
        unsigned reversed = 0;
        for (unsigned bit = 0; bit < 8; ++bit) reversed |= ((value >> (31 - bit)) & 1u) << bit;
        table[i] = static_cast<uint8_t>(reversed);
    }
    return table;
}
inline constexpr std::array<uint8_t, largest_batch> second_dimension_table = second_dimension();

inline float to_unit(uint32_t reversed) {
    return static_cast<float>(reverse_bits(reversed) >> 8) * 0x1p-24f;
}

}  // namespace sampler_detail

class Sampler {
  public:
    // Sample `index` < batch_size (a power of two up to largest_batch) of batch `batch`.
    Sampler(uint64_t seed, uint32_t x, uint32_t y, uint32_t batch, uint32_t index,
            uint32_t batch_size)
        : hash_(sampler_detail::mix(
              sampler_detail::mix(seed + 0x9e3779b97f4a7c15u) ^
              sampler_detail::mix((uint64_t{y} << 32 | x) + 0x632be59bd9b4e019u) ^
              sampler_detail::mix(uint64_t{batch} + 0xd1b54a32d192ed03u))),
          index_(index),
          mask_(batch_size - 1) {}

    // Uniform in [0, 1).
    float next_1d() {
        const uint64_t h = next_hash();
        return sampler_detail::to_unit(
            sampler_detail::laine_karras(shuffled(h), static_cast<uint32_t>(h >> 32)));
    }

    glm::vec2 next_2d() {
        const uint64_t h = next_hash();
        const uint32_t i = shuffled(h);
        const uint64_t g = sampler_detail::mix(h);
        return {sampler_detail::to_unit(
                    sampler_detail::laine_karras(i, static_cast<uint32_t>(h >> 32))),
                sampler_detail::to_unit(sampler_detail::laine_karras(
                    sampler_detail::second_dimension_table[i], static_cast<uint32_t>(g)))};
    }

  private:
    uint64_t next_hash() { return sampler_detail::mix(hash_ += 0x9e3779b97f4a7c15u); }
    // Owen's shuffle of the index within its batch.
    uint32_t shuffled(uint64_t h) const {
        return sampler_detail::reverse_bits(sampler_detail::laine_karras(
                   sampler_detail::reverse_bits(index_), static_cast<uint32_t>(h))) &
               mask_;
    }

    uint64_t hash_;
    uint32_t index_, mask_;
};

}  // namespace drude
