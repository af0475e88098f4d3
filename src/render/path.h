// One path, from the camera until it leaves the scene: the renderer's inner loop.
#pragma once

#include "render/beam.h"
#include "render/camera_ray.h"
#include "render/lights.h"
#include "render/optical_elements.h"
#include "render/plugin_scattering.h"
#include "render/sampler.h"
#include "render/spectral_tables.h"
#include "render/surface_scattering.h"
#include "render/throughput.h"
#include "render/vertex.h"

namespace drude {

struct PathStatistics {
    uint64_t rays = 0;
    uint64_t projections = 0;  // contributions more than rounding outside the Stokes cone: a bug
    uint64_t not_finite = 0;   // contributions dropped because they were not numbers: a bug
};

// What every path of a render shares.
template <Transport transport, int N>
struct PathSetup {
    const Scene& scene;
    const Geometry& geometry;
    const Lights& lights;
    const OpticalElements& elements;
    const NumberTextures& numbers;
    const SpectralTables<N>& tables;
    float handedness;
    int max_depth;
    SamplingStrategy strategy;
    int clear_after;                 // rays after so many reflections meet nothing
    Throughput<transport, N> first;  // the camera's analyser, or nothing
};

// After as many bounces a path ends at random however bright it is. Earlier, light that comes over
// hundreds of good mirrors would rest on a few paths of enormous weight: ending with probability q
// a bounce makes their variance grow as (R^2 / (1 - q))^bounces.
inline constexpr int most_certain_bounces = 1024;

template <Transport transport, int N>
class Path {
  public:
    Path(const PathSetup<transport, N>& setup, int phase, Sampler& sampler,
         PathStatistics& statistics)
        : setup_(setup),
          scene_(setup.scene),
          lights_(setup.lights),
          tables_(setup.tables),
          polarised_(setup.lights.any_polarised()),
          h_(setup.handedness),
          phase_(phase),
          sampler_(sampler),
          statistics_(statistics),
          beam_{setup.first} {
        for (Packet<N>& s : radiance_.s) s = Packet<N>(0.0f);
    }

    // What arrives along the camera ray at the wavelengths of the phase.
    const Contribution<transport, N>& trace(const CameraRay& camera) {
        o_ = camera.o;
        d_ = camera.d;
        beam_.x = camera.horizontal;
        from_ = o_;
        const float start = max_lane(beam_.throughput.corner());
        cancelled_ = 0.1f * start;
        while (step()) {
            // Roulette on S0 alone: it bounds every other element of the product. What refraction
            // does to radiance is taken back, since it comes back when the path leaves again.
            const float alive = max_lane(beam_.throughput.corner()) * radiance_scale_ / start;
            if (!(alive > 0)) break;
            if (depth_ > 2) {
                // Between perfect mirrors nothing else would ever end a path.
                const float at_most = depth_ > most_certain_bounces ? 0.95f : 1.0f;
                const float survival = std::clamp(alive, 0.05f, at_most);
                if (survival < 1) {
                    if (sampler_.next_1d() >= survival) break;
                    beam_.throughput.scale(1 / survival);
                }
            }
        }
        return radiance_;
    }

  private:
    // To the next surface and off it; whether the path goes on.
    bool step() {
        Hit hit;
        bool is_hit = false;
        if (depth_ < setup_.clear_after) {
            ++statistics_.rays;
            is_hit = setup_.geometry.intersect(o_, d_, &hit);
        }
        if (!setup_.elements.empty()) {
            pass_elements(o_, d_,
                          is_hit ? glm::length(hit.p - o_) : std::numeric_limits<float>::infinity(),
                          beam_);
        }
        if (!is_hit) {
            add_infinite_lights();
            return false;
        }
        const Shape& shape = scene_.shapes[hit.shape];
        if (shape.area_light >= 0) add_area_light(shape, hit);
        const int material = chosen_material(shape.material, hit);
        if (material < 0) {
            // Nothing here after all: straight on. Light sampling took the surface for solid, so
            // that nothing competes with what is found behind it.
            o_ = leave(hit, d_);
            lobe_pdf_ = 0;
            return ++passed_ < most_passed;
        }
        if (depth_++ == setup_.max_depth) return false;

        const Vertex v(hit, d_);
        return std::visit([&](const auto& surface) { return scatter_at(v, surface); },
                          tables_.surfaces[material]);
    }

