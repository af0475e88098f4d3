// The Fresnel methods as they are timed: packets of 8 wavelengths in float, everything inlined.
#include <fmt/format.h>

#include "base/counter_random.h"
#include "bench/charts/experiment.h"
#include "bench/charts/fresnel_chart.h"

namespace drude {

namespace {

constexpr size_t input_count = 4096;
constexpr int repeats = 16;

// Nothing reads it, but compilers cannot know.
volatile float result_that_is_kept = 0;

// f(cosine, phase) returns a packet. The inputs are gone through again and again; what stands in
// memory is taken as changed in between, so that no turn is left out.
template <class F>
double nanoseconds(const FresnelInputs& inputs, const F& f) {
    FresnelPacket total(0.0f);
    const double begun = thread_seconds();
    for (int repeat = 0; repeat < repeats; ++repeat) {
        for (size_t i = 0; i < input_count; ++i) total += f(inputs.cosine[i], inputs.phase[i]);
        asm volatile("" ::: "memory");
    }
    const double seconds = thread_seconds() - begun;
    result_that_is_kept = sum(total);
    return 1e9 * seconds / (repeats * static_cast<double>(input_count));
}

// Both are needed, and neither can be had from the other.
FresnelPacket both(const ReflectancePair<FresnelPacket>& r) {
    return r.Rs + FresnelPacket(0.5f) * r.Rp;
}

template <class Tables>
FresnelMethod reflectance_only(std::string name, std::string setting, Tables tables) {
    FresnelMethod method;
    method.name = std::move(name);
    method.setting = std::move(setting);
    method.bytes = tables.bytes();
    method.reflectance = [tables](float cosine, int phase) {
        return tables.reflectance(cosine, phase);
    };
    method.reflectance_ns = [tables](const FresnelInputs& inputs) {
        return nanoseconds(inputs, [&](float c, int p) { return tables.reflectance(c, p); });
    };
    return method;
}

template <class Tables>
FresnelMethod with_pair(std::string name, std::string setting, Tables tables) {
    FresnelMethod method = reflectance_only(std::move(name), std::move(setting), tables);
    method.pair = [tables](float cosine, int phase) { return tables.pair(cosine, phase); };
    method.pair_ns = [tables](const FresnelInputs& inputs) {
        return nanoseconds(inputs, [&](float c, int p) { return both(tables.pair(c, p)); });
    };
    return method;
}

struct Tabulated {
    FresnelTable<1> mean;
    FresnelTable<2> separate;

    FresnelPacket reflectance(float cosine, int phase) const { return mean.at(cosine, phase)[0]; }
    ReflectancePair<FresnelPacket> pair(float cosine, int phase) const {
        const auto values = separate.at(cosine, phase);
        return {values[0], values[1]};
    }
    size_t bytes() const { return separate.bytes(); }
};

// What the loop and fetching two constants cost alone.
struct Nothing {
    PackedSpectrum<8> n, k;
    FresnelPacket reflectance(float cosine, int phase) const {
        return n[phase] + FresnelPacket(cosine) * k[phase];
    }
    size_t bytes() const { return 0; }
};

}  // namespace

FresnelInputs::FresnelInputs(uint64_t seed) {
    const auto key = std::array<uint32_t, 2>{static_cast<uint32_t>(seed), 0x66726573};
    for (uint32_t i = 0; i < input_count; ++i) {
        const PhiloxBlock bits = philox({i, 0, 0, 0}, key);
        // The angles of the sphere's picture: sin^2 is uniform.
        cosine.push_back(std::sqrt(static_cast<float>(bits[0] >> 8) * 0x1p-24f));
        phase.push_back(FresnelWavelengths::phase(static_cast<float>(bits[1] >> 8) * 0x1p-24f));
    }
}

std::vector<FresnelMethod> fresnel_methods(const DenseIndex& metal) {
    std::vector<FresnelMethod> methods;
    methods.push_back(with_pair("exact", "closed form", ExactFresnel(metal)));
    methods.back().automatic = true;
    methods.push_back(with_pair("large |N| (pbrt-v2)", "closed form", LargeIndexFresnel(metal)));
    methods.push_back(reflectance_only("Schlick", "one F0 a wavelength", SchlickFresnel(metal)));
    methods.push_back(
        reflectance_only("Schlick with Lazanyi's term", "F0 and F(82 deg)", LazanyiFresnel(metal)));
    for (int intervals = 4; intervals <= 1024; intervals *= 4) {
        methods.push_back(with_pair(
            "table over cos", fmt::format("{} intervals", intervals),
            Tabulated{FresnelTable<1>(metal, intervals), FresnelTable<2>(metal, intervals)}));
    }
    return methods;
}

double fresnel_loop_ns(const DenseIndex& metal, const FresnelInputs& inputs) {
    const Nothing nothing{PackedSpectrum<8>(metal.n), PackedSpectrum<8>(metal.k)};
    return reflectance_only("", "", nothing).reflectance_ns(inputs);
}

double full_reflection_ns(const DenseIndex& metal, const FresnelInputs& inputs) {
    const ExactFresnel exact(metal);
    return nanoseconds(inputs, [&](float cosine, int phase) {
        const Reflection<FresnelPacket> r = exact.full(cosine, phase);
        return (r.Rs + FresnelPacket(0.5f) * r.Rp) +
               (FresnelPacket(0.25f) * r.C + FresnelPacket(0.125f) * r.S);
    });
}

}  // namespace drude
