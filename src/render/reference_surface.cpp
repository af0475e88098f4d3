#include "render/reference_surface.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "materials/optical_elements.h"
#include "materials/surface.h"
#include "render/reference_light.h"
#include "scene/plugin_surface.h"

namespace drude {

namespace {

using Vec = glm::dvec3;
using Matrix = Mueller<double>;

// Axes about a normal; local coordinates have it along z.
struct Axes {
    Vec tangent, bitangent, n;

    explicit Axes(const Vec& normal)
        : tangent(any_perpendicular(normal)), bitangent(glm::cross(normal, tangent)), n(normal) {}
    Vec to_local(const Vec& v) const {
        return {glm::dot(v, tangent), glm::dot(v, bitangent), glm::dot(v, n)};
    }
    Vec to_world(const Vec& v) const {
        return glm::normalize(v.x * tangent + v.y * bitangent + v.z * n);
    }
};

Matrix scaled(Matrix m, double factor) {
    for (auto& row : m.m) {
        for (double& element : row) element *= factor;
    }
    return m;
}

Matrix depolariser(double reflectance) {
    return Matrix::diagonal(reflectance, 0, 0, 0);
}

double clamped(double cosine) {
    return std::min(1.0, cosine);
}

// Local directions and frames, both on the side of the path.
Matrix plugin_matrix(const PluginSurface& surface, double nm, const Vec& in, const Vec& in_frame,
                     const Vec& out, const Vec& out_frame, double handedness) {
    const auto copy = [](const Vec& from, float(&to)[3]) {
        for (int c = 0; c < 3; ++c) to[c] = static_cast<float>(from[c]);
    };
    DrudeDirections directions;
    copy(out, directions.out);
    copy(in, directions.in);
    copy(out_frame, directions.x_out);
    copy(in_frame, directions.x_in);
    directions.handedness = static_cast<float>(handedness);
    const auto wavelength = static_cast<float>(nm);
    float elements[16] = {};
    surface.evaluate(directions, &wavelength, 1, elements);
    Matrix m;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            m.m[row][column] = static_cast<double>(elements[4 * row + column]);
        }
    }
    return m;
}

const DenseSpectrum& diffuse_reflectance(const DiffuseMaterial& diffuse) {
    return diffuse.reflectance.constant;
}

}  // namespace

ReferenceSurfaces::ReferenceSurfaces(const Scene& scene, ReferenceOptions::Directions directions,
                                     double handedness)
    : scene_(scene), directions_(directions), handedness_(handedness) {
    const auto lobe_of = [](const ConductorMaterial& metal) {
        const Material& s = metal.surface;
        return metal.alpha >= 0 ? Microfacets<double>::from_alpha(metal.alpha, s.masking)
                                : Microfacets<double>(s.lobe, s.masking, s.beta);
    };
    const auto interface_of = [](double alpha) {
        return RoughDielectric<double>(Microfacets<double>::from_alpha(alpha, Masking::smith));
    };
    const bool has_small_lights = !scene.distant_lights.empty() || !scene.point_lights.empty();
    for (const SurfaceMaterial& material : scene.materials) {
        Prepared& prepared = prepared_.emplace_back();
        if (const auto* metal = std::get_if<ConductorMaterial>(&material)) {
            prepared.metal = {metal, metal->surface, lobe_of(*metal)};
        } else if (const auto* glass = std::get_if<DielectricMaterial>(&material)) {
            prepared.interface = interface_of(glass->alpha);
            dispersive_ |= glass->is_dispersive();
        } else if (const auto* coated = std::get_if<CoatedMaterial>(&material)) {
            if (has_small_lights) {
                user_error(
                    "the reference integrator finds no distant or point lights from within a "
                    "coat; use area or infinite lights");
            }
            prepared.interface = interface_of(coated->alpha);
            if (const auto* base = std::get_if<ConductorMaterial>(&coated->base)) {
                const double eta = coated->eta[550 - spectrum_first_nm];
                prepared.metal = {base, seen_from(base->surface, eta), lobe_of(*base)};
            }
        }
    }
}

int ReferenceSurfaces::chosen(int material, ReferenceRandom& random) const {
    while (material >= 0) {
        const auto* mix = std::get_if<MixMaterial>(&scene_.materials[material]);
        if (mix == nullptr) break;
        material = random() < mix->amount.constant ? mix->second : mix->first;
    }
    return material;
}

bool ReferenceSurfaces::is_element(int material) const {
    return material >= 0 &&
           std::holds_alternative<OpticalElementMaterial>(scene_.materials[material]);
}