    // ---- surfaces

    bool scatter_at(const Vertex& v, const DiffuseTables<N>& surface) {
        return scatter(v, DiffuseScattering<N>(reflectance_at(v, surface.reflectance)));
    }
    bool scatter_at(const Vertex& v, const DiffuseTransmissionTables<N>& surface) {
        return scatter(v,
                       DiffuseTransmissionScattering<N>(reflectance_at(v, surface.reflectance),
                                                        reflectance_at(v, surface.transmittance)));
    }
    bool scatter_at(const Vertex& v, const ConductorTables<N>& metal) {
        return with_conductor(v, metal, [&](const auto& surface) { return scatter(v, surface); });
    }
    bool scatter_at(const Vertex& v, const DielectricTables<N>& glass) {
        const Packet<N> index = glass.eta[phase_];
        const Packet<N> eta = v.front ? index : Packet<N>(1.0f) / index;
        if (!glass.is_dispersive) {
            return pass_interface(v, DielectricScattering<N>(glass.interface, eta));
        }
        if (hero_ < 0) hero_ = std::min(N - 1, static_cast<int>(sampler_.next_1d() * N));
        if (!pass_interface(v, DielectricScattering<N>(glass.interface, eta, hero_,
                                                       parted_ ? 1.0f : static_cast<float>(N)))) {
            return false;
        }
        parted_ |= glm::dot(d_, v.hit.ng) < 0;
        return true;
    }
    bool scatter_at(const Vertex& v, const ThinDielectricTables<N>& plate) {
        return scatter(v, ThinDielectricScattering<N>(plate.eta[phase_]));
    }
    bool scatter_at(const Vertex& v, const CoatTables<N>& coat) {
        if (const auto* base = std::get_if<DiffuseTables<N>>(&coat.base)) {
            return walk_in_coat(v, coat,
                                DiffuseScattering<N>(reflectance_at(v, base->reflectance)));
        }
        return with_conductor(v, std::get<ConductorTables<N>>(coat.base),
                              [&](const auto& base) { return walk_in_coat(v, coat, base); });
    }
    bool scatter_at(const Vertex& v, const PluginTables<N>& plugin) {
        return scatter(v, PluginScattering<N>(plugin, phase_, v, beam_.x, h_,
                                              {statistics_.projections, statistics_.not_finite}));
    }
    // Neither is part of what is hit.
    bool scatter_at(const Vertex&, const MixTables&) { return false; }
    bool scatter_at(const Vertex&, const NoTables&) { return false; }

    // Light at the vertex by sampling lights, then a direction by sampling the surface.
    template <class Surface>
    bool scatter(const Vertex& v, const Surface& surface) {
        const glm::vec3 out = v.to_local(v.out);
        if (!surface.is_delta()) {
            if (const Lights::Sample l = light_sample(v.hit); l.pdf > 0) {
                const glm::vec3 in = v.to_local(l.d);
                const LobeValue e = surface.evaluate(out, in);
                if (e.value > 0 && reaches(v, l, e.transmits)) {
                    const float weight = light_share(l, e.pdf) * e.value / l.pdf;
                    add_light(v, l, surface.optics(out, in, e.m, e.transmits), e.m, weight);
                }
            }
        }
        const LobeSample s = surface.sample(out, sampler_);
        if (!(s.weight > 0)) return false;
        const glm::vec3 in = glm::normalize(v.to_world(s.i));
        const float side = glm::dot(in, v.hit.ng);
        if (!(s.transmits ? side < 0 : side > 0)) return false;
        beam_.scatter(v.out, -in, v.to_world(s.m), surface.optics(out, s.i, s.m, s.transmits),
                      s.weight, h_);
        go_on(v.hit, in, s.pdf);
        return true;
    }

