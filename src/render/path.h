// One path, from the camera until it leaves the scene: the renderer's inner loop.
#pragma once

#include "render/camera_ray.h"
#include "render/geometry.h"
#include "render/lights.h"
#include "render/sampler.h"
#include "render/spectral_tables.h"
#include "render/throughput.h"

namespace drude {

struct PathStatistics {
    uint64_t rays = 0;
    uint64_t projections = 0;  // contributions more than rounding outside the Stokes cone: a bug
    uint64_t not_finite = 0;   // contributions dropped because they were not numbers: a bug
};

template <Transport transport, int N>
class PathTracer {
  public:
    PathTracer(const Scene& scene, const Geometry& geometry, const Lights& lights,
               const SpectralTables<N>& tables, float handedness)
        : scene_(scene), geometry_(geometry), lights_(lights), tables_(tables), h_(handedness) {}

    // Adds to `radiance` what arrives along the camera ray at the wavelengths of `phase`.
    void trace(const CameraRay& camera, int phase, int max_depth, Sampler& sampler,
               Contribution<transport, N>* radiance, PathStatistics* statistics) const {
        Throughput<transport, N> throughput;
        glm::vec3 o = camera.o, d = camera.d;
        glm::vec3 x = camera.horizontal;  // x axis of the columns' frame on the ray along -d
        // The density with which the lobe chose d; 0 where no light sample competes with it.
        float lobe_pdf = 0;
        const auto add = [&](Contribution<transport, N> c, float weight, int bounces) {
            const float excess = project_on_cone(&c);
            statistics->projections += excess > 1e-5f * static_cast<float>(bounces + 1);
            const float check = sum(c.s[0]) * weight;
            if (!(check < std::numeric_limits<float>::infinity())) {
                ++statistics->not_finite;
                return;
            }
            for (int i = 0; i < carried_rows<transport>; ++i) {
                radiance->s[i] += c.s[i] * Packet<N>(weight);
            }
        };

        for (int depth = 0;;) {
            Hit hit;
            ++statistics->rays;
            if (!geometry_.intersect(o, d, &hit)) {
                for (size_t i = 0; i < lights_.infinite().size(); ++i) {
                    const float weight =
                        lobe_pdf > 0 ? mis(lobe_pdf, lights_.infinite_pdf(i, d)) : 1;
                    add(throughput.unpolarised(infinite_radiance(i, d, phase)), weight, depth);
                }
                return;
            }
            const Shape& shape = scene_.shapes[hit.shape];
            if (shape.area_light >= 0 && emits(shape, hit, d)) {
                const float distance = glm::length(hit.p - o);
                const float weight =
                    lobe_pdf > 0 ? mis(lobe_pdf, lights_.area_pdf(hit, d, distance)) : 1;
                add(throughput.unpolarised(tables_.area_radiance[shape.area_light][phase]), weight,
                    depth);
            }
            if (depth++ == max_depth) return;

            // Local coordinates on the side that the path arrives from.
            const glm::vec3 wo = -d;
            if (glm::dot(hit.ng, wo) < 0) {
                hit.ng = -hit.ng;
                hit.ns = -hit.ns;
            }
            if (!(glm::dot(hit.ns, wo) > 0)) hit.ns = hit.ng;
            const glm::vec3 tangent = any_perpendicular(hit.ns);
            const glm::vec3 bitangent = glm::cross(hit.ns, tangent);
            const auto to_world = [&](const glm::vec3& v) {
                return v.x * tangent + v.y * bitangent + v.z * hit.ns;
            };
            const auto to_local = [&](const glm::vec3& v) {
                return glm::vec3(glm::dot(v, tangent), glm::dot(v, bitangent), glm::dot(v, hit.ns));
            };
            const glm::vec3 o_local = to_local(wo);

            if (std::holds_alternative<DiffuseMaterial>(scene_.materials[shape.material])) {
                const Packet<N> reflectance = tables_.diffuse_reflectance[shape.material][phase];
                if (const Lights::Sample l = light_sample(hit, sampler); l.pdf > 0) {
                    const float cosine = glm::dot(l.d, hit.ns);
                    if (cosine > 0 && visible(hit, l, statistics)) {
                        const float lobe = cosine / static_cast<float>(pi);
                        const float weight = l.is_delta ? 1 : mis(l.pdf, lobe);
                        add(throughput.unpolarised(reflectance * radiance_of(l, phase)),
                            weight * lobe / l.pdf, depth);
                    }
                }
                const glm::vec2 u = sampler.next_2d();
                const float r = std::sqrt(u.x), phi = static_cast<float>(2 * pi) * u.y;
                const glm::vec3 i(r * std::cos(phi), r * std::sin(phi),
                                  std::sqrt(std::max(0.0f, 1 - u.x)));
                throughput.depolarise(reflectance);
                d = glm::normalize(to_world(i));
                lobe_pdf = i.z / static_cast<float>(pi);
                x = any_perpendicular(d);
                if (!(lobe_pdf > 0) || !(glm::dot(d, hit.ng) > 0)) return;
            } else {
                const ConductorTables<N>& metal = tables_.conductors[shape.material];
                glm::vec3 m(0, 0, 1), i(-o_local.x, -o_local.y, o_local.z);
                float factor = 1;
                lobe_pdf = 0;
                if (!metal.microfacets.is_mirror()) {
                    if (const Lights::Sample l = light_sample(hit, sampler); l.pdf > 0) {
                        add_light_over_lobe(throughput, metal, l, hit, wo, x, to_world, o_local,
                                            to_local(l.d), phase, depth, statistics, add);
                    }
                    const glm::vec2 u = sampler.next_2d();
                    const auto s = metal.microfacets.sample(o_local, u.x, u.y, sampler.next_1d());
                    if (!(s.weight > 0) || !(s.pdf > 0)) return;
                    m = s.m;
                    i = s.i;
                    factor = s.weight;
                    lobe_pdf = s.pdf;
                }
                const glm::vec3 wi = glm::normalize(to_world(i));
                if (!(glm::dot(wi, hit.ng) > 0)) return;
                const glm::vec3 s = s_axis(-wi, to_world(m));
                throughput.reflect(rotation_between(wo, x, s, h_),
                                   metal.reflection(std::min(1.0f, glm::dot(i, m)), phase), factor);
                d = wi;
                x = s;
            }
            o = leave(hit, d);

            // Roulette on S0 alone: it bounds every other element of the product.
            const float alive = max_lane(throughput.corner());
            if (!(alive > 0)) return;
            if (depth > 2) {
                // Between perfect mirrors nothing else would ever end a path.
                const float at_most = depth > 64 ? 0.95f : 1.0f;
                const float survival = std::clamp(alive, 0.05f, at_most);
                if (survival < 1) {
                    if (sampler.next_1d() >= survival) return;
                    throughput.scale(1 / survival);
                }
            }
        }
    }