Matrix ReferenceSurfaces::element(int material, const Vec& x_axis, const Vec& normal, const Vec& k,
                                  const Vec& frame) const {
    const auto& e = std::get<OpticalElementMaterial>(scene_.materials[material]);
    const Rotation<double> axis =
        element_axis(k, frame, x_axis, normal, e.axis_deg * degree, handedness_);
    switch (e.kind) {
        case OpticalElementMaterial::Kind::linear_polariser:
            return scaled(linear_polariser(axis), e.transmittance);
        case OpticalElementMaterial::Kind::retarder:
            return scaled(linear_retarder(axis, e.retardance_deg * degree), e.transmittance);
        case OpticalElementMaterial::Kind::circular_polariser:
            break;
    }
    return scaled(circular_polariser<double>(e.right_handed), e.transmittance);
}

// The same for light that a facet reflects and for light that it lets through: the plane of
// incidence holds both rays and the normal.
Matrix ReferenceSurfaces::between(const Reflection<double>& r, const Vec& facet, const Vec& in,
                                  const Vec& in_frame, const Vec& out, const Vec& out_frame) const {
    const Vec s = s_axis(-in, facet);
    const Rotation<double> to_s = rotation_between(-in, in_frame, s, handedness_);
    const Rotation<double> from_s = inverse(rotation_between(out, out_frame, s, handedness_));
    return mueller(from_s) * mueller(r) * mueller(to_s);
}

Reflection<double> ReferenceSurfaces::metal_reflection(const Metal& metal, double nm,
                                                       double cosine) const {
    if (metal.material->reflectance) {
        const double r = spectrum_at(metal.material->reflectance->constant, nm);
        return {r, r, -r, 0};
    }
    // Films are averaged over a nanometre, as everywhere in a render.
    return reflect(metal.seen, nm, cosine, 1.0);
}

double ReferenceSurfaces::eta_at(int material, double nm, bool front) const {
    const auto& glass = std::get<DielectricMaterial>(scene_.materials[material]);
    const double eta = spectrum_at(glass.eta, nm);
    return front ? eta : 1 / eta;
}

Matrix ReferenceSurfaces::scatter(int material, double nm, const ReferenceVertex& v, const Vec& in,
                                  const Vec& in_frame) const {
    const SurfaceMaterial& surface = scene_.materials[material];
    const double cosine = glm::dot(in, v.n);
    if (const auto* diffuse = std::get_if<DiffuseMaterial>(&surface)) {
        if (!(cosine > 0)) return depolariser(0);
        return depolariser(spectrum_at(diffuse_reflectance(*diffuse), nm) * cosine / pi);
    }
    if (const auto* diffuser = std::get_if<DiffuseTransmissionMaterial>(&surface)) {
        const SpectrumValue& share = cosine > 0 ? diffuser->reflectance : diffuser->transmittance;
        return depolariser(spectrum_at(share.constant, nm) * std::abs(cosine) / pi);
    }
    const Axes axes(v.n);
    const Vec o = axes.to_local(v.out), i = axes.to_local(in);
    if (const auto* plugin = std::get_if<PluginMaterial>(&surface)) {
        if (!(i.z > 0)) return depolariser(0);
        return plugin_matrix(*plugin->surface, nm, i, axes.to_local(in_frame), o,
                             axes.to_local(v.frame), handedness_);
    }
    const Prepared& prepared = prepared_[material];
    if (std::holds_alternative<ConductorMaterial>(surface)) {
        const auto e = prepared.metal.lobe.evaluate(o, i);
        if (!(e.value > 0)) return depolariser(0);
        const Reflection<double> r =
            metal_reflection(prepared.metal, nm, clamped(glm::dot(i, e.m)));
        return scaled(between(r, axes.to_world(e.m), in, in_frame, v.out, v.frame), e.value);
    }
    if (std::holds_alternative<DielectricMaterial>(surface)) {
        const double eta = eta_at(material, nm, v.front);
        const auto e = prepared.interface.evaluate(o, i, eta);
        if (!(e.value > 0)) return depolariser(0);
        const DividedLight<double> light = divide_at_interface(eta, clamped(glm::dot(o, e.m)));
        return scaled(between(e.is_transmitted ? light.transmitted : light.reflected,
                              axes.to_world(e.m), in, in_frame, v.out, v.frame),
                      e.value);
    }
    return depolariser(0);
}

bool ReferenceSurfaces::goes_one_way(int material, double eta) const {
    const SurfaceMaterial& surface = scene_.materials[material];
    if (std::holds_alternative<ConductorMaterial>(surface)) {
        return prepared_[material].metal.lobe.is_mirror();
    }
    return std::holds_alternative<DielectricMaterial>(surface) &&
           prepared_[material].interface.is_smooth(eta);
}

