#include "render/wavelength_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "materials/surface.h"
#include "render/batch_tracer.h"
#include "render/textures.h"

namespace drude {

namespace {

// `drude bench wavelengths`: as long as a colour scatters less than this, more wavelengths gain
// nothing against the noise that paths have anyway.
constexpr double little_noise = 0.1;

constexpr std::array<int, 3> counts = {8, 16, spectral_bins};

struct Colour {
    double noise = 0;
    std::string name;
};

// For each of the counts the colour that it would let scatter most: lights by themselves, and all
// that is constant of surfaces as it looks once all lights fall on it. Pictures are not read; their
// colours are made of the bases of RGB.
class WorstColours {
  public:
    WorstColours(const Scene& scene, FilmUse films)
        : scene_(scene),
          films_(films),
          seen_materials_(scene.materials.size()),
          seen_textures_(scene.spectrum_textures.size()) {
        add_lights();
        for (const Shape& shape : scene.shapes) {
            place_ = &shape.place;
            add_material(shape.material);
        }
    }

    std::array<Colour, counts.size()> worst;

  private:
    template <class Name>
    void add(const DenseSpectrum& spectrum, const Name& name) {
        for (size_t i = 0; i < counts.size(); ++i) {
            const double noise = phase_noise(spectrum, counts[i]);
            if (noise > worst[i].noise) worst[i] = {noise, name()};
        }
    }

    // Radiance, irradiance and intensity do not compare: every light is as bright as the others.
    void add_light(const DenseSpectrum& light) {
        const double luminance = spectrum_to_xyz(light)[1];
        if (!(luminance > 0)) return;
        for (int i = 0; i < spectrum_size; ++i) all_light_[i] += light[i] / luminance;
        add(light, [] { return "a light"; });
    }

    void add_lights() {
        for (const InfiniteLight& light : scene_.infinite_lights) {
            add_light(light.image.empty() ? light.radiance : rgb_illuminant({1, 1, 1}));
        }
        for (const DistantLight& light : scene_.distant_lights) add_light(light.irradiance);
        for (const PointLight& light : scene_.point_lights) add_light(light.intensity);
        for (const AreaLight& light : scene_.area_lights) add_light(light.radiance);
    }

    // A share of the light that falls on the shape at place_.
    void add_share(const DenseSpectrum& share, const std::string& what) {
        DenseSpectrum seen;
        for (int i = 0; i < spectrum_size; ++i) seen[i] = share[i] * all_light_[i];
        add(seen, [&] {
            const std::string where = place_->str();
            return fmt::format("{}{}{} in the scene's light", what, where.empty() ? "" : " at ",
                               where);
        });
    }

    void add_value(const SpectrumValue& value) {
        if (value.texture < 0) {
            add_share(value.constant, "the surface");
        } else if (!seen_textures_[value.texture]) {
            seen_textures_[value.texture] = true;
            const auto parts = texture_parts(scene_.spectrum_textures[value.texture]);
            for (int i = 0; i < parts.count; ++i) add_value(*parts.part[i]);
        }
    }

    void add_metal(const ConductorMaterial& metal, double ambient = 1) {
        if (metal.reflectance) return add_value(*metal.reflectance);
        Material surface = seen_from(metal.surface, ambient);
        if (films_ == FilmUse::leave_out) surface.layers.clear();
        DenseSpectrum reflectance;
        for (int i = 0; i < spectrum_size; ++i) {
            reflectance[i] = reflect(surface, spectrum_first_nm + i, 1.0, 1.0).A();
        }
        add_share(reflectance, surface.name);
    }

    void add_material(int index) {
        if (index < 0 || seen_materials_[index]) return;
        seen_materials_[index] = true;
        const SurfaceMaterial& material = scene_.materials[index];
        if (const auto* metal = std::get_if<ConductorMaterial>(&material)) {
            add_metal(*metal);
        } else if (const auto* diffuse = std::get_if<DiffuseMaterial>(&material)) {
            add_value(diffuse->reflectance);
        } else if (const auto* sheet = std::get_if<DiffuseTransmissionMaterial>(&material)) {
            add_value(sheet->reflectance);
            add_value(sheet->transmittance);
        } else if (const auto* coat = std::get_if<CoatedMaterial>(&material)) {
            if (const auto* base = std::get_if<ConductorMaterial>(&coat->base)) {
                add_metal(*base, coat->eta[550 - spectrum_first_nm]);
            } else {
                add_value(std::get<DiffuseMaterial>(coat->base).reflectance);
            }
        } else if (const auto* mix = std::get_if<MixMaterial>(&material)) {
            add_material(mix->first);
            add_material(mix->second);
        }
    }

    const Scene& scene_;
    const FilmUse films_;
    DenseSpectrum all_light_{};
    std::vector<bool> seen_materials_, seen_textures_;
    const Place* place_ = nullptr;
};

}  // namespace

double phase_noise(const DenseSpectrum& colour, int wavelengths) {
    const int spacing = spectrum_integral_size / wavelengths;
    const ColourMatching& eye = cie1931();
    RGB mean{}, squares{};
    for (int phase = 0; phase < spacing; ++phase) {
        XYZ xyz{};
        for (int i = phase; i < spectrum_integral_size; i += spacing) {
            xyz[0] += spacing * colour[i] * eye.x[i];
            xyz[1] += spacing * colour[i] * eye.y[i];
            xyz[2] += spacing * colour[i] * eye.z[i];
        }
        const RGB rgb = xyz_to_rgb(xyz);
        for (size_t c = 0; c < 3; ++c) {
            mean[c] += rgb[c] / spacing;
            squares[c] += rgb[c] * rgb[c] / spacing;
        }
    }
    double variance = 0, length2 = 0;
    for (size_t c = 0; c < 3; ++c) {
        variance += squares[c] - mean[c] * mean[c];
        length2 += mean[c] * mean[c];
    }
    return length2 > 0 ? std::sqrt(std::max(0.0, variance) / length2) : 0;
}

WavelengthChoice cheapest_exact_wavelengths(const Scene& scene, const RenderOptions& options) {
    if (options.spectral) {
        return {spectral_bins, "spectral layers are wanted, and a path fills every one of them"};
    }
    // The grid's phase is drawn at random for each path, so R, G, B are without bias for any
    // number: what is to be chosen is noise against time.
    const std::array<Colour, counts.size()> worst = WorstColours(scene, options.films).worst;
    size_t chosen = 0;
    while (chosen < worst.size() && worst[chosen].noise > little_noise) ++chosen;
    if (chosen == 0) {
        return {counts[0],
                "R, G, B are without bias for any number, and with eight the phase of a path "
                "hardly changes the colours of lights and surfaces"};
    }
    if (chosen == worst.size()) {
        // More are not always better: their grid may fall in step with the fringes of a film.
        const auto less = [](const Colour& a, const Colour& b) { return a.noise < b.noise; };
        chosen = std::min_element(worst.begin(), worst.end(), less) - worst.begin();
    }
    const size_t named = chosen == 0 ? 0 : chosen - 1;
    return {counts[chosen],
            fmt::format("the colour of {} would scatter by {:.0f} % between paths of {} "
                        "wavelengths{}",
                        worst[named].name, 100 * worst[named].noise, counts[named],
                        chosen == 0 ? ", and more would not help" : "")};
}

}  // namespace drude
