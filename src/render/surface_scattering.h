// What surfaces do to a path, one small class a kind of surface, bound to one vertex and the
// wavelengths of one path.
//
// Each has the same members, by which path.h treats them alike without a virtual call:
//   is_delta()             every direction it sends light to is a single one, which light sampling
//                          cannot find
//   evaluate(o, i)         what scattering between two directions is worth
//   sample(o, sampler)     a direction for the path
//   optics(o, i, m, transmits)  what happens to the light: a Reflection of packets in the s-p frame
//                          of facet m, or (depolarises) a packet of reflectances
// Directions are local to the vertex, away from the surface; o.z > 0.
#pragma once

#include "render/sampler.h"
#include "render/spectral_tables.h"

namespace drude {

// Without what the optics takes away; cos of i included in `value`.
struct LobeValue {
    float value = 0, pdf = 0;  // pdf of sample(), per solid angle of i
    glm::vec3 m{0, 0, 1};      // the facet that joins o and i
    bool transmits = false;
};
struct LobeSample {
    glm::vec3 i{0, 0, 1}, m{0, 0, 1};
    float weight = 0;  // value / pdf; 0: the path ends
    float pdf = 0;     // 0: a single direction
    bool transmits = false;
};

// A cosine lobe about +-z; the weight over it is 1.
inline LobeValue cosine_value(float z) {
    const float value = std::max(0.0f, z) / static_cast<float>(pi);
    return {value, value, {0, 0, 1}, false};
}
inline LobeSample cosine_sample(Sampler& sampler) {
    const glm::vec2 u = sampler.next_2d();
    const float r = std::sqrt(u.x), phi = static_cast<float>(2 * pi) * u.y;
    LobeSample s;
    s.i = {r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.0f, 1 - u.x))};
    s.pdf = s.i.z / static_cast<float>(pi);
    s.weight = s.pdf > 0 ? 1.0f : 0.0f;
    return s;
}

template <int N>
class DiffuseScattering {
  public:
    static constexpr bool depolarises = true;
    explicit DiffuseScattering(const Packet<N>& reflectance) : reflectance_(reflectance) {}

    bool is_delta() const { return false; }
    LobeValue evaluate(const glm::vec3&, const glm::vec3& i) const { return cosine_value(i.z); }
    LobeSample sample(const glm::vec3&, Sampler& sampler) const { return cosine_sample(sampler); }
    Packet<N> optics(const glm::vec3&, const glm::vec3&, const glm::vec3&, bool) const {
        return reflectance_;
    }

  private:
    Packet<N> reflectance_;
};

// Reflects and transmits, each in a cosine lobe.
template <int N>
class DiffuseTransmissionScattering {
  public:
    static constexpr bool depolarises = true;
    DiffuseTransmissionScattering(const Packet<N>& reflectance, const Packet<N>& transmittance)
        : reflectance_(reflectance), transmittance_(transmittance) {
        const float r = max_lane(reflectance), t = max_lane(transmittance);
        reflects_ = r + t > 0 ? r / (r + t) : 1;
    }

    bool is_delta() const { return false; }
    LobeValue evaluate(const glm::vec3&, const glm::vec3& i) const {
        LobeValue e = cosine_value(std::abs(i.z));
        e.transmits = i.z < 0;
        e.pdf *= e.transmits ? 1 - reflects_ : reflects_;
        return e;
    }
    LobeSample sample(const glm::vec3&, Sampler& sampler) const {
        const bool transmits = !(sampler.next_1d() < reflects_);
        LobeSample s = cosine_sample(sampler);
        const float chosen = transmits ? 1 - reflects_ : reflects_;
        s.transmits = transmits;
        if (transmits) s.i.z = -s.i.z;
        s.weight /= chosen;
        s.pdf *= chosen;
        return s;
    }
    Packet<N> optics(const glm::vec3&, const glm::vec3&, const glm::vec3&, bool transmits) const {
        return transmits ? transmittance_ : reflectance_;
    }

  private:
    Packet<N> reflectance_, transmittance_;
    float reflects_;
};

// A metal seen from vacuum.
template <int N>
class ConductorScattering {
  public:
    static constexpr bool depolarises = false;
    // `visible`: see SamplingStrategy::visible_normals.
    ConductorScattering(const ConductorTables<N>& metal, const Microfacets<float>& lobe, int phase,
                        bool visible)
        : metal_(metal), lobe_(lobe), phase_(phase), visible_(visible) {}
    // Of a metal with a fixed reflectance: its value here.
    ConductorScattering(const ConductorTables<N>& metal, const Microfacets<float>& lobe, int phase,
                        bool visible, const Packet<N>& fixed)
        : metal_(metal), lobe_(lobe), phase_(phase), visible_(visible), fixed_(fixed) {}