std::optional<ReferenceSurfaces::Step> ReferenceSurfaces::choose(int material,
                                                                 const std::vector<double>& nm,
                                                                 const ReferenceVertex& v,
                                                                 ReferenceRandom& random) const {
    const SurfaceMaterial& surface = scene_.materials[material];
    if (std::holds_alternative<CoatedMaterial>(surface)) {
        return walk_in_coat(material, nm, v, random);
    }
    if (std::holds_alternative<ThinDielectricMaterial>(surface)) {
        return choose_plate(material, nm, v, random);
    }
    if (std::holds_alternative<PluginMaterial>(surface) &&
        directions_ == ReferenceOptions::Directions::lobe) {
        return choose_as_plugin(material, nm, v, random);
    }
    const bool is_glass = std::holds_alternative<DielectricMaterial>(surface);
    const bool both_sides =
        is_glass || std::holds_alternative<DiffuseTransmissionMaterial>(surface);
    const bool is_metal = std::holds_alternative<ConductorMaterial>(surface);
    const bool by_lobe = is_glass || is_metal;
    std::vector<double> etas;
    if (is_glass) {
        for (const double at : nm) etas.push_back(eta_at(material, at, v.front));
    }
    if (by_lobe && (directions_ == ReferenceOptions::Directions::lobe ||
                    goes_one_way(material, is_glass ? etas[0] : 1))) {
        return is_metal ? choose_metal(prepared_[material].metal, nm, v, random)
                        : choose_interface(prepared_[material].interface, etas, v, random);
    }
    return choose_evenly(material, nm, v, both_sides, random);
}

// Uniform over the directions, or, for what scatters evenly, in proportion to the cosine.
std::optional<ReferenceSurfaces::Step> ReferenceSurfaces::choose_evenly(
    int material, const std::vector<double>& nm, const ReferenceVertex& v, bool both_sides,
    ReferenceRandom& random) const {
    const bool uniform = directions_ == ReferenceOptions::Directions::hemisphere;
    const double u = random();
    const double z = uniform ? u : std::sqrt(u), r = std::sqrt(1 - z * z), phi = 2 * pi * random();
    const double side = both_sides && random() < 0.5 ? -1 : 1;
    if (!(z > 0)) return {};
    const double density = (uniform ? 1 / (2 * pi) : z / pi) * (both_sides ? 0.5 : 1);
    Step step;
    step.in = Axes(v.n).to_world({r * std::cos(phi), r * std::sin(phi), side * z});
    step.in_frame = any_perpendicular(step.in);
    for (const double at : nm) {
        step.worth.push_back(scaled(scatter(material, at, v, step.in, step.in_frame), 1 / density));
    }
    return step;
}

std::optional<ReferenceSurfaces::Step> ReferenceSurfaces::choose_metal(
    const Metal& metal, const std::vector<double>& nm, const ReferenceVertex& v,
    ReferenceRandom& random) const {
    const Axes axes(v.n);
    const double u1 = random(), u2 = random(), u3 = random();
    const auto s = metal.lobe.sample(axes.to_local(v.out), u1, u2, u3);
    if (!(s.weight > 0)) return {};
    Step step;
    step.in = axes.to_world(s.i);
    step.in_frame = any_perpendicular(step.in);
    const double cosine = clamped(glm::dot(s.i, s.m));
    for (const double at : nm) {
        step.worth.push_back(scaled(between(metal_reflection(metal, at, cosine), axes.to_world(s.m),
                                            step.in, step.in_frame, v.out, v.frame),
                                    s.weight));
    }
    return step;
}

std::optional<ReferenceSurfaces::Step> ReferenceSurfaces::choose_interface(
    const RoughDielectric<double>& interface, const std::vector<double>& etas,
    const ReferenceVertex& v, ReferenceRandom& random) const {
    const Axes axes(v.n);
    const Vec o = axes.to_local(v.out);
    const double u1 = random(), u2 = random(), u3 = random(), u4 = random();
    const auto s = interface.sample(o, etas[0], u1, u2, u3, u4);
    if (!(s.weight > 0)) return {};
    Step step;
    step.in = axes.to_world(s.i);
    step.in_frame = any_perpendicular(step.in);
    const double cosine = clamped(glm::dot(o, s.m));
    for (const double eta : etas) {
        const DividedLight<double> light = divide_at_interface(eta, cosine);
        step.worth.push_back(
            scaled(between(s.is_transmitted ? light.transmitted : light.reflected,
                           axes.to_world(s.m), step.in, step.in_frame, v.out, v.frame),
                   s.weight));
    }
    return step;
}

