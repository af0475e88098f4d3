// The picture of a rough sphere under a white sky, with the light that one reflection keeps, and
// with an estimate of what more reflections would bring back.
#pragma once

#include <vector>

#include "bench/charts/shadowed_lobe.h"
#include "bench/charts/sphere_picture.h"
#include "materials/optical_constants.h"

namespace drude {

// A lobe's parts on every ring of the sphere: facet_cosines() of each.
struct LobeOnSphere {
    std::vector<std::vector<double>> parts;
    explicit LobeOnSphere(const ShadowedLobe& lobe);

    double albedo(int ring) const;
    // 1 less its mean over the disk: the part of the light that a sphere of perfect mirrors loses.
    double energy_lost() const;
};

// The metal's reflectance at the nodes of facet_cosines(), of unpolarised light.
class FacetReflectance {
  public:
    explicit FacetReflectance(const DenseIndex& metal);
    double operator()(int i, int node) const {
        return values_[static_cast<size_t>(i) * facet_cosine_nodes + node];
    }
    // Mean over the directions of a half-space, weighted with their cosine.
    double mean(int i) const { return mean_[static_cast<size_t>(i)]; }

  private:
    std::vector<double> values_, mean_;
};

// One reflection: what the renderer has.
SpherePicture rough_sphere(const LobeOnSphere& lobe, const FacetReflectance& metal);

// All reflections, after Kulla & Conty 2017 (SIGGRAPH course "Physically Based Shading"): what is
// lost comes back evenly after a second and further reflections, each at the metal's mean
// reflectance F: (1 - albedo) F^2 E / (1 - F (1 - E)), E being the lobe's mean albedo. An estimate
// of facets that shadow each other at random; at R = 1 it keeps all light.
SpherePicture rough_sphere_with_all_bounces(const LobeOnSphere& lobe,
                                            const FacetReflectance& metal);

}  // namespace drude