  private:
    // Power heuristic (Veach 1997, eq. 9.13) for a sample of density a against b.
    static float mis(float a, float b) {
        if (!(b > 0)) return 1;
        const float ratio = b / a;
        return 1 / (1 + ratio * ratio);
    }

    bool emits(const Shape& shape, const Hit& hit, const glm::vec3& d) const {
        return scene_.area_lights[shape.area_light].two_sided || glm::dot(hit.ng, d) < 0;
    }

    Packet<N> infinite_radiance(size_t light, const glm::vec3& d, int phase) const {
        const auto& environment = lights_.infinite()[light].environment;
        return environment ? tables_.rgb_light(environment->radiance(d), phase)
                           : tables_.infinite_radiance[light][phase];
    }

    Lights::Sample light_sample(const Hit& hit, Sampler& sampler) const {
        const float choice = sampler.next_1d();
        return lights_.sample(hit.p, choice, sampler.next_2d());
    }

    Packet<N> radiance_of(const Lights::Sample& l, int phase) const {
        switch (l.kind) {
            case Lights::Kind::environment:
                return tables_.rgb_light(l.rgb, phase);
            case Lights::Kind::constant:
                return tables_.infinite_radiance[l.light][phase];
            case Lights::Kind::distant:
                return tables_.distant_irradiance[l.light][phase];
            case Lights::Kind::point:
                return tables_.point_intensity[l.light][phase];
            case Lights::Kind::area:
                break;
        }
        return tables_.area_radiance[l.light][phase];
    }

    // Whether the light sample reaches the surface on the side that it is wanted on.
    bool visible(const Hit& hit, const Lights::Sample& l, PathStatistics* statistics) const {
        if (!(glm::dot(l.d, hit.ng) > 0)) return false;
        ++statistics->rays;
        const glm::vec3 from = leave(hit, l.d);
        if (std::isinf(l.distance)) return !geometry_.occluded(from, l.d, l.distance);
        const glm::vec3 to = l.target - from;
        const float distance = glm::length(to);
        return distance > 0 && !geometry_.occluded(from, to / distance, distance);
    }

    template <class ToWorld, class Add>
    void add_light_over_lobe(const Throughput<transport, N>& throughput,
                             const ConductorTables<N>& metal, const Lights::Sample& l,
                             const Hit& hit, const glm::vec3& wo, const glm::vec3& x,
                             const ToWorld& to_world, const glm::vec3& o_local,
                             const glm::vec3& i_local, int phase, int depth,
                             PathStatistics* statistics, const Add& add) const {
        const auto e = metal.microfacets.evaluate(o_local, i_local);
        if (!(e.value > 0) || !visible(hit, l, statistics)) return;
        const auto r = metal.reflection(std::min(1.0f, glm::dot(i_local, e.m)), phase);
        const Packet<N> light = radiance_of(l, phase);
        const float weight = l.is_delta ? 1 : mis(l.pdf, e.pdf);
        const glm::vec3 s = s_axis(-l.d, to_world(e.m));
        add(throughput.reflect_unpolarised(rotation_between(wo, x, s, h_), r.A() * light,
                                           r.B() * light),
            weight * e.value / l.pdf, depth);
    }

    const Scene& scene_;
    const Geometry& geometry_;
    const Lights& lights_;
    const SpectralTables<N>& tables_;
    const float h_;
};

}  // namespace drude