    bool pass_interface(const Vertex& v, const DielectricScattering<N>& surface) {
        if (!scatter(v, surface)) return false;
        if (glm::dot(d_, v.hit.ng) < 0) radiance_scale_ *= surface.hero_eta() * surface.hero_eta();
        return true;
    }

    // coat_walk.h
    template <class Base>
    bool walk_in_coat(const Vertex& v, const CoatTables<N>& coat, const Base& base);
    template <class Base>
    void add_light_through_coat(const Vertex& v, const CoatTables<N>& coat, const Base& base,
                                const glm::vec3& out);
    void add_light_through_rough_coat(const Vertex& v, const CoatTables<N>& coat,
                                      const DielectricScattering<N>& from_below,
                                      const glm::vec3& up);

    // ---- what textures say at a vertex

    Packet<N> reflectance_at(const Vertex& v, const PackedValue<N>& value) const {
        if (value.texture < 0) return value.constant[phase_];
        return tables_.textures.reflectance(value, TexturePoint(setup_.geometry, v.hit), phase_);
    }
    template <class Body>
    bool with_conductor(const Vertex& v, const ConductorTables<N>& metal, const Body& body) const {
        if (metal.roughness) {
            const double alpha =
                setup_.numbers.alpha(*metal.roughness, TexturePoint(setup_.geometry, v.hit));
            return with_lobe(
                v, metal,
                Microfacets<float>::from_alpha(tables_.model.lobe_width(alpha), metal.masking),
                body);
        }
        return with_lobe(v, metal, metal.microfacets, body);
    }
    template <class Body>
    bool with_lobe(const Vertex& v, const ConductorTables<N>& metal, const Microfacets<float>& lobe,
                   const Body& body) const {
        const bool visible = setup_.strategy.visible_normals;
        if (!metal.fixed_reflectance) {
            return body(ConductorScattering<N>(metal, lobe, phase_, visible));
        }
        return body(ConductorScattering<N>(metal, lobe, phase_, visible,
                                           reflectance_at(v, *metal.fixed_reflectance)));
    }

    // ---- the state of the path

    void go_on(const Hit& hit, const glm::vec3& d, float lobe_pdf) {
        o_ = leave(hit, d);
        d_ = d;
        from_ = o_;
        const bool alone = setup_.strategy.directions == SamplingStrategy::Directions::lobe;
        lobe_pdf_ = alone ? 0 : lobe_pdf;
    }

    void pass_elements(const glm::vec3& o, const glm::vec3& d, float distance,
                       Beam<transport, N>& beam) {
        setup_.elements.along(o, d, distance, [&](const Hit& at) {
            cancelled_ = std::max(cancelled_, 0.1f * max_lane(beam.throughput.corner()));
            beam.throughput.apply(setup_.elements.mueller(at, -d, beam.x, h_));
        });
    }

    // Mixtures choose at random; -1 is a surface that is not there.
    int chosen_material(int material, const Hit& hit) {
        while (material >= 0) {
            const auto* mix = std::get_if<MixTables>(&tables_.surfaces[material]);
            if (mix == nullptr) return material;
            const auto amount = static_cast<float>(
                setup_.numbers.fraction(mix->amount, TexturePoint(setup_.geometry, hit)));
            material = sampler_.next_1d() < amount ? mix->second : mix->first;
        }
        return material;
    }

    // ---- light

    // `light` is the radiance that it came from.
    void add(Contribution<transport, N> c, const Packet<N>& light, float weight) {
        const float excess = project_on_cone(&c, cancelled_ * max_lane(light));
        statistics_.projections += excess > 1e-5f * static_cast<float>(depth_ + 1);
        const float check = sum(c.s[0]) * weight;
        if (!(check < std::numeric_limits<float>::infinity())) {
            ++statistics_.not_finite;
            return;
        }
        for (int i = 0; i < carried_rows<transport>; ++i) {
            radiance_.s[i] += c.s[i] * Packet<N>(weight);
        }
    }