std::optional<ReferenceSurfaces::Step> ReferenceSurfaces::choose_plate(
    int material, const std::vector<double>& nm, const ReferenceVertex& v,
    ReferenceRandom& random) const {
    const auto& plate = std::get<ThinDielectricMaterial>(scene_.materials[material]);
    const double cosine = clamped(glm::dot(v.out, v.n));
    const bool reflects = random() < 0.5;
    Step step;
    step.in = reflects ? glm::normalize(2 * cosine * v.n - v.out) : -v.out;
    step.in_frame = any_perpendicular(step.in);
    for (const double at : nm) {
        const DividedLight<double> light = divide_at_plate(spectrum_at(plate.eta, at), cosine);
        step.worth.push_back(scaled(between(reflects ? light.reflected : light.transmitted, v.n,
                                            step.in, step.in_frame, v.out, v.frame),
                                    2));
    }
    return step;
}

std::optional<ReferenceSurfaces::Step> ReferenceSurfaces::choose_as_plugin(
    int material, const std::vector<double>& nm, const ReferenceVertex& v,
    ReferenceRandom& random) const {
    const auto& plugin = std::get<PluginMaterial>(scene_.materials[material]);
    const Axes axes(v.n);
    const Vec o = axes.to_local(v.out);
    const float out[3] = {static_cast<float>(o.x), static_cast<float>(o.y),
                          static_cast<float>(o.z)};
    float u[3], in[3] = {0, 0, 0}, pdf = 0;
    // Below 1 in float too.
    for (float& number : u) number = std::min(static_cast<float>(random()), 0x1.fffffep-1f);
    if (!plugin.surface->sample(out, u, in, &pdf) || !(pdf > 0)) return {};
    Step step;
    step.in = axes.to_world({in[0], in[1], in[2]});
    step.in_frame = any_perpendicular(step.in);
    for (const double at : nm) {
        step.worth.push_back(
            scaled(scatter(material, at, v, step.in, step.in_frame), 1 / static_cast<double>(pdf)));
    }
    return step;
}

// Down through the coat's surface, off the base, up to the surface again, until it leaves. Seen
// from below, the surface's normal points down.
std::optional<ReferenceSurfaces::Step> ReferenceSurfaces::walk_in_coat(
    int material, const std::vector<double>& nm, const ReferenceVertex& v,
    ReferenceRandom& random) const {
    const auto& coated = std::get<CoatedMaterial>(scene_.materials[material]);
    const Prepared& prepared = prepared_[material];
    const double eta = coated.eta[550 - spectrum_first_nm];
    const std::vector<double> inwards(nm.size(), eta), outwards(nm.size(), 1 / eta);
    Step walk;
    walk.worth.assign(nm.size(), Matrix::identity());
    ReferenceVertex here = v;
    // Goes on by `next`, which light takes before what was met so far.
    const auto take = [&](const Step& next, double attenuation) {
        for (size_t k = 0; k < nm.size(); ++k) {
            walk.worth[k] = scaled(walk.worth[k] * next.worth[k], attenuation);
        }
        walk.in = next.in;
        walk.in_frame = next.in_frame;
        here.out = -next.in;
        here.frame = next.in_frame;
    };
    const auto passage = [&] {
        return std::exp(-coated.thickness / std::abs(glm::dot(walk.in, v.n)));
    };
    std::optional<Step> next = choose_interface(prepared.interface, inwards, here, random);
    if (!next) return {};
    take(*next, 1);
    for (int bounce = 0; glm::dot(walk.in, v.n) < 0; ++bounce) {
        // A walk of a thousand rounds has no light left.
        if (bounce == 1000) return {};
        const double down = passage();
        here.n = v.n;
        if (const auto* diffuse = std::get_if<DiffuseMaterial>(&coated.base)) {
            next.emplace();
            const double u = random(), phi = 2 * pi * random(), r = std::sqrt(u);
            next->in = Axes(v.n).to_world({r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u)});
            next->in_frame = any_perpendicular(next->in);
            for (const double at : nm) {
                next->worth.push_back(depolariser(spectrum_at(diffuse_reflectance(*diffuse), at)));
            }
        } else {
            next = choose_metal(prepared.metal, nm, here, random);
        }
        if (!next || !(glm::dot(next->in, v.n) > 0)) return {};
        take(*next, down);
        const double up = passage();
        here.n = -v.n;
        next = choose_interface(prepared.interface, outwards, here, random);
        if (!next) return {};
        take(*next, up);
    }
    return walk;
}

}  // namespace drude
