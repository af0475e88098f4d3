#include "bench/charts/rgb_metal.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "materials/fresnel.h"

namespace drude {

namespace {

constexpr int band = 100;  // nm a lane

// Piecewise constant over the lanes B, G, R and the dark one.
DenseSpectrum lanes_of(const RGB& rgb, double dark) {
    const double lanes[] = {rgb[2], rgb[1], rgb[0], dark};
    DenseSpectrum spectrum{};
    for (int i = 0; i < spectrum_size; ++i) spectrum[i] = lanes[std::min(i / band, 3)];
    return spectrum;
}

double unpolarised(const Index& index, double cos_theta) {
    return reflect(ComplexIndex<double>{index.n, index.k}, cos_theta).A();
}

// n and k of reflectance `normal` at normal incidence: the k of every n in the range that has one
// (Gulbrandsen 2014, eq. 3 and 4). r in (0, 1), share in [0, 1] of that range.
Index of_normal_reflectance(double normal, double share) {
    const double root = std::sqrt(normal);
    const double low = (1 - root) / (1 + root), high = (1 + root) / (1 - root);
    const double n = low * std::pow(high / low, share);
    const double k2 = (normal * (n + 1) * (n + 1) - (n - 1) * (n - 1)) / (1 - normal);
    return {n, std::sqrt(std::max(0.0, k2))};
}

constexpr int fit_angles = 64;
double fit_cosine(int i) {
    return (i + 0.5) / fit_angles;
}

Index fit(const std::vector<double>& wanted, double normal) {
    constexpr double darkest = 1e-4, brightest = 1 - 1e-4;
    const double held = std::clamp(normal, darkest, brightest);
    const auto misfit = [&](double share) {
        const Index index = of_normal_reflectance(held, share);
        double total = 0;
        for (int i = 0; i < fit_angles; ++i) {
            const double d = unpolarised(index, fit_cosine(i)) - std::clamp(wanted[i], 0.0, 1.0);
            total += d * d;
        }
        return total;
    };
    // A grid, then finer ones around its best: the misfit may have two valleys.
    double best = 0, step = 1.0 / 64;
    double low = 0, high = 1;
    for (int round = 0; round < 5; ++round, step /= 8) {
        for (double share = low; share <= high; share += step) {
            if (misfit(share) < misfit(best)) best = share;
        }
        low = std::max(0.0, best - step);
        high = std::min(1.0, best + step);
    }
    return of_normal_reflectance(held, best);
}

SpectrumValue in_lanes(const SpectrumValue& value) {
    if (value.texture >= 0) throw std::logic_error("rgb_scene: a texture");
    return {lanes_of(colour_in_d65(value.constant), 0), -1};
}

ConductorMaterial in_lanes(ConductorMaterial metal, RgbMetal way) {
    if (!metal.surface.layers.empty()) throw std::logic_error("rgb_scene: a film");
    if (metal.reflectance) {
        metal.reflectance = in_lanes(*metal.reflectance);
        return metal;
    }
    const std::array<Index, 3> index = rgb_constants(dense(metal.surface.substrate), way);
    // The dark lane reflects as R does, so that it never decides how long a path lives.
    const DenseSpectrum n = lanes_of({index[0].n, index[1].n, index[2].n}, index[0].n);
    const DenseSpectrum k = lanes_of({index[0].k, index[1].k, index[2].k}, index[0].k);
    OpticalConstants constants;
    constants.name = metal.surface.substrate.name + " in RGB";
    for (int i = 0; i < spectrum_size; ++i) {
        constants.wavelength_nm.push_back(spectrum_first_nm + i);
        constants.n.push_back(n[i]);
        constants.k.push_back(k[i]);
    }
    metal.surface.substrate = std::move(constants);
    return metal;
}

}  // namespace

std::string_view rgb_metal_name(RgbMetal way) {
    switch (way) {
        case RgbMetal::at_primaries:
            return "RGB, n and k at the primaries";
        case RgbMetal::as_colours:
            return "RGB, n and k as colours";
        case RgbMetal::fitted:
            return "RGB, n and k fitted to the colour";
        case RgbMetal::schlick:
            break;
    }
    return "RGB, Schlick from the colour";
}

RGB colour_in_d65(const DenseSpectrum& spectrum) {
    DenseSpectrum lit = rgb_illuminant({1, 1, 1});
    for (int i = 0; i < spectrum_size; ++i) lit[i] *= spectrum[i];
    return xyz_to_rgb(spectrum_to_xyz(lit));
}

DenseSpectrum reflectance_spectrum(const DenseIndex& metal, double cos_theta) {
    DenseSpectrum spectrum{};
    for (int i = 0; i < spectrum_size; ++i) {
        spectrum[i] = unpolarised({metal.n[i], metal.k[i]}, cos_theta);
    }
    return spectrum;
}

std::array<Index, 3> rgb_constants(const DenseIndex& metal, RgbMetal way) {
    std::array<Index, 3> index;
    if (way == RgbMetal::at_primaries) {
        const double nanometres[] = {611.4, 549.1, 464.2};
        for (size_t c = 0; c < 3; ++c) {
            const double at = nanometres[c] - spectrum_first_nm;
            const int low = static_cast<int>(at);
            const double t = at - low;
            index[c] = {(1 - t) * metal.n[low] + t * metal.n[low + 1],
                        (1 - t) * metal.k[low] + t * metal.k[low + 1]};
        }
        return index;
    }
    if (way == RgbMetal::as_colours) {
        const RGB n = colour_in_d65(metal.n), k = colour_in_d65(metal.k);
        for (size_t c = 0; c < 3; ++c) index[c] = {std::max(1e-3, n[c]), std::max(0.0, k[c])};
        return index;
    }
    if (way != RgbMetal::fitted) throw std::logic_error("rgb_constants: no n and k");
    const RGB normal = colour_in_d65(reflectance_spectrum(metal, 1));
    std::array<std::vector<double>, 3> wanted;
    for (int i = 0; i < fit_angles; ++i) {
        const RGB colour = colour_in_d65(reflectance_spectrum(metal, fit_cosine(i)));
        for (size_t c = 0; c < 3; ++c) wanted[c].push_back(colour[c]);
    }
    for (size_t c = 0; c < 3; ++c) index[c] = fit(wanted[c], normal[c]);
    return index;
}

std::vector<RGB> rgb_reflectances(const DenseIndex& metal, RgbMetal way,
                                  const std::vector<double>& cosines) {
    std::vector<RGB> result(cosines.size());
    if (way == RgbMetal::schlick) {
        const RGB normal = colour_in_d65(reflectance_spectrum(metal, 1));
        for (size_t i = 0; i < cosines.size(); ++i) {
            const double rise = std::pow(1 - cosines[i], 5);
            for (size_t c = 0; c < 3; ++c) {
                const double f0 = std::clamp(normal[c], 0.0, 1.0);
                result[i][c] = f0 + (1 - f0) * rise;
            }
        }
        return result;
    }
    const std::array<Index, 3> index = rgb_constants(metal, way);
    for (size_t i = 0; i < cosines.size(); ++i) {
        for (size_t c = 0; c < 3; ++c) result[i][c] = unpolarised(index[c], cosines[i]);
    }
    return result;
}

Scene rgb_scene(const Scene& scene, RgbMetal way) {
    Scene rgb = scene;
    const auto white = [](const DenseSpectrum& light) {
        const double y = spectrum_to_xyz(light)[1];
        return lanes_of({y, y, y}, 0);
    };
    for (SurfaceMaterial& material : rgb.materials) {
        if (auto* metal = std::get_if<ConductorMaterial>(&material)) {
            *metal = in_lanes(std::move(*metal), way);
        } else if (auto* diffuse = std::get_if<DiffuseMaterial>(&material)) {
            diffuse->reflectance = in_lanes(diffuse->reflectance);
        } else {
            throw std::logic_error("rgb_scene: neither a metal nor diffuse");
        }
    }
    for (InfiniteLight& light : rgb.infinite_lights) {
        if (!light.image.empty()) throw std::logic_error("rgb_scene: a picture of light");
        light.radiance = white(light.radiance);
    }
    for (DistantLight& light : rgb.distant_lights) light.irradiance = white(light.irradiance);
    for (PointLight& light : rgb.point_lights) light.intensity = white(light.intensity);
    for (AreaLight& light : rgb.area_lights) light.radiance = white(light.radiance);
    return rgb;
}

ColourMatching rgb_observer() {
    const auto& matrix = xyz_from_rgb();
    const auto row = [&](size_t i) {
        return lanes_of({matrix[i][0] / band, matrix[i][1] / band, matrix[i][2] / band}, 0);
    };
    return {row(0), row(1), row(2)};
}

}  // namespace drude