    bool is_delta() const { return lobe_.is_mirror(); }
    LobeValue evaluate(const glm::vec3& o, const glm::vec3& i) const {
        const auto e = lobe_.evaluate(o, i);
        return {e.value, visible_ ? e.pdf : whole_pdf(o, e.m), e.m, false};
    }
    LobeSample sample(const glm::vec3& o, Sampler& sampler) const {
        LobeSample s;
        if (lobe_.is_mirror()) {
            s.i = {-o.x, -o.y, o.z};
            s.weight = 1;
            return s;
        }
        const glm::vec2 u = sampler.next_2d();
        if (!visible_) return sample_whole(o, u, sampler.next_1d());
        const auto drawn = lobe_.sample(o, u.x, u.y, sampler.next_1d());
        if (!(drawn.pdf > 0)) return s;
        return {drawn.i, drawn.m, drawn.weight, drawn.pdf, false};
    }
    Reflection<Packet<N>> optics(const glm::vec3&, const glm::vec3& i, const glm::vec3& m,
                                 bool) const {
        if (metal_.fixed_reflectance) return {fixed_, fixed_, -fixed_, Packet<N>(0.0f)};
        return metal_.reflection(std::min(1.0f, glm::dot(i, m)), phase_);
    }

  private:
    // All facets by D cos. Those are the facets that are visible along the normal.
    float whole_pdf(const glm::vec3& o, const glm::vec3& m) const {
        return lobe_.D(m) * m.z / (4 * glm::dot(o, m));
    }
    LobeSample sample_whole(const glm::vec3& o, const glm::vec2& u, float u3) const {
        LobeSample s;
        const glm::vec3 m = lobe_.sample_visible({0, 0, 1}, u.x, u.y, u3);
        const float om = glm::dot(o, m);
        if (!(om > 0)) return s;
        const glm::vec3 i = 2 * om * m - o;
        if (!(i.z > 0)) return s;
        return {i, m, lobe_.G2(o, i, m) * om / (o.z * m.z), whole_pdf(o, m), false};
    }

    const ConductorTables<N>& metal_;
    const Microfacets<float>& lobe_;
    int phase_;
    bool visible_;
    Packet<N> fixed_;
};

// The interface of a dielectric, from either side. Where the index changes with wavelength, one
// lane, `hero`, decides the directions; only it goes through, for all N lanes where they have not
// been parted yet (`share` is N then, otherwise 1).
template <int N>
class DielectricScattering {
  public:
    static constexpr bool depolarises = false;
    // `eta` relative: of the far side over the near.
    DielectricScattering(const RoughDielectric<float>& interface, const Packet<N>& eta)
        : interface_(interface), eta_(eta), hero_eta_(eta[0]) {}
    DielectricScattering(const RoughDielectric<float>& interface, const Packet<N>& eta, int hero,
                         float share)
        : interface_(interface), eta_(eta), hero_eta_(eta[hero]), hero_(hero), share_(share) {}

    float hero_eta() const { return hero_eta_; }
    bool is_delta() const { return interface_.is_smooth(hero_eta_); }
    LobeValue evaluate(const glm::vec3& o, const glm::vec3& i) const {
        const auto e = interface_.evaluate(o, i, hero_eta_);
        return {e.value, e.pdf, e.m, e.is_transmitted};
    }
    LobeSample sample(const glm::vec3& o, Sampler& sampler) const {
        glm::vec2 u(0);
        float u3 = 0;
        if (!is_delta()) {
            u = sampler.next_2d();
            u3 = sampler.next_1d();
        }
        const auto s = interface_.sample(o, hero_eta_, u.x, u.y, u3, sampler.next_1d());
        return {s.i, s.m, s.weight, s.pdf, s.is_transmitted};
    }
    Reflection<Packet<N>> optics(const glm::vec3& o, const glm::vec3&, const glm::vec3& m,
                                 bool transmits) const {
        const DividedLight<Packet<N>> light =
            divide_at_interface(eta_, Packet<N>(std::min(1.0f, glm::dot(o, m))));
        if (!transmits) return light.reflected;
        if (hero_ < 0) return light.transmitted;
        Packet<N> only(0.0f);
        only.set(hero_, share_);
        const Reflection<Packet<N>>& t = light.transmitted;
        return {only * t.Rs, only * t.Rp, only * t.C, only * t.S};
    }

  private:
    const RoughDielectric<float>& interface_;
    Packet<N> eta_;
    float hero_eta_;
    int hero_ = -1;
    float share_ = 1;
};

// A plate without thickness: straight back or straight through.
template <int N>
class ThinDielectricScattering {
  public:
    static constexpr bool depolarises = false;
    explicit ThinDielectricScattering(const Packet<N>& eta) : eta_(eta) {}

    bool is_delta() const { return true; }
    LobeValue evaluate(const glm::vec3&, const glm::vec3&) const { return {}; }
    LobeSample sample(const glm::vec3& o, Sampler& sampler) const {
        const float R = divide_at_plate(eta_[N / 2], o.z).reflected.A();
        LobeSample s;
        s.transmits = !(sampler.next_1d() < R);
        s.i = s.transmits ? -o : glm::vec3(-o.x, -o.y, o.z);
        s.weight = 1 / (s.transmits ? 1 - R : R);
        return s;
    }
    Reflection<Packet<N>> optics(const glm::vec3& o, const glm::vec3&, const glm::vec3&,
                                 bool transmits) const {
        const DividedLight<Packet<N>> light = divide_at_plate(eta_, Packet<N>(std::min(1.0f, o.z)));
        return transmits ? light.transmitted : light.reflected;
    }

  private:
    Packet<N> eta_;
};

}  // namespace drude
