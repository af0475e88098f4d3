#include "bench/charts/microfacet_timing.h"

#include <cmath>
#include <vector>

#include "base/counter_random.h"
#include "bench/charts/experiment.h"

namespace drude {

namespace {

// Nothing reads it, but compilers cannot know.
volatile float result_that_is_kept = 0;

}  // namespace

double vertex_ns(const Microfacets<float>& microfacets, uint64_t seed) {
    constexpr uint32_t count = 1024;
    constexpr int repeats = 8;
    std::vector<Vec3<float>> out, in, random;
    const auto key = std::array<uint32_t, 2>{static_cast<uint32_t>(seed), 0x6d696372};
    const auto direction = [](uint32_t a, uint32_t b) {
        const float sin2 = static_cast<float>(a >> 8) * 0x1p-24f;
        const float phi = static_cast<float>(2 * pi) * static_cast<float>(b >> 8) * 0x1p-24f;
        const float sine = std::sqrt(sin2);
        return Vec3<float>(sine * std::cos(phi), sine * std::sin(phi), std::sqrt(1 - sin2));
    };
    for (uint32_t i = 0; i < count; ++i) {
        const PhiloxBlock a = philox({i, 0, 0, 0}, key), b = philox({i, 1, 0, 0}, key);
        out.push_back(direction(a[0], a[1]));
        in.push_back(direction(a[2], a[3]));
        random.emplace_back(static_cast<float>(b[0] >> 8) * 0x1p-24f,
                            static_cast<float>(b[1] >> 8) * 0x1p-24f,
                            static_cast<float>(b[2] >> 8) * 0x1p-24f);
    }
    float total = 0;
    const double begun = thread_seconds();
    for (int repeat = 0; repeat < repeats; ++repeat) {
        for (uint32_t i = 0; i < count; ++i) {
            const auto sample = microfacets.sample(out[i], random[i].x, random[i].y, random[i].z);
            const auto evaluation = microfacets.evaluate(out[i], in[i]);
            total += sample.weight + sample.i.x + evaluation.value + evaluation.pdf;
        }
        asm volatile("" ::: "memory");
    }
    const double seconds = thread_seconds() - begun;
    result_that_is_kept = total;
    return 1e9 * seconds / (static_cast<double>(count) * repeats);
}

}  // namespace drude
