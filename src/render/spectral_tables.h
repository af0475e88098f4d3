// Everything of a scene that depends on wavelength, laid out for packets of N.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/executor.h"
#include "materials/film_table.h"
#include "materials/rough_dielectric.h"
#include "materials/surface.h"
#include "materials/torrance_sparrow.h"
#include "render/surface_model.h"
#include "render/textures.h"
#include "render/wavelengths.h"
#include "scene/plugin_surface.h"
#include "scene/scene.h"

namespace drude {

template <int N>
struct ConductorTables {
    Microfacets<float> microfacets;
    std::optional<Roughness> roughness;  // where microfacets change over the surface
    Masking masking = Masking::smith;
    std::optional<PackedValue<N>> fixed_reflectance;
    PackedSpectrum<N> n, k;
    FilmTable films;      // empty: bare metal
    std::string warning;  // where the table of films is coarse

    // Light comes from a clear medium of index `ambient`.
    ConductorTables(const ConductorMaterial& metal, const SurfaceModel& model, int threads,
                    double ambient = 1)
        : roughness(metal.textured_roughness), masking(metal.surface.masking) {
        const Material& surface = metal.surface;
        microfacets =
            metal.alpha >= 0
                ? Microfacets<float>::from_alpha(model.lobe_width(metal.alpha), surface.masking)
                : Microfacets<float>(surface.lobe, surface.masking, model.lobe_width(surface.beta));
        if (metal.reflectance) {
            fixed_reflectance = SpectrumTextures<N>::pack(*metal.reflectance);
            return;
        }
        const Material seen = seen_from(surface, ambient);
        if (model.keeps_films(seen)) {
            films = FilmTable(seen, N, [&](int count, const std::function<void(int)>& body) {
                parallel_for(static_cast<size_t>(count), threads,
                             [&](size_t i) { body(static_cast<int>(i)); });
            });
            if (films.interpolation_error() > film_table_tolerance) {
                warning = fmt::format(
                    "{}: a clear film resonates more sharply than its table of {} angles shows; "
                    "between them reflectances are wrong by up to {:.2g} (usual: below {:g})",
                    surface.name, films.intervals() + 1, films.interpolation_error(),
                    film_table_tolerance);
            }
            return;
        }
        const DenseIndex index = dense(seen.substrate);
        n = PackedSpectrum<N>(index.n);
        k = PackedSpectrum<N>(index.k);
    }

    // The facet's reflection at cos_theta for the wavelengths of `phase`; not of a fixed
    // reflectance.
    Reflection<Packet<N>> reflection(float cos_theta, int phase) const {
        if (!films.empty()) return films.template at<N>(cos_theta, phase);
        return reflect(ComplexIndex<Packet<N>>{n[phase], k[phase]}, Packet<N>(cos_theta));
    }
};

template <int N>
struct DiffuseTables {
    PackedValue<N> reflectance;
    explicit DiffuseTables(const DiffuseMaterial& m)
        : reflectance(SpectrumTextures<N>::pack(m.reflectance)) {}
};

template <int N>
struct DiffuseTransmissionTables {
    PackedValue<N> reflectance, transmittance;
    explicit DiffuseTransmissionTables(const DiffuseTransmissionMaterial& m)
        : reflectance(SpectrumTextures<N>::pack(m.reflectance)),
          transmittance(SpectrumTextures<N>::pack(m.transmittance)) {}
};

template <int N>
struct DielectricTables {
    PackedSpectrum<N> eta;
    RoughDielectric<float> interface;
    bool is_dispersive;
    DielectricTables(const DielectricMaterial& m, const SurfaceModel& model)
        : eta(m.eta),
          interface(Microfacets<float>::from_alpha(model.lobe_width(m.alpha), Masking::smith)),
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
    CoatTables(const CoatedMaterial& m, const SurfaceModel& model, int threads)
        : eta(static_cast<float>(m.eta[550 - spectrum_first_nm])),
          interface(Microfacets<float>::from_alpha(model.lobe_width(m.alpha), Masking::smith)),
          thickness(static_cast<float>(m.thickness)),
          base(base_tables(m, model, threads)) {}

