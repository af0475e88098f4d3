#include "bench/charts/rgb_error_table.h"

#include <fmt/format.h>

#include <cmath>

#include "image/delta_e.h"

namespace drude {

double rgb_colour_error(const DenseIndex& metal, RgbMetal way, const ChartIlluminant& light,
                        int times) {
    constexpr int angles = 32;
    std::vector<double> cosines;
    for (int i = 0; i < angles; ++i) cosines.push_back(std::sqrt((i + 0.5) / angles));
    const std::vector<RGB> channels = rgb_reflectances(metal, way, cosines);
    const RGB colour = xyz_to_rgb(light.white());
    const double luminance = spectrum_to_xyz(light.spectrum)[1];
    const double bright = 1 / rgb_to_xyz({1, 1, 1})[1];
    double total = 0;
    for (int a = 0; a < angles; ++a) {
        DenseSpectrum seen = reflectance_spectrum(metal, cosines[a]);
        for (int i = 0; i < spectrum_size; ++i) {
            seen[i] = std::pow(seen[i], times) * light.spectrum[i] / luminance;
        }
        RGB rgb = colour;
        for (size_t c = 0; c < 3; ++c) rgb[c] *= std::pow(channels[a][c], times);
        total += delta_e_2000(cielab_of_rgb(xyz_to_rgb(spectrum_to_xyz(seen)), bright),
                              cielab_of_rgb(rgb, bright));
    }
    return total / angles;
}

BenchTable rgb_error_table() {
    BenchTable table;
    table.id = "wavelengths-rgb";
    table.caption =
        "Metals in three channels: CIEDE2000 of the light that a mirror sends on after one "
        "reflection / after three at the same angle, mean over the visible half of a sphere; white "
        "is that of sRGB, of the light's luminance.";
    table.columns = {"metal", "light"};
    for (const RgbMetal way : all_rgb_metals) {
        table.columns.emplace_back(rgb_metal_name(way));
    }
    for (const char* name : {"Cu", "Au", "Ag", "Al", "Zn"}) {
        const DenseIndex metal = dense(published_set(name));
        for (const ChartIlluminant& light : chart_illuminants()) {
            std::vector<std::string> row = {name, light.name};
            for (const RgbMetal way : all_rgb_metals) {
                row.push_back(fmt::format("{:.2f} / {:.2f}", rgb_colour_error(metal, way, light, 1),
                                          rgb_colour_error(metal, way, light, 3)));
            }
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

}  // namespace drude