    // What light of this radiance, met along d, brings to the camera.
    Contribution<transport, N> seen(const Beam<transport, N>& beam, const glm::vec3& d,
                                    const Packet<N>& light, const ArrivingPolarisation& p) const {
        if (!(p.dop > 0)) return beam.throughput.unpolarised(light);
        return beam.throughput.polarised(light, rotation_between(-d, beam.x, p.axis, h_), p.dop);
    }

    void add_infinite_lights() {
        for (size_t i = 0; i < lights_.infinite().size(); ++i) {
            Packet<N> light;
            float pdf = 0;
            if (lights_.infinite()[i].environment) {
                const Environment::Light found = lights_.picture_light(i, d_);
                light = tables_.rgb_light(found.radiance, phase_);
                pdf = found.pdf;
            } else {
                light = tables_.infinite_radiance[i][phase_];
                pdf = lights_.infinite_pdf(i, d_);
            }
            const float weight = lobe_share(pdf);
            add(seen(beam_, d_, light,
                     polarised_ ? lights_.infinite_polarisation(i, d_) : ArrivingPolarisation{}),
                light, weight);
        }
    }

    void add_area_light(const Shape& shape, const Hit& hit) {
        const AreaLight& light = scene_.area_lights[shape.area_light];
        if (!light.two_sided && !(glm::dot(hit.ng, d_) < 0)) return;
        const float distance = glm::length(hit.p - from_);
        const float weight = lobe_pdf_ > 0 ? lobe_share(lights_.area_pdf(hit, d_, distance)) : 1;
        const Packet<N> radiance = tables_.area_radiance[shape.area_light][phase_];
        add(seen(beam_, d_, radiance,
                 polarised_ ? lights_.area_polarisation(hit, d_) : ArrivingPolarisation{}),
            radiance, weight);
    }

    // What a light sample brings over a scattering.
    void add_light(const Vertex& v, const Lights::Sample& l, const Packet<N>& reflectance,
                   const glm::vec3& m, float weight) {
        if (is_plain()) {
            const Packet<N> light = radiance_of(l);
            add(beam_.throughput.unpolarised(reflectance * light), light, weight);
        } else {
            Beam<transport, N> beam = beam_;
            beam.scatter(v.out, -l.d, m, reflectance, 1, h_);
            add_light(v, l, beam, weight);
        }
    }
    void add_light(const Vertex& v, const Lights::Sample& l, const Reflection<Packet<N>>& r,
                   const glm::vec3& m, float weight) {
        if (is_plain()) {
            const glm::vec3 s = s_axis(-l.d, v.to_world(m));
            const Packet<N> light = radiance_of(l);
            add(beam_.throughput.reflect_unpolarised(rotation_between(v.out, beam_.x, s, h_),
                                                     r.A() * light, r.B() * light),
                light, weight);
        } else {
            Beam<transport, N> beam = beam_;
            beam.scatter(v.out, -l.d, v.to_world(m), r, 1, h_);
            add_light(v, l, beam, weight);
        }
    }
    void add_light(const Vertex& v, const Lights::Sample& l, const DenseOptics<N>& r,
                   const glm::vec3& m, float weight) {
        Beam<transport, N> beam = beam_;
        beam.scatter(v.out, -l.d, m, r, 1, h_);
        add_light(v, l, beam, weight);
    }
    // Light comes unpolarised and nothing stands in its way.
    bool is_plain() const { return setup_.elements.empty() && !polarised_; }