  private:
    static std::variant<ConductorTables<N>, DiffuseTables<N>> base_tables(const CoatedMaterial& m,
                                                                          const SurfaceModel& model,
                                                                          int threads) {
        if (const auto* metal = std::get_if<ConductorMaterial>(&m.base)) {
            return ConductorTables<N>(*metal, model, threads, m.eta[550 - spectrum_first_nm]);
        }
        return DiffuseTables<N>(std::get<DiffuseMaterial>(m.base));
    }
};

struct MixTables {
    int first, second;
    NumberValue amount;
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
    // All but `observer` must outlive it. `threads` share the work of tabulating films.
    SpectralTables(const Scene& scene, const NumberTextures& numbers, const SurfaceModel& how,
                   int threads, const ColourMatching& observer = cie1931())
        : model(how), textures(scene, numbers) {
        for (const SurfaceMaterial& material : scene.materials) {
            surfaces.push_back(
                std::visit([&](const auto& m) { return tables_of(m, threads); }, material));
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
        x = PackedSpectrum<N>(observer.x);
        y = PackedSpectrum<N>(observer.y);
        z = PackedSpectrum<N>(observer.z);
    }

    // The spectrum of RGB light from an environment's picture: basis times illuminant, summed.
    Packet<N> rgb_light(const glm::vec3& rgb, int phase) const {
        return Packet<N>(rgb.x) * rgb_basis[0][phase] + Packet<N>(rgb.y) * rgb_basis[1][phase] +
               Packet<N>(rgb.z) * rgb_basis[2][phase];
    }

    // What people should know of the tables, each once.
    std::vector<std::string> warnings() const {
        std::vector<std::string> all;
        const auto add = [&](const ConductorTables<N>* metal) {
            if (metal == nullptr || metal->warning.empty()) return;
            if (std::find(all.begin(), all.end(), metal->warning) == all.end()) {
                all.push_back(metal->warning);
            }
        };
        for (const SurfaceTables<N>& surface : surfaces) {
            add(std::get_if<ConductorTables<N>>(&surface));
            if (const auto* coat = std::get_if<CoatTables<N>>(&surface)) {
                add(std::get_if<ConductorTables<N>>(&coat->base));
            }
        }
        return all;
    }

    SurfaceModel model;
    std::vector<SurfaceTables<N>> surfaces;  // by material
    SpectrumTextures<N> textures;
    std::vector<PackedSpectrum<N>> infinite_radiance, distant_irradiance, point_intensity;
    std::vector<PackedSpectrum<N>> area_radiance;
    PackedSpectrum<N> rgb_basis[3];
    PackedSpectrum<N> x, y, z;

  private:
    using Tables = SurfaceTables<N>;
    Tables tables_of(const ConductorMaterial& m, int threads) const {
        return ConductorTables<N>(m, model, threads);
    }
    static Tables tables_of(const DiffuseMaterial& m, int) { return DiffuseTables<N>(m); }
    static Tables tables_of(const DiffuseTransmissionMaterial& m, int) {
        return DiffuseTransmissionTables<N>(m);
    }
    Tables tables_of(const DielectricMaterial& m, int) const {
        return DielectricTables<N>(m, model);
    }
    static Tables tables_of(const ThinDielectricMaterial& m, int) {
        return ThinDielectricTables<N>(m);
    }
    Tables tables_of(const CoatedMaterial& m, int threads) const {
        return CoatTables<N>(m, model, threads);
    }
    static Tables tables_of(const MixMaterial& m, int) {
        return MixTables{m.first, m.second, m.amount};
    }
    static Tables tables_of(const OpticalElementMaterial&, int) { return NoTables{}; }
    static Tables tables_of(const PluginMaterial& m, int) { return PluginTables<N>(m); }
};

}  // namespace drude
