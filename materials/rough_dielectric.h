// A rough interface between clear media: a lobe of little interfaces, each of which reflects and
// refracts by Fresnel's equations at its own angle (Walter, Marschner, Li & Torrance 2007, EGSR,
// "Microfacet Models for Refraction through Rough Surfaces").
//
// Local coordinates: o, the direction towards the viewer, is above the surface, o.z > 0; i, towards
// the light, lies above it where light is reflected and below it (i.z < 0) where it came through.
// eta is the index below over the index above: of the other side over the side of o. The facet's
// normal m is always above, o.m > 0. For reflection m is along o + i, for transmission along
// -(o + eta i) or its opposite.
//
// Values leave out the facet's own Mueller matrix, as Microfacets does: times that of
// divide_at_interface(eta, o.m), reflected or transmitted, they are the BSDF times |cos i|. Light
// that came through has its radiance's factor 1/eta^2 in the value:
//   transmitted  D G (o.m) |i.m| / (o.z (o.m + eta i.m)^2),   reflected  D G / (4 o.z).
// G is 1/(1 + Lambda(o) + Lambda(i)) both ways, as in pbrt-v4.
#pragma once

#include "materials/dielectric.h"
#include "materials/microfacet.h"

namespace drude {

template <class T>
class RoughDielectric {
  public:
    // A smooth one.
    RoughDielectric() = default;
    explicit RoughDielectric(Microfacets<T> microfacets) : microfacets_(std::move(microfacets)) {}

    // Whether light goes on in one direction only, which evaluate() never finds. So it does
    // whatever the roughness where the index changes too little to bend it.
    bool is_smooth(T eta) const {
        return microfacets_.is_mirror() || std::abs(eta - 1) < matched_indices;
    }

    struct Evaluation {
        Vec3<T> m{0, 0, 1};
        bool is_transmitted = false;
        T value = 0;  // times the facet's Mueller matrix: BSDF |cos i|, for radiance
        T pdf = 0;    // of choosing i by sample() with the same eta, per solid angle of i
    };

    // o.z <= 0 and pairs that no facet connects give zeros.
    Evaluation evaluate(const Vec3<T>& o, const Vec3<T>& i, T eta) const {
        Evaluation e;
        if (is_smooth(eta) || !(o.z > 0)) return e;
        if (i.z > 0) {
            const auto reflected = microfacets_.evaluate(o, i);
            e.m = reflected.m;
            e.value = reflected.value;
            e.pdf = reflected.pdf * interface_reflectance(eta, facet_cosine(o, e.m));
            return e;
        }
        if (!(i.z < 0)) return e;
        const Vec3<T> sum = o + eta * i;
        const T size2 = glm::dot(sum, sum);
        if (!(size2 > std::numeric_limits<T>::min())) return e;
        const Vec3<T> m = sum / (sum.z > 0 ? std::sqrt(size2) : -std::sqrt(size2));
        const T om = glm::dot(o, m), im = glm::dot(i, m);
        if (!(om > 0) || !(im < 0) || !(m.z > 0)) return e;
        e.m = m;
        e.is_transmitted = true;
        // o.m + eta i.m is the length of o + eta i.
        const T d = microfacets_.D(m), slopes = om * -im / (o.z * size2);
        e.value = d * microfacets_.G2_through(o, i, m) * slopes;
        e.pdf = d * microfacets_.G1(o, m) * slopes * eta * eta *
                (1 - interface_reflectance(eta, facet_cosine(o, m)));
        return e;
    }

    struct Sample {
        Vec3<T> i{0, 0, 1}, m{0, 0, 1};
        bool is_transmitted = false;
        T weight = 0;  // value / pdf; 0: the light is lost between the facets
        T pdf = 0;     // 0 where the interface is smooth
    };

    // A facet that o sees by u1, u2, u3, then its reflection where `u_choice` is below its
    // unpolarised reflectance at `eta`, otherwise its refraction; all numbers in [0, 1). A path of
    // several wavelengths may follow what is reflected with each its own eta; what is transmitted
    // belongs to those of this eta.
    Sample sample(const Vec3<T>& o, T eta, T u1, T u2, T u3, T u_choice) const {
        Sample s;
        if (!(o.z > 0)) return s;
        const bool smooth = is_smooth(eta);
        if (!smooth) s.m = microfacets_.sample_visible(o, u1, u2, u3);
        const T om = facet_cosine(o, s.m);
        const T g1 = smooth ? T(1) : microfacets_.G1(o, s.m);
        if (!(om > 0) || !(g1 > 0)) return s;
        const T R = interface_reflectance(eta, om);
        if (u_choice < R) {
            s.i = 2 * om * s.m - o;
            if (!(s.i.z > 0)) return s;
            s.weight = (smooth ? T(1) : microfacets_.G2(o, s.i, s.m) / g1) / R;
            if (!smooth) s.pdf = R * microfacets_.D(s.m) * g1 / (4 * o.z);
            return s;
        }
        const T q2 = eta * eta - (1 - om) * (1 + om);
        // Rounding at the critical angle: what it leaves of the transmission is nothing.
        if (!(q2 > 0)) return s;
        s.is_transmitted = true;
        s.i = glm::normalize((om - std::sqrt(q2)) * s.m - o);
        const T im = glm::dot(s.i, s.m);
        if (!(s.i.z < 0) || !(im < 0)) return s;
        s.weight =
            (smooth ? T(1) : microfacets_.G2_through(o, s.i, s.m) / g1) / ((1 - R) * eta * eta);
        if (!smooth) {
            const T length = om + eta * im;
            s.pdf =
                (1 - R) * microfacets_.D(s.m) * g1 * om * -im * eta * eta / (o.z * length * length);
        }
        return s;
    }

    // Closer to 1 than this a relative index bends light by less than a float direction shows.
    static constexpr T matched_indices = T(1e-4);

  private:
    static T facet_cosine(const Vec3<T>& o, const Vec3<T>& m) {
        return std::min(T(1), glm::dot(o, m));
    }

    Microfacets<T> microfacets_;
};

}  // namespace drude
