// What one reflection costs: the closed form, film stacks and lobes, a packet of wavelengths a
// call.
#include <benchmark/benchmark.h>

#include "materials/film_stack.h"
#include "materials/microfacet.h"
#include "materials/packet.h"

namespace drude {
namespace {

template <int N>
ComplexIndex<Packet<N>> indices() {
    Packet<N> n, k;
    for (int lane = 0; lane < N; ++lane) {
        n.set(lane, 0.2f + 0.1f * static_cast<float>(lane % 8));
        k.set(lane, 2.0f + 0.3f * static_cast<float>(lane % 8));
    }
    return {n, k};
}

template <int N>
void bare_surface(benchmark::State& state) {
    const ComplexIndex<Packet<N>> index = indices<N>();
    float cosine = 0.1f;
    for (auto _ : state) {
        const auto r = reflect(index, Packet<N>(cosine));
        benchmark::DoNotOptimize(r);
        cosine = cosine < 0.9f ? cosine + 0.01f : 0.1f;
    }
    state.SetItemsProcessed(state.iterations() * N);
}
BENCHMARK(bare_surface<8>);
BENCHMARK(bare_surface<16>);
BENCHMARK(bare_surface<40>);

void bare_surface_double(benchmark::State& state) {
    double cosine = 0.1;
    for (auto _ : state) {
        const auto r = reflect(ComplexIndex<double>{1.04, 2.59}, cosine);
        benchmark::DoNotOptimize(r);
        cosine = cosine < 0.9 ? cosine + 0.01 : 0.1;
    }
    state.SetItemsProcessed(state.iterations());
}
BENCHMARK(bare_surface_double);

void one_film(benchmark::State& state) {
    using P = Packet<8>;
    const ThinFilm<P> film{{P(1.7f), P(0.0f)}, P(3000.0f)};
    const ComplexIndex<P> substrate = indices<8>();
    for (auto _ : state) {
        const auto r = reflect(&film, 1, substrate, P(0.5f), P(550.0f));
        benchmark::DoNotOptimize(r);
    }
    state.SetItemsProcessed(state.iterations() * 8);
}
BENCHMARK(one_film);

void sample_lobe(benchmark::State& state) {
    const auto lobe = static_cast<Lobe>(state.range(0));
    const auto masking = static_cast<Masking>(state.range(1));
    const Microfacets<float> microfacets(lobe, masking, 0.2);
    const Vec3<float> o = glm::normalize(Vec3<float>(0.5f, 0.2f, 0.7f));
    float u = 0;
    for (auto _ : state) {
        const auto s = microfacets.sample(o, u, 1 - u, 0.5f * u);
        benchmark::DoNotOptimize(s);
        u = u < 0.98f ? u + 0.01f : 0.0f;
    }
    state.SetLabel(std::string(lobe_name(lobe)) + ", " + std::string(masking_name(masking)));
}
BENCHMARK(sample_lobe)
    ->Args({0, 0})
    ->Args({1, 0})
    ->Args({2, 0})
    ->Args({3, 0})
    ->Args({2, 1})
    ->Args({3, 1});

}  // namespace
}  // namespace drude
