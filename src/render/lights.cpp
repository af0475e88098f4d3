#include "render/lights.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "image/image.h"
#include "materials/scalar.h"
#include "render/camera_ray.h"

namespace drude {

namespace {

constexpr float infinite_distance = std::numeric_limits<float>::infinity();
constexpr float pi_f = static_cast<float>(pi);

// The share of a spot's intensity at an angle from its axis: pbrt-v4's smooth step of the cosine.
double spot_falloff(const PointLight& light, double cosine) {
    if (light.cos_end <= -1 && light.cos_start <= -1) return 1;  // a point light
    if (cosine <= light.cos_end) return 0;
    if (cosine >= light.cos_start) return 1;
    const double t = (cosine - light.cos_end) / (light.cos_start - light.cos_end);
    return t * t * (3 - 2 * t);
}

double luminance_of(const DenseSpectrum& spectrum) {
    return spectrum_to_xyz(spectrum)[1];
}

}  // namespace

void Lights::add(const Emitter& emitter, double power, size_t first_of_light) {
    shines_ = shines_ || power > 0;
    emitters_.push_back(emitter);
    power_.push_back(power);
    light_of_.push_back(first_of_light);
}

float Lights::choice(size_t emitter) const {
    return emitter > 0 ? cdf_[emitter] - cdf_[emitter - 1] : cdf_[0];
}

void Lights::make_choice() {
    double total = 0;
    std::vector<double> of_light(emitters_.size(), 0);
    for (size_t i = 0; i < emitters_.size(); ++i) {
        total += power_[i];
        of_light[light_of_[i]] += power_[i];
    }
    if (!(total > 0)) {
        emitters_.clear();
        return;
    }
    const auto lights = static_cast<double>(
        std::count_if(of_light.begin(), of_light.end(), [](double p) { return p > 0; }));
    constexpr double alike = 0.1;
    double sum = 0;
    for (size_t i = 0; i < emitters_.size(); ++i) {
        // A light without power keeps a place with probability zero.
        if (power_[i] > 0) {
            sum += (1 - alike) * power_[i] / total +
                   alike * power_[i] / (of_light[light_of_[i]] * lights);
        }
        // Steps of the uniform numbers themselves, so that the probability is exactly the one that
        // is divided by.
        cdf_.push_back(static_cast<float>(std::round(std::min(1.0, sum) * 0x1p24) * 0x1p-24));
        if (emitters_[i].kind == Kind::environment || emitters_[i].kind == Kind::constant) {
            infinite_[emitters_[i].index].choice = choice(i);
        }
    }
}

Lights::Lights(const Scene& scene, const Geometry& geometry, const SamplingStrategy& strategy,
               bool constant_skies)
    : scene_(scene),
      geometry_(geometry),
      first_of_shape_(scene.shapes.size(), -1),
      any_polarised_(has_polarised_lights(scene)) {
    const double handedness = picture_handedness(scene.camera);
    const double extent = std::max(1e-6, static_cast<double>(geometry.radius()));
    const double cross_section = pi * extent * extent;
    for (size_t i = 0; i < scene.infinite_lights.size(); ++i) {
        const InfiniteLight& light = scene.infinite_lights[i];
        Infinite infinite;
        double luminance = 0;
        if (light.image.empty()) {
            luminance = luminance_of(light.radiance);
            shines_ = shines_ || luminance > 0;
            if (!constant_skies) luminance = 0;
        } else {
            infinite.environment = std::make_unique<Environment>(
                light.picture ? *light.picture : read_image(light.image), light.scale,
                light.world_from_light, light.image, strategy.compensated_environments);
            luminance = infinite.environment->mean_luminance();
            if (const int repaired = infinite.environment->repaired_texels(); repaired > 0) {
                warnings_.push_back(
                    fmt::format("{}: {} texels are negative or not finite; taken as black",
                                light.image, repaired));
            }
        }
        infinite.polarisation = SkyPolarisation(light, handedness);
        infinite_.push_back(std::move(infinite));
        add({infinite_.back().environment ? Kind::environment : Kind::constant,
             static_cast<int>(i)},
            4 * pi * cross_section * luminance, emitters_.size());
    }
    for (size_t i = 0; i < scene.distant_lights.size(); ++i) {
        add({Kind::distant, static_cast<int>(i)},
            cross_section * luminance_of(scene.distant_lights[i].irradiance), emitters_.size());
        distant_polarisation_.emplace_back(scene.distant_lights[i].polarisation, handedness);
    }
    for (size_t i = 0; i < scene.point_lights.size(); ++i) {
        // From afar it sends the scene no more than what falls on its cross-section.
        const PointLight& light = scene.point_lights[i];
        const glm::dvec3 to = glm::dvec3(geometry.centre()) - light.position;
        const double solid_angle =
            std::min(4 * pi, cross_section / std::max(1e-30, glm::dot(to, to)));
        add({Kind::point, static_cast<int>(i)}, solid_angle * luminance_of(light.intensity),
            emitters_.size());
        point_polarisation_.emplace_back(light.polarisation, handedness);
    }
    for (const AreaLight& light : scene.area_lights) {
        area_polarisation_.emplace_back(light.polarisation, handedness);
    }
    for (size_t i = 0; i < scene.shapes.size(); ++i) {
        const Shape& shape = scene.shapes[i];
        if (shape.area_light < 0 || shape.material < 0) continue;
        const AreaLight& light = scene.area_lights[shape.area_light];
        const double exitance = pi * luminance_of(light.radiance) * (light.two_sided ? 2 : 1);
        const size_t first = emitters_.size();
        first_of_shape_[i] = static_cast<int>(first);
        for (unsigned p = 0; p < geometry.primitives(static_cast<int>(i)); ++p) {
            add({Kind::area, static_cast<int>(i), p},
                exitance * geometry.area(static_cast<int>(i), p), first);
        }
    }
    make_choice();
}

float Lights::infinite_pdf(size_t light, const glm::vec3& d) const {
    const Infinite& l = infinite_[light];
    return l.choice * (l.environment ? l.environment->pdf(d) : 1 / (4 * pi_f));
}

float Lights::area_pdf(const Hit& hit, const glm::vec3& d, float distance) const {
    const int first = first_of_shape_[hit.shape];
    if (first < 0 || emitters_.empty()) return 0;
    const size_t i = static_cast<size_t>(first) + hit.primitive;
    const float cosine = std::abs(glm::dot(hit.ng, d));
    return cosine > 0 ? choice(i) * distance * distance / cosine * geometry_.density(hit) : 0;
}

void Lights::sample_area(const Emitter& e, float choice, const glm::vec3& at, const glm::vec2& u,
                         Sample* s) const {
    const Shape& shape = scene_.shapes[e.index];
    auto [hit, density] = geometry_.sample(e.index, e.primitive, u);
    const glm::vec3 to = hit.p - at;
    const float distance2 = glm::dot(to, to);
    s->light = shape.area_light;
    if (!(distance2 > 0) || !(density > 0)) return;
    s->distance = std::sqrt(distance2);
    s->d = to / s->distance;
    const float cosine = -glm::dot(hit.ng, s->d);
    if (cosine == 0 || (cosine < 0 && !scene_.area_lights[shape.area_light].two_sided)) return;
    s->pdf = choice * distance2 / std::abs(cosine) * density;
    // Off the light by its own rounding and by that of a ray over the distance.
    hit.error += 4 * std::numeric_limits<float>::epsilon() * s->distance;
    s->target = leave(hit, -s->d);
}

void Lights::sample_point(const PointLight& light, float choice, const glm::vec3& at,
                          Sample* s) const {
    const glm::dvec3 to = light.position - glm::dvec3(at);
    const double distance2 = glm::dot(to, to), distance = std::sqrt(distance2);
    if (!(distance2 > 0)) return;
    const double falloff = spot_falloff(light, -glm::dot(light.axis, to) / distance);
    s->d = glm::vec3(to / distance);
    s->distance = static_cast<float>(distance);
    // Lamps are put on surfaces; pbrt-v4 stops a ten-thousandth before them too.
    s->target = glm::vec3(light.position - 1e-4 * to);
    s->is_delta = true;
    if (falloff > 0) s->pdf = static_cast<float>(static_cast<double>(choice) * distance2 / falloff);
}

ArrivingPolarisation Lights::area_polarisation(int shape, const glm::vec3& d) const {
    const UniformPolarisation& light = area_polarisation_[scene_.shapes[shape].area_light];
    if (light.none()) return {};
    // Lengths far beyond 1 would overflow when squared.
    return light.arriving(
        d, glm::vec3(glm::normalize(glm::dvec3(scene_.shapes[shape].world_from_object[0]))));
}

ArrivingPolarisation Lights::polarisation_of(const Sample& s, const Emitter& emitter) const {
    switch (s.kind) {
        case Kind::environment:
        case Kind::constant:
            return infinite_polarisation(emitter.index, s.d);
        case Kind::distant:
            return distant_polarisation_[emitter.index].arriving(
                s.d, glm::vec3(scene_.distant_lights[emitter.index].x_axis));
        case Kind::point:
            return point_polarisation_[emitter.index].arriving(
                s.d, glm::vec3(scene_.point_lights[emitter.index].x_axis));
        case Kind::area:
            break;
    }
    return area_polarisation(emitter.index, s.d);
}

Lights::Sample Lights::sample(const glm::vec3& at, float u_choice, const glm::vec2& u) const {
    Sample s;
    if (emitters_.empty()) return s;
    const size_t i = std::min<size_t>(
        std::upper_bound(cdf_.begin(), cdf_.end(), u_choice) - cdf_.begin(), emitters_.size() - 1);
    const Emitter& e = emitters_[i];
    const float p = choice(i);
    if (!(p > 0)) return s;
    s.kind = e.kind;
    s.light = e.index;
    s.distance = infinite_distance;
    switch (e.kind) {
        case Kind::environment: {
            const Environment::Sample sample = infinite_[e.index].environment->sample(u);
            s.d = sample.d;
            s.rgb = sample.radiance;
            s.pdf = p * sample.pdf;
            break;
        }
        case Kind::constant: {
            const float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z));
            s.d = {r * std::cos(2 * pi_f * u.y), r * std::sin(2 * pi_f * u.y), z};
            s.pdf = p / (4 * pi_f);
            break;
        }
        case Kind::distant:
            s.d = glm::vec3(-scene_.distant_lights[e.index].direction);
            s.pdf = p;
            s.is_delta = true;
            break;
        case Kind::point:
            sample_point(scene_.point_lights[e.index], p, at, &s);
            break;
        case Kind::area:
            sample_area(e, p, at, u, &s);
            break;
    }
    if (any_polarised_) s.polarisation = polarisation_of(s, e);
    return s;
}

}  // namespace drude
