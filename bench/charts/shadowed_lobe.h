// A microfacet lobe under either masking, integrated in double: how much of the light single
// scattering keeps, and at which angles its facets reflect.
//
// Smith's masking of any isotropic lobe follows from the projected area of its facets (Heitz 2014,
// JCGT 3(2), eq. 16): G1(w) = w.z / integral of max(0, w.m) D(m) dm, the same for every facet that
// faces w. materials/microfacet.h has it in closed form for Beckmann and Trowbridge-Reitz; here it
// is tabulated for all four, so that the two maskings can be compared on each.
#pragma once

#include <vector>

#include "materials/microfacet.h"

namespace drude {

// beta of the lobe whose D falls to half its value at normal at the angle `half_height` in
// (0, pi/2), in radians: that angle itself but for Beckmann, beta^2 = t^2 / (ln 2 + 2 ln(1 + t^2))
// with t its tangent. (Beckmann's D has its largest value at normal below beta = 0.707 only.)
double beta_at_half_height(Lobe lobe, double half_height);

inline constexpr int facet_cosine_nodes = 64;

class ShadowedLobe {
  public:
    ShadowedLobe(Lobe lobe, Masking masking, double beta);

    double beta() const { return beta_; }
    // The fraction of facets facing w that w sees, cos_theta in (0, 1]; Smith's, whatever the
    // lobe's masking.
    double smith_G1(double cos_theta) const;
    // As Microfacets::G2: o, i and m as there.
    double G2(const Vec3<double>& o, const Vec3<double>& i, const Vec3<double>& m) const;

    // The integral of D over the facets' projected area, which is 1: what the quadrature makes of
    // it.
    double norm() const;

    // What comes back once of light from the direction of cos_theta in (0, 1], of facets that
    // reflect all: the directional albedo.
    double albedo(double cos_theta) const;

    // The same in parts, by the cosine at which facets reflect: element j holds the part at about
    // j/(facet_cosine_nodes - 1), split linearly between neighbours, so that the sum of element
    // times a reflectance at the nodes is the directional reflectance. The sum is albedo().
    std::vector<double> facet_cosines(double cos_theta) const;

  private:
    struct Node {
        double cosine, sine, weight;  // of the facet's angle; D times its solid angle over 2 pi
    };
    // Calls f(cosine at the facet, weight) for each part of the albedo.
    template <class F>
    void each_facet(double cos_theta, const F& f) const;

    Masking masking_;
    double beta_, scale_;        // scale_: a slope of the lobe's width
    std::vector<Node> nodes_;    // of the facet's angle, Gauss and Legendre's
    std::vector<double> smith_;  // G1 where cot = scale_ s/(1 - s), s evenly
};

}  // namespace drude
