#include "render/lights.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "image/image.h"
#include "materials/scalar.h"

namespace drude {

namespace {

constexpr float infinite_distance = std::numeric_limits<float>::infinity();
constexpr float pi_f = static_cast<float>(pi);

double luminance_of(const DenseSpectrum& spectrum) {
    return spectrum_to_xyz(spectrum)[1];
}

}  // namespace

void Lights::add(const Emitter& emitter, double power) {
    emitters_.push_back(emitter);
    power_.push_back(power);
}

Lights::Lights(const Scene& scene, const Geometry& geometry)
    : scene_(scene), geometry_(geometry), first_of_shape_(scene.shapes.size(), -1) {
    const double extent = std::max(1e-6, static_cast<double>(geometry.radius()));
    const double cross_section = pi * extent * extent;
    for (size_t i = 0; i < scene.infinite_lights.size(); ++i) {
        const InfiniteLight& light = scene.infinite_lights[i];
        Infinite infinite;
        double luminance = 0;
        if (light.image.empty()) {
            luminance = luminance_of(light.radiance);
        } else {
            infinite.environment = std::make_unique<Environment>(
                light.picture ? *light.picture : read_image(light.image), light.scale,
                light.world_from_light, light.image);
            luminance = infinite.environment->mean_luminance();
            if (const int repaired = infinite.environment->repaired_texels(); repaired > 0) {
                warnings_.push_back(
                    fmt::format("{}: {} texels are negative or not finite; taken as black",
                                light.image, repaired));
            }
        }
        infinite_.push_back(std::move(infinite));
        add({infinite_.back().environment ? Kind::environment : Kind::constant,
             static_cast<int>(i)},
            4 * pi * cross_section * luminance);
    }
    for (size_t i = 0; i < scene.distant_lights.size(); ++i) {
        add({Kind::distant, static_cast<int>(i)},
            cross_section * luminance_of(scene.distant_lights[i].irradiance));
    }
    for (size_t i = 0; i < scene.shapes.size(); ++i) {
        const Shape& shape = scene.shapes[i];
        if (shape.area_light < 0) continue;
        const AreaLight& light = scene.area_lights[shape.area_light];
        const double exitance = pi * luminance_of(light.radiance) * (light.two_sided ? 2 : 1);
        first_of_shape_[i] = static_cast<int>(emitters_.size());
        if (const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry)) {
            for (unsigned t = 0; t < mesh->triangles.size(); ++t) {
                glm::vec3 c[3];
                geometry.triangle(static_cast<int>(i), t, c);
                const float area = 0.5f * glm::length(glm::cross(c[1] - c[0], c[2] - c[0]));
                add({Kind::area, static_cast<int>(i), t, area},
                    exitance * static_cast<double>(area));
            }
        } else {
            // Uniform in the object's own area: exact for rigid and uniformly scaled spheres,
            // which is what the scene reader lets through for emitting ones.
            const Sphere& s = std::get<Sphere>(shape.geometry);
            const double scale = glm::length(glm::dvec3(shape.world_from_object[0]));
            const double area = s.phi_max_deg / 360 * 2 * pi * s.radius *
                                (std::min(s.z_max, s.radius) - std::max(s.z_min, -s.radius)) *
                                scale * scale;
            add({Kind::area, static_cast<int>(i), 0, static_cast<float>(area)}, exitance * area);
        }
    }
    double total = 0;
    for (const double p : power_) total += p;
    double sum = 0;
    for (size_t i = 0; i < emitters_.size(); ++i) {
        // A light without power keeps a place with probability zero.
        sum += total > 0 ? power_[i] / total : 0;
        cdf_.push_back(static_cast<float>(sum));
        if (emitters_[i].kind == Kind::environment || emitters_[i].kind == Kind::constant) {
            infinite_[emitters_[i].index].choice = i > 0 ? cdf_[i] - cdf_[i - 1] : cdf_[i];
        }
    }
    if (!(total > 0)) emitters_.clear();
}

