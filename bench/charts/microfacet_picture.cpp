#include "bench/charts/microfacet_picture.h"

#include <cmath>

#include "materials/fresnel.h"

namespace drude {

LobeOnSphere::LobeOnSphere(const ShadowedLobe& lobe) {
    for (int ring = 0; ring < sphere_rings; ++ring) {
        parts.push_back(lobe.facet_cosines(ring_cosine(ring)));
    }
}

double LobeOnSphere::albedo(int ring) const {
    double sum = 0;
    for (const double part : parts[static_cast<size_t>(ring)]) sum += part;
    return sum;
}

double LobeOnSphere::energy_lost() const {
    double kept = 0;
    for (int ring = 0; ring < sphere_rings; ++ring) kept += albedo(ring) / sphere_rings;
    return 1 - kept;
}

FacetReflectance::FacetReflectance(const DenseIndex& metal) {
    for (int i = 0; i < spectrum_integral_size; ++i) {
        const ComplexIndex<double> index{metal.n[i], metal.k[i]};
        for (int node = 0; node < facet_cosine_nodes; ++node) {
            const double cosine = static_cast<double>(node) / (facet_cosine_nodes - 1);
            values_.push_back(reflect(index, cosine).A());
        }
        // Rings of equal area are cosine-weighted directions.
        double sum = 0;
        for (int ring = 0; ring < sphere_rings; ++ring) {
            sum += reflect(index, ring_cosine(ring)).A();
        }
        mean_.push_back(sum / sphere_rings);
    }
}

namespace {

double single(const LobeOnSphere& lobe, const FacetReflectance& metal, int i, int ring) {
    double sum = 0;
    const std::vector<double>& parts = lobe.parts[static_cast<size_t>(ring)];
    for (int node = 0; node < facet_cosine_nodes; ++node) {
        sum += parts[static_cast<size_t>(node)] * metal(i, node);
    }
    return sum;
}

}  // namespace

SpherePicture rough_sphere(const LobeOnSphere& lobe, const FacetReflectance& metal) {
    return sphere_picture([&](int i, int ring) { return single(lobe, metal, i, ring); });
}

SpherePicture rough_sphere_with_all_bounces(const LobeOnSphere& lobe,
                                            const FacetReflectance& metal) {
    const double kept = 1 - lobe.energy_lost();
    std::vector<double> lost;
    for (int ring = 0; ring < sphere_rings; ++ring) lost.push_back(1 - lobe.albedo(ring));
    return sphere_picture([&](int i, int ring) {
        const double F = metal.mean(i);
        return single(lobe, metal, i, ring) +
               lost[static_cast<size_t>(ring)] * F * F * kept / (1 - F * (1 - kept));
    });
}

}  // namespace drude