    // The same over the whole way: `beam` is the path with the scattering, on the ray along l.d.
    void add_light(const Vertex& v, const Lights::Sample& l, Beam<transport, N>& beam,
                   float weight) {
        if (!setup_.elements.empty()) {
            const glm::vec3 from = leave(v.hit, l.d);
            pass_elements(from, l.d,
                          std::isinf(l.distance) ? l.distance : glm::length(l.target - from), beam);
        }
        const Packet<N> light = radiance_of(l);
        add(seen(beam, l.d, light, l.polarisation), light, weight);
    }

    Lights::Sample light_sample(const Hit& hit) {
        if (setup_.strategy.directions == SamplingStrategy::Directions::lobe) return {};
        const float choice = sampler_.next_1d();
        return lights_.sample(hit.p, choice, sampler_.next_2d());
    }

    Packet<N> radiance_of(const Lights::Sample& l) const {
        switch (l.kind) {
            case Lights::Kind::environment:
                return tables_.rgb_light(l.rgb, phase_);
            case Lights::Kind::constant:
                return tables_.infinite_radiance[l.light][phase_];
            case Lights::Kind::distant:
                return tables_.distant_irradiance[l.light][phase_];
            case Lights::Kind::point:
                return tables_.point_intensity[l.light][phase_];
            case Lights::Kind::area:
                break;
        }
        return tables_.area_radiance[l.light][phase_];
    }

    // Whether the light sample reaches the surface on the side that it is wanted on.
    bool reaches(const Vertex& v, const Lights::Sample& l, bool transmits) {
        const float side = glm::dot(l.d, v.hit.ng);
        if (!(transmits ? side < 0 : side > 0)) return false;
        if (depth_ >= setup_.clear_after) return true;
        ++statistics_.rays;
        const glm::vec3 from = leave(v.hit, l.d);
        if (std::isinf(l.distance)) return !setup_.geometry.occluded(from, l.d, l.distance);
        const glm::vec3 to = l.target - from;
        const float distance = glm::length(to);
        return distance > 0 && !setup_.geometry.occluded(from, to / distance, distance);
    }

    // What counts of a light sample, whose direction the lobe chooses with density `lobe_pdf`, and
    // of light that the lobe found where lights are sampled with density `light_pdf`.
    float light_share(const Lights::Sample& l, float lobe_pdf) const {
        if (l.is_delta || setup_.strategy.directions == SamplingStrategy::Directions::light) {
            return 1;
        }
        return mis(l.pdf, lobe_pdf);
    }
    float lobe_share(float light_pdf) const {
        if (!(lobe_pdf_ > 0) || !(light_pdf > 0)) return 1;
        if (setup_.strategy.directions == SamplingStrategy::Directions::light) return 0;
        return mis(lobe_pdf_, light_pdf);
    }

    // Power heuristic (Veach 1997, eq. 9.13) for a sample of density a against b.
    static float mis(float a, float b) {
        if (!(b > 0)) return 1;
        const float ratio = b / a;
        return 1 / (1 + ratio * ratio);
    }

    static constexpr int most_passed = 10000;

    const PathSetup<transport, N>& setup_;
    const Scene& scene_;
    const Lights& lights_;
    const SpectralTables<N>& tables_;
    const bool polarised_;  // some light is
    const float h_;
    const int phase_;
    Sampler& sampler_;
    PathStatistics& statistics_;

    Contribution<transport, N> radiance_;
    Beam<transport, N> beam_;
    glm::vec3 o_{0}, d_{0};
    glm::vec3 from_{0};  // the last vertex, from which light sampling competes
    // The density with which the lobe chose d; 0 where no light sample competes with it.
    float lobe_pdf_ = 0;
    float radiance_scale_ = 1;  // index squared where the path is, over that at the camera
    int hero_ = -1;             // the lane that decides directions, once there was dispersion
    bool parted_ = false;       // only the hero is left
    // An analyser, crossed elements and reflections of polarised light at Brewster's angle leave of
    // the product what rounding leaves: a contribution is judged against at least this.
    float cancelled_ = 0;
    int depth_ = 0, passed_ = 0;
};

}  // namespace drude

#include "render/coat_walk.h"