float Lights::infinite_pdf(size_t light, const glm::vec3& d) const {
    const Infinite& l = infinite_[light];
    return l.choice * (l.environment ? l.environment->pdf(d) : 1 / (4 * pi_f));
}

float Lights::area_pdf(const Hit& hit, const glm::vec3& d, float distance) const {
    const int first = first_of_shape_[hit.shape];
    if (first < 0 || emitters_.empty()) return 0;
    const size_t i = static_cast<size_t>(first) + hit.primitive;
    const float choice = i > 0 ? cdf_[i] - cdf_[i - 1] : cdf_[i];
    const float cosine = std::abs(glm::dot(hit.ng, d));
    return cosine > 0 && emitters_[i].area > 0
               ? choice * distance * distance / (cosine * emitters_[i].area)
               : 0;
}

Lights::Sample Lights::sample(const glm::vec3& at, float u_choice, const glm::vec2& u) const {
    Sample s;
    if (emitters_.empty()) return s;
    const size_t i = std::min<size_t>(
        std::upper_bound(cdf_.begin(), cdf_.end(), u_choice) - cdf_.begin(), emitters_.size() - 1);
    const Emitter& e = emitters_[i];
    const float choice = i > 0 ? cdf_[i] - cdf_[i - 1] : cdf_[i];
    if (!(choice > 0)) return s;
    s.kind = e.kind;
    s.light = e.index;
    s.distance = infinite_distance;
    switch (e.kind) {
        case Kind::environment: {
            const Environment::Sample sample = infinite_[e.index].environment->sample(u);
            s.d = sample.d;
            s.rgb = sample.radiance;
            s.pdf = choice * sample.pdf;
            break;
        }
        case Kind::constant: {
            const float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z));
            s.d = {r * std::cos(2 * pi_f * u.y), r * std::sin(2 * pi_f * u.y), z};
            s.pdf = choice / (4 * pi_f);
            break;
        }
        case Kind::distant:
            s.d = glm::vec3(-scene_.distant_lights[e.index].direction);
            s.pdf = choice;
            s.is_delta = true;
            break;
        case Kind::area: {
            const Shape& shape = scene_.shapes[e.index];
            glm::vec3 p, n;
            if (std::holds_alternative<TriangleMesh>(shape.geometry)) {
                glm::vec3 c[3];
                geometry_.triangle(e.index, e.primitive, c);
                const float root = std::sqrt(u.x);
                p = (1 - root) * c[0] + root * (1 - u.y) * c[1] + root * u.y * c[2];
                n = glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
                const bool mirrored = glm::determinant(glm::dmat3(shape.world_from_object)) < 0;
                if (shape.reverse_orientation != mirrored) n = -n;
            } else {
                const Sphere& sphere = std::get<Sphere>(shape.geometry);
                const double low = std::max(sphere.z_min, -sphere.radius);
                const double high = std::min(sphere.z_max, sphere.radius);
                const double z = low + static_cast<double>(u.x) * (high - low);
                const double phi = static_cast<double>(u.y) * sphere.phi_max_deg * pi / 180;
                const double r = std::sqrt(std::max(0.0, sphere.radius * sphere.radius - z * z));
                const glm::dvec3 object(r * std::cos(phi), r * std::sin(phi), z);
                p = glm::vec3(shape.world_from_object * glm::dvec4(object, 1));
                n = glm::normalize(glm::vec3(glm::dmat3(shape.world_from_object) * object));
                if (shape.reverse_orientation) n = -n;
            }
            const glm::vec3 to = p - at;
            const float distance2 = glm::dot(to, to);
            s.light = shape.area_light;
            if (!(distance2 > 0) || !(e.area > 0)) return s;
            s.distance = std::sqrt(distance2);
            s.d = to / s.distance;
            const float cosine = -glm::dot(n, s.d);
            const bool lit = scene_.area_lights[shape.area_light].two_sided || cosine > 0;
            if (lit && cosine != 0) s.pdf = choice * distance2 / (std::abs(cosine) * e.area);
            break;
        }
    }
    return s;
}

}  // namespace drude
