#include "device/virtual/light_path.h"

#include <algorithm>
#include <cmath>

#include "materials/quadrature.h"
#include "materials/surface.h"

namespace drude {

namespace {

using Direction = Vec3<double>;

// A direction of the detector's cone: what its facets' reflection is weighted with and how their
// frame lies in those of the bench.
struct ConeNode {
    double weight = 0;     // BRDF x cos(theta_o) x solid angle, the reflection left out
    double cos_facet = 1;  // angle of incidence on the facet
    Rotation<double> in, out;
};

// Directions over the cone: Gauss-Legendre in the cosine, equal steps in azimuth, as many as the
// lobe's width asks for.
std::vector<ConeNode> cone_nodes(const Microfacets<double>& microfacets, double beta,
                                 double incidence, double offset, double half_angle) {
    const Direction i(-std::sin(incidence), 0, std::cos(incidence)), s(0, 1, 0);
    const double exit = incidence + offset;
    const Direction axis(std::sin(exit), 0, std::cos(exit));
    const Direction along(std::cos(exit), 0, -std::sin(exit));
    // Turning the half vector by an angle turns the light by twice that; near grazing the lobe is
    // narrower in the plane of incidence's own direction.
    const double lobe_width = 2 * beta * std::cos(incidence);
    const int rings =
        std::clamp(static_cast<int>(std::ceil(6 + 6 * half_angle / lobe_width)), 6, 120);
    const int spokes = 2 * rings;
    const QuadratureRule gauss = gauss_legendre(rings);
    const double depth = 2 * std::pow(std::sin(half_angle / 2), 2);  // 1 - cos, without cancelling
    std::vector<ConeNode> nodes;
    for (int ring = 0; ring < rings; ++ring) {
        const double fall = 0.5 * depth * (1 - gauss.x[ring]);
        const double sine = std::sqrt(fall * (2 - fall));
        for (int spoke = 0; spoke < spokes; ++spoke) {
            const double phi = 2 * pi * (spoke + 0.5) / spokes;
            const Direction o = glm::normalize((1 - fall) * axis +
                                               sine * (std::cos(phi) * along + std::sin(phi) * s));
            const auto e = microfacets.evaluate(o, i);
            if (!(e.value > 0)) continue;
            ConeNode node;
            // evaluate() has BRDF x cos(theta_i); the flux of a beam wants cos(theta_o).
            node.weight =
                e.value * o.z / i.z * 0.5 * depth * gauss.weight[ring] * (2 * pi / spokes);
            node.cos_facet = std::min(glm::dot(i, e.m), 1.0);
            const Direction facet_s = s_axis(-i, e.m);
            node.in = rotation_between(-i, s, facet_s, 1.0);
            const Direction detector_s = glm::normalize(s - glm::dot(s, o) * o);
            node.out = inverse(rotation_between(o, detector_s, facet_s, 1.0));
            nodes.push_back(node);
        }
    }
    return nodes;
}

void add_mirror(const Reflection<double>& r, PathRows* rows) {
    const Mueller<double> full = mueller(r);
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 3; ++j) rows->m[i][j] = full.m[i][j];
    }
}

// weight * out * mueller(r) * in, multiplied out: the rotations touch one 2x2 block each.
void add_facets(const ConeNode& node, const Reflection<double>& r, PathRows* rows) {
    const double A = node.weight * r.A(), B = node.weight * r.B();
    const double C = node.weight * r.C, S = node.weight * r.S;
    const double ci = node.in.cos2, si = node.in.sin2, co = node.out.cos2, so = node.out.sin2;
    const double row1[3] = {B, A * ci, A * si}, row2[3] = {0, -C * si, C * ci};
    rows->m[0][0] += A;
    rows->m[0][1] += B * ci;
    rows->m[0][2] += B * si;
    for (int j = 0; j < 3; ++j) {
        rows->m[1][j] += co * row1[j] + so * row2[j];
        rows->m[2][j] += co * row2[j] - so * row1[j];
    }
    rows->m[3][1] -= S * si;
    rows->m[3][2] += S * ci;
}

}  // namespace

SampledSurface::SampledSurface(const Material& material, const std::vector<double>& wavelengths_nm)
    : wavelengths_nm_(wavelengths_nm), film_count_(static_cast<int>(material.layers.size())) {
    material.check();
    const auto index = [](const OpticalConstants& constants, double wavelength) {
        const Index at = constants.at(wavelength);
        return ComplexIndex<double>{at.n, at.k};
    };
    for (const double wavelength : wavelengths_nm) {
        substrate_.push_back(index(material.substrate, wavelength));
        for (const FilmLayer& layer : material.layers) {
            films_.push_back({index(layer.constants, wavelength), layer.thickness_nm});
        }
    }
}

Reflection<double> SampledSurface::reflect_at(size_t pixel, double cos_theta) const {
    return reflect(films_.data() + pixel * static_cast<size_t>(film_count_), film_count_,
                   substrate_[pixel], cos_theta, wavelengths_nm_[pixel]);
}

std::vector<PathRows> sample_path(const Material& material, const SampledSurface& surface,
                                  double incidence_deg, double offset_deg, double half_angle_deg) {
    std::vector<PathRows> path(surface.size());
    const double incidence = incidence_deg * degree;
    const Microfacets<double> microfacets(material.lobe, material.masking, material.beta);
    if (microfacets.is_mirror()) {
        if (std::abs(offset_deg) > half_angle_deg) return path;
        for (size_t pixel = 0; pixel < path.size(); ++pixel) {
            add_mirror(surface.reflect_at(pixel, std::cos(incidence)), &path[pixel]);
        }
        return path;
    }
    const std::vector<ConeNode> nodes = cone_nodes(microfacets, material.beta, incidence,
                                                   offset_deg * degree, half_angle_deg * degree);
    for (size_t pixel = 0; pixel < path.size(); ++pixel) {
        for (const ConeNode& node : nodes) {
            add_facets(node, surface.reflect_at(pixel, node.cos_facet), &path[pixel]);
        }
    }
    return path;
}

std::vector<PathRows> straight_path(size_t pixels) {
    PathRows identity;
    for (int i = 0; i < 3; ++i) identity.m[i][i] = 1;
    return std::vector<PathRows>(pixels, identity);
}

}  // namespace drude
