// What one reflection costs: the closed form, film stacks and lobes, a packet of wavelengths a
// call.
#include <benchmark/benchmark.h>

#include "materials/film_stack.h"
#include "materials/film_table.h"
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
    for ([[maybe_unused]] auto _ : state) {
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
    for ([[maybe_unused]] auto _ : state) {
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
    for ([[maybe_unused]] auto _ : state) {
        const auto r = reflect(&film, 1, substrate, P(0.5f), P(550.0f));
        benchmark::DoNotOptimize(r);
    }
    state.SetItemsProcessed(state.iterations() * 8);
}
BENCHMARK(one_film);

// Films of an anodised aluminium, in nanometres, at angles and wavelengths in no order: the closed
// form and the table that averages over every nanometre.
Material anodised(double thickness_nm) {
    Material material = material_from_set(published_set("Al-Rakic"));
    material.layers = {{published_set("Al2O3-Malitson-o"), thickness_nm}};
    return material;
}

struct Angles {
    uint32_t state = 1;
    uint32_t next() { return state = state * 1664525u + 1013904223u; }
    float cosine() { return static_cast<float>(next() >> 8) * 0x1p-24f + 1e-6f; }
    int phase() { return static_cast<int>((next() >> 16) % 50); }
};

void film_formula(benchmark::State& state) {
    using P = Packet<8>;
    const Material material = anodised(static_cast<double>(state.range(0)));
    const DenseIndex oxide = dense(material.layers[0].constants);
    const DenseIndex metal = dense(material.substrate);
    struct Row {
        P n, k, film_n, wavelength;
    };
    std::vector<Row> rows(50);
    for (int phase = 0; phase < 50; ++phase) {
        for (int lane = 0; lane < 8; ++lane) {
            const int i = phase + 50 * lane;
            rows[phase].n.set(lane, static_cast<float>(metal.n[i]));
            rows[phase].k.set(lane, static_cast<float>(metal.k[i]));
            rows[phase].film_n.set(lane, static_cast<float>(oxide.n[i]));
            rows[phase].wavelength.set(lane, static_cast<float>(spectrum_first_nm + i));
        }
    }
    Angles angles;
    for ([[maybe_unused]] auto _ : state) {
        const Row& row = rows[angles.phase()];
        const ThinFilm<P> film{{row.film_n, P(0.0f)}, P(static_cast<float>(state.range(0)))};
        const auto r =
            reflect(&film, 1, ComplexIndex<P>{row.n, row.k}, P(angles.cosine()), row.wavelength);
        benchmark::DoNotOptimize(r);
    }
    state.SetItemsProcessed(state.iterations() * 8);
}
BENCHMARK(film_formula)->Arg(100)->Arg(3000)->Arg(100000);

void film_table(benchmark::State& state) {
    const FilmTable table(anodised(static_cast<double>(state.range(0))), 8);
    Angles angles;
    for ([[maybe_unused]] auto _ : state) {
        const int phase = angles.phase();
        const auto r = table.at<8>(angles.cosine(), phase);
        benchmark::DoNotOptimize(r);
    }
    state.SetItemsProcessed(state.iterations() * 8);
    state.SetLabel(std::to_string(table.bytes() / 1024) + " kB");
}
BENCHMARK(film_table)->Arg(100)->Arg(3000)->Arg(100000);

void build_film_table(benchmark::State& state) {
    const Material material = anodised(static_cast<double>(state.range(0)));
    for ([[maybe_unused]] auto _ : state) {
        const FilmTable table(material, 8);
        benchmark::DoNotOptimize(table.bytes());
    }
}
BENCHMARK(build_film_table)->Arg(100)->Arg(3000)->Arg(100000)->Unit(benchmark::kMillisecond);

void sample_lobe(benchmark::State& state) {
    const auto lobe = static_cast<Lobe>(state.range(0));
    const auto masking = static_cast<Masking>(state.range(1));
    const Microfacets<float> microfacets(lobe, masking, 0.2);
    const Vec3<float> o = glm::normalize(Vec3<float>(0.5f, 0.2f, 0.7f));
    float u = 0;
    for ([[maybe_unused]] auto _ : state) {
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
