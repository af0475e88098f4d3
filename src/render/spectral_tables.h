// Everything of a scene that depends on wavelength, laid out for packets of N.
#pragma once

#include <variant>
#include <vector>

#include "materials/rough_dielectric.h"
#include "materials/torrance_sparrow.h"
#include "render/wavelengths.h"
#include "scene/plugin_surface.h"
#include "scene/scene.h"

namespace drude {

template <int N>
struct ConductorTables {
    Microfacets<float> microfacets;
    bool has_fixed_reflectance = false;
    PackedSpectrum<N> fixed_reflectance;
    PackedSpectrum<N> n, k;
    struct FilmTables {
        PackedSpectrum<N> n, k;
        float thickness_nm;
    };
    std::vector<FilmTables> films;  // the first is the outermost

    static constexpr int max_films = 16;

    // Light comes from a clear medium of index `ambient`: everything counts against it, and the
    // wavelength in it is shorter by as much.
    explicit ConductorTables(const ConductorMaterial& metal, double ambient = 1) {
        const Material& surface = metal.surface;
        microfacets = metal.alpha >= 0
                          ? Microfacets<float>::from_alpha(metal.alpha, surface.masking)
                          : Microfacets<float>(surface.lobe, surface.masking, surface.beta);
        if (metal.reflectance) {
            has_fixed_reflectance = true;
            fixed_reflectance = PackedSpectrum<N>(metal.reflectance->constant);
            return;
        }
        const auto pack = [&](DenseSpectrum values) {
            for (double& value : values) value /= ambient;
            return PackedSpectrum<N>(values);
        };
        const DenseIndex index = dense(surface.substrate);
        n = pack(index.n);
        k = pack(index.k);
        if (surface.layers.size() > max_films) {
            user_error("material '{}' has {} films; at most {} are modelled", surface.name,
                       surface.layers.size(), max_films);
        }
        for (const FilmLayer& layer : surface.layers) {
            const DenseIndex film = dense(layer.constants);
            films.push_back(
                {pack(film.n), pack(film.k), static_cast<float>(layer.thickness_nm * ambient)});
        }
    }

    // The facet's reflection at cos_theta for the wavelengths of `phase`.
    Reflection<Packet<N>> reflection(float cos_theta, int phase) const {
        using P = Packet<N>;
        if (has_fixed_reflectance) {
            const P r = fixed_reflectance[phase];
            return {r, r, -r, P(0.0f)};
        }
        const ComplexIndex<P> substrate{n[phase], k[phase]};
        if (films.empty()) return reflect(substrate, P(cos_theta));
        P wavelength;
        for (int lane = 0; lane < N; ++lane) {
            wavelength.set(lane, static_cast<float>(Wavelengths<N>::nanometres(phase, lane)));
        }
        ThinFilm<P> stack[max_films];
        const int count = static_cast<int>(films.size());
        for (int i = 0; i < count; ++i) {
            stack[i] = {{films[i].n[phase], films[i].k[phase]}, P(films[i].thickness_nm)};
        }
        return reflect(stack, count, substrate, P(cos_theta), wavelength);
    }
};

template <int N>
struct DiffuseTables {
    PackedSpectrum<N> reflectance;
    explicit DiffuseTables(const DiffuseMaterial& m) : reflectance(m.reflectance.constant) {}
};

template <int N>
struct DiffuseTransmissionTables {
    PackedSpectrum<N> reflectance, transmittance;
    explicit DiffuseTransmissionTables(const DiffuseTransmissionMaterial& m)
        : reflectance(m.reflectance.constant), transmittance(m.transmittance.constant) {}
};

template <int N>
struct DielectricTables {
    PackedSpectrum<N> eta;
    RoughDielectric<float> interface;
    bool is_dispersive;
    explicit DielectricTables(const DielectricMaterial& m)
        : eta(m.eta),
          interface(Microfacets<float>::from_alpha(m.alpha, Masking::smith)),
          is_dispersive(m.is_dispersive()) {}
};

template <int N>
struct ThinDielectricTables {
    PackedSpectrum<N> eta;
    explicit ThinDielectricTables(const ThinDielectricMaterial& m) : eta(m.eta) {}
};

template <int N>
struct CoatTables {
    float eta;  // at 550 nm, for all wavelengths
    RoughDielectric<float> interface;
    float thickness;
    std::variant<ConductorTables<N>, DiffuseTables<N>> base;
    explicit CoatTables(const CoatedMaterial& m)
        : eta(static_cast<float>(m.eta[550 - spectrum_first_nm])),
          interface(Microfacets<float>::from_alpha(m.alpha, Masking::smith)),
          thickness(static_cast<float>(m.thickness)),
          base(base_tables(m)) {}

