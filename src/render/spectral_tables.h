// Everything of a scene that depends on wavelength, laid out for packets of N.
#pragma once

#include <vector>

#include "materials/torrance_sparrow.h"
#include "render/wavelengths.h"
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

    static constexpr int max_films = 16;
};

template <int N>
struct SpectralTables {
    explicit SpectralTables(const Scene& scene) {
        for (const SurfaceMaterial& material : scene.materials) {
            ConductorTables<N> conductor;
            PackedSpectrum<N> diffuse;
            if (const auto* metal = std::get_if<ConductorMaterial>(&material)) {
                conductor = conductor_tables(*metal);
            } else if (const auto* plain = std::get_if<DiffuseMaterial>(&material)) {
                diffuse = PackedSpectrum<N>(plain->reflectance.constant);
            }
            conductors.push_back(std::move(conductor));
            diffuse_reflectance.push_back(std::move(diffuse));
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

    std::vector<ConductorTables<N>> conductors;  // by material; unused entries stay empty
    std::vector<PackedSpectrum<N>> diffuse_reflectance;
    std::vector<PackedSpectrum<N>> infinite_radiance, distant_irradiance, point_intensity;
    std::vector<PackedSpectrum<N>> area_radiance;
    PackedSpectrum<N> rgb_basis[3];
    PackedSpectrum<N> x, y, z;

  private:
    static ConductorTables<N> conductor_tables(const ConductorMaterial& metal) {
        ConductorTables<N> tables;
        const Material& surface = metal.surface;
        tables.microfacets = metal.alpha >= 0
                                 ? Microfacets<float>::from_alpha(metal.alpha, surface.masking)
                                 : Microfacets<float>(surface.lobe, surface.masking, surface.beta);
        if (metal.reflectance) {
            tables.has_fixed_reflectance = true;
            tables.fixed_reflectance = PackedSpectrum<N>(metal.reflectance->constant);
            return tables;
        }
        const DenseIndex index = dense(surface.substrate);
        tables.n = PackedSpectrum<N>(index.n);
        tables.k = PackedSpectrum<N>(index.k);
        if (surface.layers.size() > ConductorTables<N>::max_films) {
            user_error("material '{}' has {} films; at most {} are modelled", surface.name,
                       surface.layers.size(), ConductorTables<N>::max_films);
        }
        for (const FilmLayer& layer : surface.layers) {
            const DenseIndex film = dense(layer.constants);
            tables.films.push_back({PackedSpectrum<N>(film.n), PackedSpectrum<N>(film.k),
                                    static_cast<float>(layer.thickness_nm)});
        }
        return tables;
    }
};

}  // namespace drude
