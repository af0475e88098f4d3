#include "render/diattenuation.h"

#include <algorithm>
#include <cmath>

#include "materials/film_stack.h"

namespace drude {

namespace {

double of_metal(const ConductorMaterial& metal) {
    if (metal.reflectance) return 0;
    const Material& surface = metal.surface;
    double largest = 0;
    for (int nm = spectrum_first_nm; nm <= spectrum_last_nm; nm += 10) {
        const Index base = surface.substrate.at(nm);
        std::vector<ThinFilm<double>> films;
        for (const FilmLayer& layer : surface.layers) {
            const Index index = layer.constants.at(nm);
            films.push_back({{index.n, index.k}, layer.thickness_nm});
        }
        for (int degrees = 1; degrees < 90; ++degrees) {
            const Reflection<double> r = reflect(
                films.data(), static_cast<int>(films.size()), ComplexIndex<double>{base.n, base.k},
                std::cos(degrees * pi / 180), static_cast<double>(nm));
            largest = std::max(largest, std::abs(r.B()) / r.A());
        }
    }
    return largest;
}

double of_material(const Scene& scene, int material) {
    if (material < 0) return 0;
    const SurfaceMaterial& m = scene.materials[material];
    if (const auto* metal = std::get_if<ConductorMaterial>(&m)) return of_metal(*metal);
    if (const auto* mix = std::get_if<MixMaterial>(&m)) {
        return std::max(of_material(scene, mix->first), of_material(scene, mix->second));
    }
    const bool depolarises = std::holds_alternative<DiffuseMaterial>(m) ||
                             std::holds_alternative<DiffuseTransmissionMaterial>(m);
    return depolarises ? 0 : 1;
}

}  // namespace

double largest_diattenuation(const Scene& scene) {
    double largest = 0;
    for (const Shape& shape : scene.shapes) {
        largest = std::max(largest, of_material(scene, shape.material));
    }
    return largest;
}

}  // namespace drude