  private:
    static std::variant<ConductorTables<N>, DiffuseTables<N>> base_tables(const CoatedMaterial& m) {
        if (const auto* metal = std::get_if<ConductorMaterial>(&m.base)) {
            return ConductorTables<N>(*metal, m.eta[550 - spectrum_first_nm]);
        }
        return DiffuseTables<N>(std::get<DiffuseMaterial>(m.base));
    }
};

struct MixTables {
    int first, second;
    float amount;
};

template <int N>
struct PluginTables {
    std::shared_ptr<const PluginSurface> surface;
    std::vector<float> nanometres;  // of the lanes, phase by phase
    explicit PluginTables(const PluginMaterial& m) : surface(m.surface) {
        for (int phase = 0; phase < Wavelengths<N>::spacing; ++phase) {
            for (int lane = 0; lane < N; ++lane) {
                nanometres.push_back(static_cast<float>(Wavelengths<N>::nanometres(phase, lane)));
            }
        }
    }
};

// Elements are no part of what scatters.
struct NoTables {};

template <int N>
using SurfaceTables =
    std::variant<ConductorTables<N>, DiffuseTables<N>, DiffuseTransmissionTables<N>,
                 DielectricTables<N>, ThinDielectricTables<N>, CoatTables<N>, PluginTables<N>,
                 MixTables, NoTables>;

template <int N>
struct SpectralTables {
    explicit SpectralTables(const Scene& scene) {
        for (const SurfaceMaterial& material : scene.materials) {
            surfaces.push_back(std::visit([](const auto& m) { return tables_of(m); }, material));
        }
        for (const InfiniteLight& light : scene.infinite_lights) {
            infinite_radiance.emplace_back(light.radiance);
        }
        for (const DistantLight& light : scene.distant_lights) {
            distant_irradiance.emplace_back(light.irradiance);
        }
        for (const PointLight& light : scene.point_lights) {
            point_intensity.emplace_back(light.intensity);
        }
        for (const AreaLight& light : scene.area_lights) area_radiance.emplace_back(light.radiance);
        for (int c = 0; c < 3; ++c) {
            RGB primary{0, 0, 0};
            primary[c] = 1;
            rgb_basis[c] = PackedSpectrum<N>(rgb_illuminant(primary));
        }
        x = PackedSpectrum<N>(cie1931().x);
        y = PackedSpectrum<N>(cie1931().y);
        z = PackedSpectrum<N>(cie1931().z);
    }

    // The spectrum of RGB light from an environment's picture: basis times illuminant, summed.
    Packet<N> rgb_light(const glm::vec3& rgb, int phase) const {
        return Packet<N>(rgb.x) * rgb_basis[0][phase] + Packet<N>(rgb.y) * rgb_basis[1][phase] +
               Packet<N>(rgb.z) * rgb_basis[2][phase];
    }

    std::vector<SurfaceTables<N>> surfaces;  // by material
    std::vector<PackedSpectrum<N>> infinite_radiance, distant_irradiance, point_intensity;
    std::vector<PackedSpectrum<N>> area_radiance;
    PackedSpectrum<N> rgb_basis[3];
    PackedSpectrum<N> x, y, z;

  private:
    using Tables = SurfaceTables<N>;
    static Tables tables_of(const ConductorMaterial& m) { return ConductorTables<N>(m); }
    static Tables tables_of(const DiffuseMaterial& m) { return DiffuseTables<N>(m); }
    static Tables tables_of(const DiffuseTransmissionMaterial& m) {
        return DiffuseTransmissionTables<N>(m);
    }
    static Tables tables_of(const DielectricMaterial& m) { return DielectricTables<N>(m); }
    static Tables tables_of(const ThinDielectricMaterial& m) { return ThinDielectricTables<N>(m); }
    static Tables tables_of(const CoatedMaterial& m) { return CoatTables<N>(m); }
    static Tables tables_of(const MixMaterial& m) {
        return MixTables{m.first, m.second, static_cast<float>(m.amount.constant)};
    }
    static Tables tables_of(const OpticalElementMaterial&) { return NoTables{}; }
    static Tables tables_of(const PluginMaterial& m) { return PluginTables<N>(m); }
};

}  // namespace drude
