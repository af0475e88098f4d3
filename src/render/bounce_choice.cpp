#include "render/bounce_choice.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "materials/dielectric.h"
#include "materials/film_stack.h"
#include "materials/quadrature.h"
#include "render/convexity.h"
#include "render/optical_elements.h"

namespace drude {

namespace {

constexpr int unknown = std::numeric_limits<int>::max();

bool is_black(const SpectrumValue& value) {
    return value.texture < 0 && std::all_of(value.constant.begin(), value.constant.end(),
                                            [](double v) { return v == 0; });
}

// Light that a material gives back leaves the surface on the side that it came from, and at once.
bool only_reflects(const Scene& scene, int material) {
    if (material < 0) return false;
    const SurfaceMaterial& m = scene.materials[material];
    if (const auto* mix = std::get_if<MixMaterial>(&m)) {
        return only_reflects(scene, mix->first) && only_reflects(scene, mix->second);
    }
    return std::holds_alternative<ConductorMaterial>(m) ||
           std::holds_alternative<DiffuseMaterial>(m) || std::holds_alternative<CoatedMaterial>(m);
}

// Paths end here: a lamp's black body, for one.
bool absorbs_all(const Scene& scene, int material) {
    const auto* diffuse =
        material < 0 ? nullptr : std::get_if<DiffuseMaterial>(&scene.materials[material]);
    return diffuse != nullptr && is_black(diffuse->reflectance);
}

// Mean over the wavelengths by the eye's sensitivity.
template <class Value>
double seen_mean(const Value& value) {
    double sum = 0, weight = 0;
    for (int i = 0; i < spectrum_integral_size; i += 10) {
        sum += cie1931().y[i] * value(i);
        weight += cie1931().y[i];
    }
    return sum / weight;
}

double seen_mean(const SpectrumValue& value) {
    return seen_mean([&](int i) { return value.constant[i]; });
}

// Twice the integral over cosine times reflectance, by Gauss-Legendre with 4 nodes on [0, 1].
template <class Reflectance>
double hemispherical(const Reflectance& reflectance) {
    static const QuadratureRule rule = gauss_legendre(4);
    double sum = 0;
    for (size_t i = 0; i < rule.x.size(); ++i) {
        const double cosine = (1 - rule.x[i]) / 2;
        sum += rule.weight[i] * cosine * reflectance(cosine);
    }
    return sum;
}

double albedo_of(const Scene& scene, int material);

struct AlbedoVisitor {
    const Scene& scene;

    double operator()(const ConductorMaterial& m) const {
        if (m.reflectance) return seen_mean(*m.reflectance);
        const Material& surface = m.surface;
        return seen_mean([&](int i) {
            const double nm = spectrum_first_nm + i;
            const Index base = surface.substrate.at(nm);
            std::vector<ThinFilm<double>> films;
            for (const FilmLayer& layer : surface.layers) {
                const Index index = layer.constants.at(nm);
                films.push_back({{index.n, index.k}, layer.thickness_nm});
            }
            return hemispherical([&](double cosine) {
                return reflect(films.data(), static_cast<int>(films.size()),
                               ComplexIndex<double>{base.n, base.k}, cosine, nm)
                    .A();
            });
        });
    }
    double operator()(const DiffuseMaterial& m) const { return seen_mean(m.reflectance); }
    double operator()(const DiffuseTransmissionMaterial& m) const {
        return seen_mean(m.reflectance) + seen_mean(m.transmittance);
    }
    double operator()(const DielectricMaterial&) const { return 1; }
    double operator()(const ThinDielectricMaterial&) const { return 1; }
    double operator()(const CoatedMaterial& m) const {
        const double base = std::visit([&](const auto& inner) { return (*this)(inner); }, m.base);
        const double eta = m.eta[550 - spectrum_first_nm];
        const double surface = hemispherical(
            [&](double cosine) { return divide_at_interface(eta, cosine).reflected.A(); });
        return surface + (1 - surface) * base;
    }
    double operator()(const MixMaterial& m) const {
        return std::max(albedo_of(scene, m.first), albedo_of(scene, m.second));
    }
    double operator()(const OpticalElementMaterial&) const { return 0; }
    double operator()(const PluginMaterial&) const { return 1; }
};

double albedo_of(const Scene& scene, int material) {
    if (material < 0) return 0;
    return std::clamp(std::visit(AlbedoVisitor{scene}, scene.materials[material]), 0.0, 1.0);
}

// In world space; round shapes under the mean scale of their transform.
double world_area(const Shape& shape) {
    const glm::dmat3 linear(shape.world_from_object);
    const double scale2 = std::pow(std::abs(glm::determinant(linear)), 2.0 / 3);
    if (const auto* s = std::get_if<Sphere>(&shape.geometry)) {
        return scale2 * s->phi_max_deg * degree * s->radius * (s->z_max - s->z_min);
    }
    if (const auto* d = std::get_if<Disk>(&shape.geometry)) {
        const double radii = d->radius * d->radius - d->inner_radius * d->inner_radius;
        return scale2 * d->phi_max_deg * degree * radii / 2;
    }
    if (const auto* c = std::get_if<Cylinder>(&shape.geometry)) {
        return scale2 * c->phi_max_deg * degree * c->radius * (c->z_max - c->z_min);
    }
    const auto& mesh = std::get<TriangleMesh>(shape.geometry);
    double area = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        const auto side = [&](uint32_t to) {
            return linear * (glm::dvec3(mesh.positions[to]) - glm::dvec3(mesh.positions[t.x]));
        };
        area += glm::length(glm::cross(side(t.y), side(t.z))) / 2;
    }
    return area;
}

}  // namespace

BounceChoice bounce_choice(const Scene& scene) {
    const Shape* reflecting = nullptr;
    size_t met = 0, reflect = 0;
    for (const Shape& shape : scene.shapes) {
        if (is_optical_element(scene, shape)) continue;
        ++met;
        if (shape.material < 0 || absorbs_all(scene, shape.material)) continue;
        ++reflect;
        reflecting = &shape;
    }
    if (reflect == 0) {
        return {0, unknown, false, "nothing in the scene reflects light"};
    }
    const bool once = reflect == 1 && only_reflects(scene, reflecting->material) &&
                      reflects_once(*reflecting, scene.camera, true);
    if (once && scene.max_depth >= 1) {
        return {1, met == 1 ? 1 : unknown, false,
                "the only surface that reflects is flat, or convex and seen from outside: light "
                "that it reflected meets it no more"};
    }
    return {scene.max_depth, unknown, true,
            fmt::format("surfaces see each other or themselves: paths end at the scene's maxdepth "
                        "of {}",
                        scene.max_depth)};
}

SceneAlbedo scene_albedo(const Scene& scene) {
    SceneAlbedo result;
    double area = 0;
    std::vector<std::optional<double>> known(scene.materials.size());
    for (const Shape& shape : scene.shapes) {
        if (shape.material < 0 || is_optical_element(scene, shape)) continue;
        if (!known[shape.material]) known[shape.material] = albedo_of(scene, shape.material);
        const double albedo = *known[shape.material];
        const double here = world_area(shape);
        result.largest = std::max(result.largest, albedo);
        result.mean += here * albedo;
        area += here;
    }
    if (area > 0) result.mean /= area;
    return result;
}

double light_beyond(double albedo, int reflections) {
    return std::pow(std::clamp(albedo, 0.0, 1.0), reflections + 1);
}

}  // namespace drude
