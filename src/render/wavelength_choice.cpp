#include "render/wavelength_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/batch_tracer.h"

namespace drude {

namespace {

// `drude bench wavelengths`: as long as a light's colour scatters less than this, more wavelengths
// gain nothing against the noise that paths have anyway.
constexpr double little_noise = 0.1;

// Pictures of light and of matter are made of the broad bases of RGB.
double worst_phase_noise(const Scene& scene, int wavelengths) {
    double worst = 0;
    const auto look = [&](const DenseSpectrum& light) {
        worst = std::max(worst, phase_noise(light, wavelengths));
    };
    for (const InfiniteLight& light : scene.infinite_lights) {
        if (light.image.empty()) look(light.radiance);
    }
    for (const DistantLight& light : scene.distant_lights) look(light.irradiance);
    for (const PointLight& light : scene.point_lights) look(light.intensity);
    for (const AreaLight& light : scene.area_lights) look(light.radiance);
    return worst;
}

}  // namespace

double phase_noise(const DenseSpectrum& light, int wavelengths) {
    const int spacing = spectrum_integral_size / wavelengths;
    const ColourMatching& eye = cie1931();
    RGB mean{}, squares{};
    for (int phase = 0; phase < spacing; ++phase) {
        XYZ xyz{};
        for (int i = phase; i < spectrum_integral_size; i += spacing) {
            xyz[0] += spacing * light[i] * eye.x[i];
            xyz[1] += spacing * light[i] * eye.y[i];
            xyz[2] += spacing * light[i] * eye.z[i];
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
    const double with_8 = worst_phase_noise(scene, 8);
    if (with_8 <= little_noise) {
        return {
            8,
            "R, G, B are without bias for any number, and with eight the phase of a path hardly "
            "changes the colour of the lights"};
    }
    const double with_16 = worst_phase_noise(scene, 16);
    const int count = with_16 <= little_noise ? 16 : spectral_bins;
    return {count,
            fmt::format("a light is so narrow in wavelength that its colour would scatter by "
                        "{:.0f} % between paths of 8 wavelengths",
                        100 * with_8)};
}

}  // namespace drude
