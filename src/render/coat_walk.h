// A path within a coat: down through its surface, off the base, back up, until it leaves; without
// rays, since all of that happens at one point. Included by path.h.
//
// Every meeting with the base or with the coat's surface is a scattering like any other. Lights are
// sampled from the base through a smooth surface, and from a rough surface itself. Radiance in the
// coat is over its index squared: what refraction multiplies on the way in, it takes on the way
// out.
#pragma once

namespace drude {

namespace coat_detail {

// Seen from below, the surface is the same in the mirror.
inline glm::vec3 mirrored(const glm::vec3& v) {
    return {v.x, v.y, -v.z};
}

// The direction above the surface i, continued (backwards along the light) in the coat: away from
// the base, towards the surface.
inline glm::vec3 refracted_into(const glm::vec3& i, float eta) {
    const float x = i.x / eta, y = i.y / eta;
    return {x, y, std::sqrt(std::max(0.0f, 1 - x * x - y * y))};
}

template <int N>
Reflection<Packet<N>> packets(const Reflection<float>& r) {
    using P = Packet<N>;
    return {P(r.Rs), P(r.Rp), P(r.C), P(r.S)};
}

// Of a solid angle in the coat over that above the surface, cosines included.
inline float compression(const glm::vec3& above, const glm::vec3& within, float eta) {
    return above.z / (eta * eta * within.z);
}

}  // namespace coat_detail

// Light samples that reach the base through a smooth surface; `out` is the direction from the base
// in which the path looks at it.
template <Transport transport, int N>
template <class Base>
void Path<transport, N>::add_light_through_coat(const Vertex& v, const CoatTables<N>& coat,
                                                const Base& base, const glm::vec3& out) {
    const Lights::Sample l = light_sample(v.hit);
    if (!(l.pdf > 0)) return;
    const glm::vec3 above = v.to_local(l.d);
    if (!(above.z > 0)) return;
    const glm::vec3 in = coat_detail::refracted_into(above, coat.eta);
    const LobeValue e = base.evaluate(out, in);
    if (!(e.value > 0) || !reaches(v, l, false)) return;
    const float squeeze = coat_detail::compression(above, in, coat.eta);
    const Reflection<float> t = divide_at_interface(coat.eta, std::min(1.0f, above.z)).transmitted;
    const float pdf = e.pdf * squeeze * (1 - interface_reflectance(1 / coat.eta, in.z));

    Beam<transport, N> beam = beam_;
    beam.scatter(v.to_world(out), -v.to_world(in), v.to_world(e.m),
                 base.optics(out, in, e.m, false), std::exp(-coat.thickness / in.z), h_);
    beam.scatter(-v.to_world(in), -l.d, v.hit.ns, coat_detail::packets<N>(t), 1, h_);
    add_light(v, l, beam, light_share(l, pdf) * e.value * squeeze / l.pdf);
}

// Light samples that a rough surface refracts into the coat; the path has come up to it along `up`.
template <Transport transport, int N>
void Path<transport, N>::add_light_through_rough_coat(const Vertex& v, const CoatTables<N>& coat,
                                                      const DielectricScattering<N>& from_below,
                                                      const glm::vec3& up) {
    const Lights::Sample l = light_sample(v.hit);
    if (!(l.pdf > 0)) return;
    const glm::vec3 above = v.to_local(l.d);
    if (!(above.z > 0)) return;
    const glm::vec3 out = coat_detail::mirrored(-up), in = coat_detail::mirrored(above);
    const LobeValue e = from_below.evaluate(out, in);
    if (!(e.value > 0) || !reaches(v, l, false)) return;
    Beam<transport, N> beam = beam_;
    beam.scatter(-v.to_world(up), -l.d, v.to_world(coat_detail::mirrored(e.m)),
                 from_below.optics(out, in, e.m, true), 1 / (coat.eta * coat.eta), h_);
    add_light(v, l, beam, light_share(l, e.pdf) * e.value / l.pdf);
}

template <Transport transport, int N>
template <class Base>
bool Path<transport, N>::walk_in_coat(const Vertex& v, const CoatTables<N>& coat,
                                      const Base& base) {
    using coat_detail::mirrored;
    const float eta2 = coat.eta * coat.eta;
    const DielectricScattering<N> from_above(coat.interface, Packet<N>(coat.eta));
    const DielectricScattering<N> from_below(coat.interface, Packet<N>(1 / coat.eta));
    const bool is_smooth = from_above.is_delta();
    const glm::vec3 out = v.to_local(v.out);

    if (!is_smooth) {
        if (const Lights::Sample l = light_sample(v.hit); l.pdf > 0) {
            const glm::vec3 in = v.to_local(l.d);
            const LobeValue e = from_above.evaluate(out, in);
            if (e.value > 0 && !e.transmits && reaches(v, l, false)) {
                add_light(v, l, from_above.optics(out, in, e.m, false), e.m,
                          light_share(l, e.pdf) * e.value / l.pdf);
            }
        }
    }
    LobeSample s = from_above.sample(out, sampler_);
    if (!(s.weight > 0)) return false;
    const auto leave_above = [&](const glm::vec3& i, float pdf) {
        const glm::vec3 in = glm::normalize(v.to_world(i));
        if (!(glm::dot(in, v.hit.ng) > 0)) return false;
        go_on(v.hit, in, pdf);
        return true;
    };
    beam_.scatter(v.out, -v.to_world(s.i), v.to_world(s.m),
                  from_above.optics(out, s.i, s.m, s.transmits),
                  s.transmits ? s.weight * eta2 : s.weight, h_);
    if (!s.transmits) return leave_above(s.i, s.pdf);

    glm::vec3 down = s.i;
    const float entered = max_lane(beam_.throughput.corner());
    for (int bounce = 0;; ++bounce) {
        beam_.throughput.scale(std::exp(coat.thickness / down.z));
        const glm::vec3 looking = -down;
        if (is_smooth && !base.is_delta()) add_light_through_coat(v, coat, base, looking);
        s = base.sample(looking, sampler_);
        if (!(s.weight > 0) || !(s.i.z > 0)) return false;
        const glm::vec3 up = s.i;
        beam_.scatter(v.to_world(looking), -v.to_world(up), v.to_world(s.m),
                      base.optics(looking, up, s.m, false),
                      s.weight * std::exp(-coat.thickness / up.z), h_);
        const float base_pdf = s.pdf;

        if (!is_smooth) add_light_through_rough_coat(v, coat, from_below, up);
        const glm::vec3 below = mirrored(-up);
        s = from_below.sample(below, sampler_);
        if (!(s.weight > 0)) return false;
        const glm::vec3 next = mirrored(s.i);
        beam_.scatter(-v.to_world(up), -v.to_world(next), v.to_world(mirrored(s.m)),
                      from_below.optics(below, s.i, s.m, s.transmits),
                      s.transmits ? s.weight / eta2 : s.weight, h_);
        if (s.transmits) {
            if (!is_smooth) return leave_above(next, s.pdf);
            const float pass = 1 - interface_reflectance(1 / coat.eta, up.z);
            return leave_above(next,
                               base_pdf * coat_detail::compression(next, up, coat.eta) * pass);
        }
        down = next;

        const float alive = max_lane(beam_.throughput.corner()) / entered;
        if (!(alive > 0)) return false;
        if (bounce >= 2) {
            const float survival = std::clamp(alive, 0.05f, 0.95f);
            if (sampler_.next_1d() >= survival) return false;
            beam_.throughput.scale(1 / survival);
        }
    }
}

}  // namespace drude
